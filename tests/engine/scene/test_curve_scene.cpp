// Footprints inside curves that a user gives, and nets from tables of points.
#include <cmath>

#include "engine/core/file_io.h"
#include "engine/preset/preset_file.h"
#include "tests/engine/simulate/run.h"
#include "tests/temporary_folder.h"

using namespace gridshell;

namespace {

std::string refused(const preset::Preset& p) { return refusal(scene_of(p)); }

}  // namespace

TEST_CASE("a circle given as a curve is the circle of Fig. 1") {
  preset::Preset p = curve(preset::CurveKind::circle, 120, 80, 0.75);
  p.footprint.radius_mm = 126;
  const auto scene = value_of(scene_of(p));
  const auto same = value_of(scene_of(circle(12, 126, 0.75 * 126)));
  REQUIRE(scene.footprint.rods.size() == same.footprint.rods.size());
  CHECK(scene.footprint.joints.size() == same.footprint.joints.size());
  CHECK((scene.motion.begin - same.motion.begin).cwiseAbs().maxCoeff() < 1e-9);
  CHECK((scene.motion.end - same.motion.end).cwiseAbs().maxCoeff() < 1e-9);
  // half the diagonal of the box around it, not its radius
  CHECK(scene.length_scale_mm == Approx(126 * M_SQRT2).epsilon(1e-4));
}

TEST_CASE("a curve that no grid line meets may be a drawing in metres") {
  preset::Preset p = curve(preset::CurveKind::ellipse, 7, 4, 0.75);
  p.footprint.spacing_mm = 1000;
  CHECK_THAT(refused(p), Catch::Contains("reaches 7 mm from its middle") &&
                             Catch::Contains("file_unit = \"m\""));
}

TEST_CASE("edge points go to the same angle, or to the same share of the length") {
  preset::Preset p = curve(preset::CurveKind::ellipse, 120, 80, 0);
  p.actuation.boundary.kind = preset::CurveKind::superellipse;
  p.actuation.boundary.half_x_mm = p.actuation.boundary.half_y_mm = 75;
  for (const auto how : {Correspondence::angle, Correspondence::arc_length}) {
    p.actuation.correspondence = how;
    const auto scene = value_of(scene_of(p));
    double most = 0;
    for (Eigen::Index k = 0; k < scene.motion.begin.cols(); ++k) {
      const auto from = scene.motion.begin.col(k), to = scene.motion.end.col(k);
      CHECK(std::pow(from.x() / 120, 2) + std::pow(from.y() / 80, 2) == Approx(1).margin(1e-9));
      CHECK(std::pow(to.x() / 75, 4) + std::pow(to.y() / 75, 4) == Approx(1).margin(1e-9));
      const double cross = from.x() * to.y() - from.y() * to.x();
      most = std::max(most, std::abs(cross) / (from.norm() * to.norm()));
    }
    if (how == Correspondence::angle)
      CHECK(most < 1e-9);
    else
      CHECK(most > 0.01);
  }
}

TEST_CASE("a curve that cannot bound a footprint is refused, saying which") {
  preset::Preset p = curve(preset::CurveKind::polygon, 120, 80, 0.8);
  p.footprint.boundary.points = {{200, 0}, {300, 0}, {300, 100}, {200, 100}};
  CHECK_THAT(refused(p), Catch::Contains("origin"));
  p.footprint.boundary.points = {{-100, -100}, {100, 100}, {100, -100}, {-100, 100}};
  CHECK_THAT(refused(p), Catch::Contains("[footprint] boundary: "));
  p = curve(preset::CurveKind::circle, 120, 80, 0);
  p.actuation.boundary.kind = preset::CurveKind::spline;
  p.actuation.boundary.points = {{50, 0}, {50, 0}, {-50, -50}};
  CHECK_THAT(refused(p), Catch::Contains("[actuation] boundary: "));
}

TEST_CASE("a cylinder from a table of points is the cylinder") {
  preset::Preset p = on_net(preset::NetKind::cylinder, 80, 200);
  const record::Summary known = run_stills(p).summary;
  p.net.kind = preset::NetKind::profile;
  for (double z = -150; z <= 150; z += 50) p.net.profile.push_back({80, z});
  const record::Summary table = run_stills(p).summary;
  CHECK(table.joints == known.joints);
  CHECK(table.energies[Term::bend] == Approx(known.energies[Term::bend]).epsilon(1e-9));
  CHECK(table.max_deviation == Approx(known.max_deviation).margin(1e-9));
  // all of the profile, and more than there is of it
  p.net.length_mm = 0;
  CHECK(run_stills(p).summary.joints > known.joints);
  p.net.length_mm = 301;
  CHECK_THAT(refused(p), Catch::Contains("the profile of 7 points ends"));
}

TEST_CASE("translation nets from two curves: certified, near the net") {
  // on a saddle the equilibrium at its net is unstable, and the shell reaches one near it
  struct Curves {
    double u, v, height_u, height_v, near;
  };
  for (const auto& [u, v, height_u, height_v, near] :
       {Curves{40, 30, 54, -20, 0.005}, {40, 40, 40, 40, 0.01}}) {
    preset::Preset p = on_net(preset::NetKind::translation);
    p.footprint.placement = Placement::half;
    for (int k = -3; k <= 3; ++k) {
      p.net.curve_u.push_back({u * k, 0, height_u * (1 - k * k / 9.0)});
      p.net.curve_v.push_back({0, v * k, height_v * (1 - k * k / 9.0)});
    }
    // the flat footprint lies square to the curves
    const auto scene = value_of(scene_of(p));
    CHECK(scene.flat.axes.col(0).x() == Approx(1));
    CHECK(scene.flat.axes.col(1).y() == Approx(1));
    const record::Summary s = run_to_end(p, true).summary;
    CHECK(s.max_deviation < near);
    std::swap(p.net.curve_u, p.net.curve_v);
    CHECK_THAT(refused(p),
               Catch::Contains("curve_v of the translation net: got a curve to the right"));
  }
}

TEST_CASE("an outline of a drawing is a boundary, about its middle") {
  const TemporaryFolder folder;
  // a rectangle of 200 x 120 mm far off the origin, and one to draw it into
  const auto obj = [&](const char* name, double x, double y, double half_x, double half_y) {
    std::string text;
    for (const auto& [a, b] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}})
      text += fmt::format("v {} {} 0\n", x + a * half_x, y + b * half_y);
    REQUIRE(write_file(folder / name, text + "l 1 2 3 4 1\n"));
  };
  obj("flat.obj", 5000, 300, 100, 60);
  obj("built.obj", 5000, 300, 80, 50);
  const auto read = [&](const std::string& more) {
    REQUIRE(write_file(
        folder / "own.toml",
        "[footprint]\nkind = \"curve\"\nboundary = \"file\"\nfile = \"flat.obj\"\n" + more));
    return preset::read_preset_file(folder / "own.toml", {});
  };
  const auto scene = value_of(
      scene_of(value_of(read("[actuation]\nboundary = \"file\"\nfile = \"built.obj\"\n")).base));
  CHECK(scene.motion.begin.row(0).maxCoeff() == Approx(100));
  CHECK(scene.motion.begin.row(1).minCoeff() == Approx(-60));
  CHECK(scene.motion.end.row(0).maxCoeff() == Approx(80));
  CHECK(scene.motion.end.row(1).minCoeff() == Approx(-50));
  const auto scaled = value_of(read("[actuation]\nscale = 0.9\n"));
  CHECK(value_of(scene_of(scaled.base)).motion.end.row(0).maxCoeff() == Approx(90));
  CHECK_THAT(scaled.files.at(0), Catch::Contains("an outline of 4 points, 200 x 120 mm, in mm"));
  // the preset that a run writes contains the outline itself
  const auto again = value_of(preset::read_preset_text(preset::to_toml(scaled.base), "a", "a"));
  CHECK(value_of(scene_of(again.base)).motion.end.row(0).maxCoeff() == Approx(90));
  CHECK_THAT(refusal(read("[actuation]\nboundary = \"file\"\n")),
             Catch::Contains("expected its name in [actuation] file"));
}
