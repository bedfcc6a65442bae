// The paper's point loads on hemispheres, and pushes to their end.
#include <cmath>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

enum class Case { pole_inward, pole_outward, oblique_inward };

preset::Preset hemisphere(Case which, double radius_mm, Placement placement, double depth = 0.1,
                          int frames = 11) {
  preset::Preset p = on_net(preset::NetKind::sphere, radius_mm);
  p.footprint.placement = placement;
  p.indentation.depth = depth;
  if (which == Case::pole_outward) p.indentation.direction = preset::Direction::outward;
  if (which == Case::oblique_inward) p.indentation.latitude_deg = p.indentation.longitude_deg = 45;
  p.movie.frames = frames;
  return p;
}

double work_of(const record::FrameList& frames) {
  double work = 0;
  for (std::size_t k = 1; k < frames.size(); ++k)
    work += 0.5 * (frames[k].force_N + frames[k - 1].force_N) *
            (frames[k].depth_mm - frames[k - 1].depth_mm);
  return work;
}

double energy_of(const record::Frame& frame) {
  return frame.energies[Term::bend] + frame.energies[Term::stretch];
}

}  // namespace

TEST_CASE("three point loads: certified frames, depth as requested, the force does the work") {
  for (const Case which : {Case::pole_inward, Case::pole_outward, Case::oblique_inward}) {
    const auto outcome = run(hemisphere(which, 120, Placement::on_axis));
    const auto& frames = outcome.trajectory.frames;
    REQUIRE(frames.size() == 11);
    CHECK(outcome.summary.limit == record::Limit::none);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      CHECK(frames[k].depth_mm == Approx(1.2 * double(k)).margin(1e-12));
      CHECK(frames[k].negative_pivots == 0);
      CHECK((frames[k].kind == "interpolated" || frames[k].residual_N < 1e-6));
      CHECK(frames[k].event.empty());
      CHECK(frames[k].K_bins.col(2).sum() == double(outcome.summary.cells));
    }
    CHECK(std::abs(frames.front().force_N) < 1e-6);
    for (std::size_t k = 1; k < frames.size(); ++k)
      CHECK(frames[k].force_N > frames[k - 1].force_N);
    // trapezoids over ten steps
    const double gained = energy_of(frames.back()) - energy_of(frames.front());
    CHECK(work_of(frames) == Approx(gained).epsilon(5e-3));
  }
}

TEST_CASE("the pushed joint goes straight down its normal and not sideways") {
  for (const auto lateral : {preset::Lateral::free, preset::Lateral::held}) {
    preset::Preset p = hemisphere(Case::oblique_inward, 120, Placement::on_axis, 0.1, 3);
    p.indentation.lateral = lateral;
    const auto outcome = run(p);
    const Eigen::Matrix3Xd after = joints_of(outcome.trajectory);
    const Eigen::Matrix3Xd before = outcome.trajectory.frames[0].nodes.leftCols(after.cols());
    // the joint nearest to latitude and longitude of 45 degrees on the net
    const Eigen::Vector3d there(0.5, 0.5, std::sqrt(0.5));
    const Eigen::Matrix3Xd net = outcome.trajectory.layout.net_nodes.leftCols(before.cols());
    Eigen::Index joint = 0;
    (there.transpose() * net).maxCoeff(&joint);
    const Eigen::Vector3d normal = net.col(joint).normalized();
    const Eigen::Vector3d moved = after.col(joint) - before.col(joint);
    CHECK(moved.dot(normal) == Approx(-12).margin(1e-9));
    const double sideways = (moved - moved.dot(normal) * normal).norm();
    if (lateral == preset::Lateral::held)
      CHECK(sideways < 1e-9);
    else
      CHECK(sideways > 0.1);
  }
}

TEST_CASE("pole cases keep four mirror planes, at half placement one diagonal") {
  const double half = std::sqrt(0.5);
  for (const Case which : {Case::pole_inward, Case::pole_outward}) {
    const auto outcome = run(hemisphere(which, 120, Placement::on_axis));
    const Eigen::Matrix3Xd joints = joints_of(outcome.trajectory);
    for (const Eigen::Vector2d& normal :
         {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(half, half),
          Eigen::Vector2d(half, -half)})
      CHECK(mirror_defect(joints, normal) < 1e-8 * 120);
  }
  const auto outcome = run(hemisphere(Case::pole_inward, 120, Placement::half));
  const Eigen::Matrix3Xd joints = joints_of(outcome.trajectory);
  CHECK(mirror_defect(joints, {half, -half}) < 1e-8 * 120);
  CHECK(mirror_defect(joints, {half, half}) > 1e-2 * 120);
}

TEST_CASE("force, total K and reach converge at second order over three meshes", "[standard]") {
  for (const double radius : {76.394, 120.0})
    for (const auto placement : {Placement::half, Placement::on_axis})
      for (const Case which : {Case::pole_inward, Case::pole_outward, Case::oblique_inward}) {
        double force[4], total[4], most[4];
        for (int k = 0; k < 4; ++k) {
          preset::Preset p = hemisphere(which, radius, placement);
          p.accuracy.edges_per_segment = 4 << k;
          const auto outcome = run(p);
          const record::Frame& last = last_frame(outcome);
          REQUIRE(outcome.trajectory.frames.size() == 11);
          force[k] = last.force_N, total[k] = last.total_K, most[k] = last.cell_K.maxCoeff();
        }
        INFO(radius << " " << int(placement) << " " << int(which));
        const auto order = [](const double* value) {
          return std::log2(std::abs((value[2] - value[1]) / (value[3] - value[2])));
        };
        CHECK(order(force) == Approx(2).margin(0.3));
        CHECK(order(total) == Approx(2).margin(0.3));
        CHECK(order(most) == Approx(2).margin(0.3));
      }
}

TEST_CASE("outward at the pole the rods run into their length: locking, certified up to there",
          "[standard]") {
  std::vector<double> depths;
  for (const int frames : {3, 9, 21}) {
    const auto outcome = run(hemisphere(Case::pole_outward, 120, Placement::on_axis, 0.4, frames));
    CHECK(outcome.summary.limit == record::Limit::locking);
    const record::Frame& last = last_frame(outcome);
    CHECK(last.event == "locking");
    // on the branch that led there
    CHECK(last.force_N > outcome.trajectory.frames[outcome.trajectory.frames.size() - 2].force_N);
    CHECK(last.negative_pivots == 0);
    CHECK(last.residual_N < 1e-6);
    CHECK(last.depth_mm / 120 == Approx(0.24).margin(0.03));
    CHECK(last.force_N < 5);
    depths.push_back(last.depth_mm);
  }
  // frames only sample the path
  CHECK(depths[0] == Approx(depths[2]).margin(1e-2));
  CHECK(depths[1] == Approx(depths[2]).margin(1e-2));
}

namespace {

void check_deep_push(Placement placement, Case which) {
  const auto outcome = run(hemisphere(which, 120, placement, 0.6, 31));
  for (const record::Frame& frame : outcome.trajectory.frames) {
    // between a loss of stability and the next equilibrium a frame says that it is not stable
    CHECK((frame.negative_pivots == 0 || frame.event.starts_with("unstable")));
    CHECK((frame.kind == "interpolated" || frame.residual_N < 1e-5));
  }
  const bool whole = last_frame(outcome).depth_mm == Approx(72);
  CHECK((whole || outcome.summary.limit != record::Limit::none));
}

}  // namespace

TEST_CASE("a deep push ends certified or at a named limit", "[standard]") {
  check_deep_push(Placement::half, Case::pole_inward);
}

TEST_CASE("deep pushes of both placements, upright and oblique, end so too", "[full]") {
  check_deep_push(Placement::half, Case::oblique_inward);
  check_deep_push(Placement::on_axis, Case::pole_inward);
  check_deep_push(Placement::on_axis, Case::oblique_inward);
}

TEST_CASE("unloading follows the path back, after a snap on another branch", "[standard]") {
  preset::Preset p = hemisphere(Case::pole_inward, 120, Placement::on_axis, 0.1, 9);
  p.indentation.unload = true;
  const auto there_and_back = run(p);
  const auto& frames = there_and_back.trajectory.frames;
  REQUIRE(frames.size() == 9);
  for (int k = 0; k < 4; ++k)
    CHECK((frames[k].nodes - frames[8 - k].nodes).cwiseAbs().maxCoeff() <
          frames[k].error_estimate_mm + frames[8 - k].error_estimate_mm);

  preset::Preset fig1;
  fig1.imperfection.size = 0;  // the state with two mirrors
  fig1.indentation.at = preset::IndentationPosition::highest;
  fig1.indentation.depth = 0.5;
  fig1.indentation.unload = true;
  fig1.movie.frames = 21;
  const auto snapped = run(fig1);
  CHECK(snapped.summary.limit == record::Limit::snap);
  CHECK_THAT(snapped.summary.limit_reason,
             Catch::Contains("on its mesh the path has a limit point at 33.69"));
  const auto& way = snapped.trajectory.frames;
  REQUIRE(way.size() == 21);
  // loading and unloading differ between their two snaps: hysteresis
  const auto snaps = [&](int from, int to) {
    int count = 0;
    for (int k = from; k < to; ++k) count += way[std::size_t(k)].event.starts_with("snap");
    return count;
  };
  CHECK(snaps(0, 11) == 1);
  CHECK(snaps(11, 21) == 1);
  CHECK(way[5].depth_mm == Approx(way[15].depth_mm));
  CHECK(way[5].force_N > way[15].force_N + 0.02);
  CHECK((way.front().nodes - way.back().nodes).cwiseAbs().maxCoeff() < 1e-6);
  for (const record::Frame& frame : way) CHECK(frame.negative_pivots == 0);
}

TEST_CASE("a figure of a push has the load steps of its path, so that a snap is where it is",
          "[standard]") {
  preset::Preset fig1;
  fig1.imperfection.size = 0;
  fig1.indentation.at = preset::IndentationPosition::highest;
  fig1.indentation.depth = 0.3;
  const auto drawn = run_stills(fig1);
  const auto& frames = drawn.trajectory.frames;
  CHECK(frames.size() > 70);
  int snaps = 0;
  for (std::size_t k = 1; k < frames.size(); ++k) {
    CHECK(frames[k].index == int(k));
    CHECK(frames[k].progress > frames[k - 1].progress);
    if (!frames[k].event.starts_with("snap")) continue;
    ++snaps;
    CHECK(frames[k].depth_mm - frames[k - 1].depth_mm < frames.back().depth_mm / 61);
  }
  CHECK(snaps == 1);
}

TEST_CASE("a push that ends at a limit after snaps names both", "[standard]") {
  preset::Preset p;
  p.imperfection.size = 0;  // the state with two mirrors
  p.indentation.at = preset::IndentationPosition::highest;
  p.indentation.depth_mm = 150;
  p.movie.frames = 12;
  const auto [trajectory, summary] = run(p);
  CHECK(summary.limit == record::Limit::locking);
  // no strain is near its limit, and that of compression is no reason
  CHECK(std::abs(summary.largest_strain) < 0.9 * p.limits.max_strain);
  CHECK_THAT(summary.limit_reason, Catch::Contains("the push met 100 times its first stiffness"));
  int snaps = 0;
  for (const record::Frame& frame : trajectory.frames) snaps += frame.event.starts_with("snap");
  CHECK(snaps > 0);
  CHECK(trajectory.frames.back().event == "locking");
  CHECK(trajectory.frames.back().depth_mm < 150);
}

TEST_CASE("a ring is pushed at any of its joints, wherever its drawing begins") {
  constexpr int points = 16;
  const auto pushed = [](int begin) {
    preset::NetworkData file;
    for (int k = 0; k < points; ++k) {
      const double angle = 2 * M_PI * k / points;
      file.points.push_back({40 * std::cos(angle), 40 * std::sin(angle), 0});
    }
    file.points.insert(file.points.end(),
                       {{-80, 0, 0}, {80, 0, 0}, {0, -80, 0}, {0, 80, 0}, {0, 0, 0}});
    file.rods.resize(1);
    for (int k = 0; k <= points; ++k) file.rods[0].push_back((begin + k) % points);
    file.rods.insert(file.rods.end(), {{16, 8, 20, 0, 17}, {18, 12, 20, 4, 19}});
    preset::Preset p = network(file, 4);
    p.rod.shear_GPa = 31;
    p.actuation.scale = 0.93;
    p.indentation.joint = {0, 0};
    p.indentation.depth_mm = 1;
    return run_to_end(p).trajectory.frames.back();
  };
  const record::Frame at_begin = pushed(0), inside = pushed(2);
  CHECK(inside.force_N > 1e-4);
  CHECK(at_begin.force_N == Approx(inside.force_N).epsilon(1e-6));
}

TEST_CASE("a joint that is not there is refused") {
  preset::Preset p = hemisphere(Case::pole_inward, 120, Placement::on_axis);
  p.indentation.joint = {40, 0};
  CHECK_THAT(refused_run(p),
             Catch::Contains("[indentation] joint: got [40, 0], expected [i, j] of one of"));
}

TEST_CASE("pushes on the twist model are those of the bend model, to a millionth of rho") {
  for (const Case which : {Case::pole_inward, Case::pole_outward}) {
    preset::Preset p = hemisphere(which, 120, Placement::on_axis, 0.05, 3);
    p.accuracy.edges_per_segment = 4;
    p.accuracy.tolerance = 1e-6;
    const auto bend = run(p);
    p.accuracy.model = RodModel::twist;
    p.rod.shear_GPa = 31;
    const auto twist = run(p);
    REQUIRE(twist.trajectory.frames.size() == bend.trajectory.frames.size());
    CHECK(last_frame(twist).force_N == Approx(last_frame(bend).force_N).epsilon(1e-5));
    CHECK(last_frame(twist).energies[Term::twist] < 1e-10);
    CHECK(distance(bend, twist) < 1e-6 * 120);
  }
}
