// The maps of the square that a footprint has.
#include "engine/footprint/symmetry.h"

#include "engine/solve/pinned_motion.h"
#include "tests/presets.h"

using namespace gridshell;

namespace {

std::vector<MeshSymmetry> found(const preset::Preset& preset, int edges) {
  const Scene scene = value_of(scene_of(preset));
  const RodMesh mesh = mesh_rods(scene.footprint, edges);
  return symmetries_of(mesh, pinned_motion(mesh, scene.motion).at(1));
}

preset::Preset six_rods() { return circle(6, 66, 55); }

}  // namespace

TEST_CASE("mesh symmetries: a circle has all sixteen, on every mesh, the identity first") {
  for (const int edges : {1, 2, 4}) {
    const auto all = found(six_rods(), edges);
    REQUIRE(all.size() == 16);
    CHECK(all.front().map.isIdentity(0));
    for (const MeshSymmetry& one : all) {
      // each is a permutation of the nodes
      std::vector<int> met(one.image.size(), 0);
      for (const int node : one.image) ++met[std::size_t(node)];
      CHECK(std::count(met.begin(), met.end(), 1) == long(met.size()));
    }
  }
}

TEST_CASE("mesh symmetries: an ellipse has eight, a cap of a net sixteen") {
  const auto oval = found(curve(preset::CurveKind::ellipse, 90, 65, 0.8), 2);
  CHECK(oval.size() == 8);
  for (const MeshSymmetry& one : oval) CHECK(one.map(0, 0) != 0);
  // the hemisphere's boundary is level: its ends alone do not distinguish up from down
  CHECK(found(cap(0.5), 1).size() == 16);
}

TEST_CASE("mesh symmetries: the symmetric part is what all of them leave") {
  const auto all = found(six_rods(), 2);
  const Eigen::Matrix3Xd rough = Eigen::Matrix3Xd::Random(3, Eigen::Index(all[0].image.size()));
  const Eigen::Matrix3Xd part = symmetric_part(rough, all);
  for (const MeshSymmetry& one : all) {
    CHECK((one.of(part) - part).norm() < 1e-12);
    CHECK(distance_under(one, part, part) < 1e-12);
    CHECK(distance_under(one, one.of(rough), rough) < 1e-12);
  }
  CHECK((symmetric_part(part, all) - part).norm() < 1e-12);
  // symmetry under z -> -z leaves no z
  CHECK(part.row(2).cwiseAbs().maxCoeff() < 1e-12);
}
