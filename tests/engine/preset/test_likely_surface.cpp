// The unit and the upward direction that are assumed for a mesh if its file does not name them.
#include "engine/preset/likely_surface.h"

#include "tests/results.h"

using namespace gridshell::preset;

namespace {

/// A sheet of 30 x 20, leaning a little.
SurfaceData sheet(double scale, bool y_up) {
  SurfaceData mesh;
  for (const auto& [x, y] : {std::pair(0., 0.), {30., 0.}, {30., 20.}, {0., 20.}})
    mesh.vertices.push_back(y_up ? std::vector{scale * x, scale * 0.1 * x, -scale * y}
                                 : std::vector{scale * x, scale * y, scale * 0.1 * x});
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

}  // namespace

TEST_CASE("a mesh in metres is a model of 1 : 100 or as large as it is, by the rods' spacing") {
  for (const auto& [spacing, width] : {std::pair(20., 300.), {1000., 30000.}, {5., 30.}}) {
    auto mesh = sheet(1, false);
    const auto notes = make_likely(mesh, spacing, false);
    CHECK(mesh.vertices[1][0] == width);
    CHECK(notes.size() == (width == 30 ? 0 : 1));
  }
  // a unit that the user gives is used
  auto mesh = sheet(1, false);
  CHECK(make_likely(mesh, 20, true).empty());
  CHECK(mesh.vertices[1][0] == 30);
}

TEST_CASE("a mesh that faces y is turned upright") {
  auto mesh = sheet(100, true);
  const auto notes = make_likely(mesh, 20, true);
  REQUIRE(notes.size() == 1);
  CHECK_THAT(notes.front(), Catch::Contains("y is taken as up"));
  CHECK(mesh.vertices == sheet(100, false).vertices);
}
