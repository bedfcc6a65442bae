// A formed shell that is stiffened and loaded: bolts and braces are added free of stress, loads and
// reactions are in balance, and all of them are removed again.

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/elastic/model.h"
#include "engine/scene/load_case.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;
using namespace gridshell::simulate;
using preset::StepKind;

namespace {

preset::Preset loaded_shell() {
  preset::Preset p = small_shell();
  p.rod.diameter_mm = 2.5;  // so stiff that the loads are far above round-off
  p.limits.max_strain = 0.05;
  p.rod.density_kg_m3 = 6450;
  p.loads.gravity_m_s2 = 9.81;
  p.loads.snow_N_m2 = 4000;
  p.loads.wind_N_m2 = 2400;
  p.load_case = {{.name = "snow", .snow = 1, .points = {}},
                 {.name = "half", .snow = 1, .snow_side = preset::SnowSide::x, .points = {}},
                 {.name = "wind", .dead = 0.5, .wind = 1, .points = {{0, 0, 0.8, 0, 0}}},
                 {.name = "edge", .edge = 1, .points = {}},
                 {.name = "pressure", .pressure = 1, .points = {}}};
  p.loads.edge_N_m = 50;
  p.loads.pressure_N_m2 = 3000;
  return p;
}

preset::Step step(StepKind kind) {
  preset::Step one;
  one.kind = kind;
  one.EA_N = 5000;
  return one;
}

void done(Simulation& simulation, const preset::Step& one) {
  const Report report = value_of(apply_step(simulation, one, unwatched));
  REQUIRE(report.end == Outcome::reached);
  CHECK(report.certificate.stable());
}

Eigen::Vector3d sum_of(const std::vector<NodeAction>& actions) {
  return std::accumulate(
      actions.begin(), actions.end(), Eigen::Vector3d(0, 0, 0),
      [](const Eigen::Vector3d& sum, const NodeAction& one) { return sum + one.force; });
}

/// Reactions of all constraints, on the finest mesh.
Eigen::Vector3d reactions(Simulation& simulation) {
  NestedShell& shell = simulation.shell();
  const int last = shell.levels() - 1;
  const Model& model = shell.model(last);
  const Assembly forces = shell.forces(last);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int node = 0; node < model.nodes; ++node)
    if (model.pinned(node)) sum += forces.gradient.col(node);
  return sum;
}

double stiffness_of_push(Simulation simulation) {
  REQUIRE(simulation.push(0, {0, 0, -0.05}, Across::free, unwatched).end == Outcome::reached);
  return -simulation.force(0).z() / 0.05;
}

}  // namespace

TEST_CASE("load cases: what is applied is what the supports bear, to 1e-9 of it") {
  Simulation simulation = formed(loaded_shell());
  const Eigen::Matrix3Xd shape = simulation.nodes();
  double plan = 0, half = 0, covered = 0;
  for (const Face& face : faces_of(simulation.scene().footprint)) {
    covered += area_of(face, shape).z();
    const double area = std::max(area_of(face, shape).z(), 0.0);  // none lies on overhangs
    plan += area;
    const double middle =
        shape.row(0).head(Eigen::Index(simulation.scene().footprint.joints.size())).mean();
    for (const int corner : face.corners)
      if (shape(0, corner) > middle) half += area / double(face.corners.size());
  }
  const Eigen::Vector3d before = reactions(simulation);
  const double weight =
      -sum_of(simulation.shell().model(simulation.shell().levels() - 1).loads).z();
  CHECK(before.z() == Approx(weight).epsilon(1e-7));
  // a circle's boundary from one edge point to the next
  const Eigen::Index joints = Eigen::Index(simulation.scene().footprint.joints.size());
  std::vector<Eigen::Vector3d> ring;
  for (Eigen::Index k = joints; k < joints + simulation.scene().motion.end.cols(); ++k)
    ring.push_back(shape.col(k));
  std::ranges::sort(ring, {}, [](const auto& at) { return std::atan2(at.y(), at.x()); });
  double around = 0;
  for (std::size_t k = 0; k < ring.size(); ++k)
    around += (ring[(k + 1) % ring.size()] - ring[k]).norm();
  for (const char* name : {"snow", "half", "wind", "edge", "pressure"}) {
    CAPTURE(name);
    preset::Step load = step(StepKind::load);
    load.load_case = name;
    load.factor = 0.8;
    done(simulation, load);
    const std::string of = name;
    const bool turns = std::string(name) == "pressure";
    const Eigen::Vector3d field =
        turns ? Eigen::Vector3d(0, 0, -0.8 * 3e-3 * covered) : sum_of(simulation.field());
    if (of == "snow") CHECK(field.z() == Approx(-0.8 * 4e-3 * plan).epsilon(1e-10));
    if (of == "half") CHECK(field.z() == Approx(-0.8 * 4e-3 * half).epsilon(1e-3));
    if (of == "wind") CHECK(field.x() > 0.8 * 0.8);
    if (of == "edge") CHECK(field.z() == Approx(-0.8 * 0.05 * around).epsilon(1e-10));
    const double dead = of == "wind" ? 1.4 : 1;
    Eigen::Vector3d all = field;
    all.z() -= dead * weight;
    const Eigen::Vector3d left = reactions(simulation) + all;
    CAPTURE(left.norm() / all.norm());
    CHECK(left.norm() < 1e-9 * all.norm());
    // the extrapolated loads and reactions of frames are in balance, too
    const record::Frame frame = frame_of(simulation);
    CHECK((frame.loads_N.rowwise().sum() - all).norm() < 1e-9 * all.norm());
    CHECK((frame.loads_N + frame.reactions_N).rowwise().sum().norm() < 1e-9 * all.norm());
    load.factor = 0;
    done(simulation, load);
    CHECK(simulation.cases.empty());
    CHECK(sum_of(simulation.field()).norm() < 1e-15);
    CHECK(max_column_norm(simulation.nodes() - shape) < 1e-3);
  }
}

TEST_CASE(
    "bolts and braces change nothing as they are added, stiffen afterwards, and are removed "
    "again") {
  preset::Preset p = loaded_shell();
  // edges are centred on joints that will be bolted
  p.step = {step(StepKind::tighten)};
  Simulation simulation = formed(p);
  const Eigen::Matrix3Xd shape = simulation.nodes();
  const double loose = stiffness_of_push(formed(loaded_shell()));
  const double near = 0.01 * simulation.scene().footprint.spacing;
  const Checkpoint before = simulation.save();
  done(simulation, step(StepKind::tighten));
  CHECK(max_column_norm(simulation.nodes() - shape) < near);
  const double bolted = simulation.energies()[Term::shear];
  CHECK(bolted >= 0);
  CHECK(bolted < 1e-3 * simulation.energies()[Term::bend]);
  done(simulation, step(StepKind::brace));
  CHECK(simulation.rods().braces.size() == 2 * simulation.scene().footprint.cells.size());
  const Eigen::VectorXd in_braces = frame_of(simulation).brace_force_N;
  CHECK(std::size_t(in_braces.size()) == simulation.rods().braces.size());
  CHECK(in_braces.allFinite());
  CHECK(max_column_norm(simulation.nodes() - shape) < near);
  const Checkpoint stiff = simulation.save();
  const Eigen::Matrix3Xd braced = simulation.nodes();
  REQUIRE(simulation.push(0, {0, 0, -0.05}, Across::free, unwatched).end == Outcome::reached);
  CHECK(-simulation.force(0).z() / 0.05 > 1.5 * loose);
  simulation.restore(stiff);
  CHECK(max_column_norm(simulation.nodes() - braced) == 0);
  preset::Step out = step(StepKind::release);
  out.what = preset::Released::braces;
  done(simulation, out);
  out.what = preset::Released::bolts;
  done(simulation, out);
  CHECK(!simulation.rods().bolts);
  CHECK(max_column_norm(simulation.nodes() - shape) < 1e-3);
  CHECK(refusal(apply_step(simulation, out, unwatched), Fault::bad_input) ==
        "got no bolts, expected some to take out");
  simulation.restore(before);
  CHECK(max_column_norm(simulation.nodes() - shape) == 0);
}

TEST_CASE("errors are right after bolts have fixed a shape, which stays where it is") {
  preset::Preset p = small_shell();
  p.step = {step(StepKind::tighten)};
  const auto bolted = [&](const LevelPlan& plan) {
    Simulation simulation = formed(p, plan);
    const Eigen::Matrix3Xd shape = simulation.nodes();
    const double error_mm = simulation.certificate().error_estimate_mm;
    done(simulation, p.step[0]);
    CHECK(max_column_norm(simulation.nodes() - shape) < (plan.extrapolate ? 0.1 : 1) * error_mm);
    REQUIRE(simulation.push(0, {0, 0, -2}, Across::free, unwatched).end == Outcome::reached);
    return simulation;
  };
  for (const double stiffness_Nmm : {3, 0}) {  // 0: rigid
    p.step[0].stiffness_Nmm = stiffness_Nmm;
    const LevelPlan coarse = stiffness_Nmm > 0 ? plan_levels(1e-4) : plan_of_mesh(16);
    const Simulation rough = bolted(coarse), fine = bolted(plan_levels(1e-7));
    record::Frame errors;
    rough.put_push_errors(errors);
    CAPTURE(stiffness_Nmm);
    CHECK(std::abs(rough.force(0).z() - fine.force(0).z()) < errors.push_error_N);
    const int joints = rough.shell().finest().joints;
    CHECK(max_column_norm(rough.nodes().leftCols(joints) - fine.nodes().leftCols(joints)) <
          rough.certificate().error_estimate_mm);
  }
}

TEST_CASE("angles of tightened joints have the error that they had when they were tightened") {
  preset::Preset p = circle(6, 66, 0.8 * 66, 3);
  p.rod.shear_GPa = 31;
  p.rod.width_mm = 1;
  p.rod.thickness_mm = 0.25;
  p.step = {step(StepKind::tighten)};
  const auto tightened_to = [&](double tolerance) {
    p.accuracy.tolerance = tolerance;
    return last_frame(run_to_end(p));
  };
  const record::Frame rough = tightened_to(1e-3), fine = tightened_to(1e-6);
  const double error = rough.one_angle_error_deg + fine.one_angle_error_deg;
  CHECK(error < 1);
  CHECK(std::abs(rough.joint_angle_deg - fine.joint_angle_deg) <
        rough.joint_angle_error_deg + fine.joint_angle_error_deg);
  CHECK(std::abs(rough.largest_joint_angle_deg - fine.largest_joint_angle_deg) < error);
  CHECK(std::abs(rough.smallest_joint_angle_deg - fine.smallest_joint_angle_deg) < error);
}

TEST_CASE("a pushed joint keeps its depth as braces are added") {
  preset::Preset p = small_shell();
  Simulation simulation = formed(p, plan_levels(1e-4));
  simulation.constraint_origins[0] = simulation.nodes().col(0);
  REQUIRE(simulation.push(0, {0, 0, -2}, Across::free, unwatched).end == Outcome::reached);
  done(simulation, step(StepKind::brace));
  record::Frame frame;
  simulation.put_push(frame);
  CHECK(frame.depth_mm == Approx(2).epsilon(1e-6));
}

TEST_CASE("one unknown cell among known ones is named, and nothing is braced") {
  Simulation simulation = formed(small_shell(), plan_levels(1e-2));
  const FootprintCell& known = simulation.scene().footprint.cells.front();
  preset::Step brace = step(StepKind::brace);
  brace.cells = {{double(known.i), double(known.j)}, {40, 2}};
  CHECK(refusal(apply_step(simulation, brace, unwatched), Fault::bad_input) ==
        "cells: got [40, 2], expected a cell of the footprint");
  CHECK(simulation.rods().braces.empty());
  brace.cells.pop_back();
  done(simulation, brace);
  CHECK(simulation.rods().braces.size() == 2);
}

TEST_CASE("what is made stiff too early, or is not there, is named") {
  const auto scene = shared_scene(loaded_shell());
  Simulation flat = value_of(Simulation::open(scene, plan_levels(1e-2)));
  CHECK(flat.begin_flat().end == Outcome::reached);
  CHECK_THAT(refusal(apply_step(flat, step(StepKind::tighten), unwatched), Fault::bad_input),
             Catch::Contains("expected a formed shell"));
  preset::Preset p = loaded_shell();
  p.step = {step(StepKind::brace)};
  p.step[0].cells = {{40, 2}};
  CHECK(refusal(plan(p), Fault::bad_input) ==
        "[[step]] 1 cells: got [40, 2], expected a cell of the footprint");
  p.step = {step(StepKind::move)};
  p.step[0].edge_points = {{1e9, 0, 0, 1}};
  CHECK_THAT(refusal(plan(p), Fault::bad_input),
             Catch::Contains("[[step]] 1 edge_points: got 1e+09, expected 0 to "));
  p.step = {step(StepKind::release)};
  p.step[0].what = preset::Released::braces;
  CHECK(refusal(plan(p), Fault::bad_input) ==
        "[[step]] 1 what: got braces, expected a step \"brace\" before it that adds them");
}
