// Joints with laws of their own, and shells that are deployed by opening them.
#include <numbers>

#include "engine/elastic/assembly.h"
#include "engine/elastic/model.h"
#include "engine/elastic/shell_rods.h"
#include "tests/engine/elastic/differences.h"
#include "tests/engine/simulate/mixed_network.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

constexpr double degree = std::numbers::pi / 180;

preset::Preset network_of_rods(const preset::NetworkData& file, int edges) {
  preset::Preset p = network(file, edges);
  p.rod.diameter_mm = 2, p.rod.young_GPa = 10, p.rod.shear_GPa = 4;
  return p;
}

/// Two families of three rods that cross at `angle`, in steps of 30 mm, fixed against rigid motions
/// only.
preset::NetworkData rhombi(double angle) {
  preset::NetworkData file;
  const auto at = [&](double p, double q) {
    return std::vector<double>{(p + q) * std::cos(angle / 2), (p - q) * std::sin(angle / 2), 0};
  };
  for (const double p : {-45, -30, 0, 30, 45})
    for (const double q : {-45, -30, 0, 30, 45}) file.points.push_back(at(p, q));
  for (const int k : {1, 2, 3}) {
    file.rods.push_back({5 * k, 5 * k + 1, 5 * k + 2, 5 * k + 3, 5 * k + 4});
    file.rods.push_back({k, 5 + k, 10 + k, 15 + k, 20 + k});
    for (const int end : {5 * k, 5 * k + 4, k, 20 + k}) file.free.push_back(end);
  }
  file.supports = {{12}, {18}, {16}};
  file.springs = {{12, 10, 10, 10}, {18, 0, 10, 10}, {16, 0, 0, 10}};
  return file;
}

preset::Step opened(double degrees, double stiffness) {
  preset::Step step;
  step.kind = preset::StepKind::open;
  step.angle_deg = degrees;
  step.stiffness_Nmm = stiffness;
  return step;
}

/// The rhombi as a shell that is no mechanism: with hinges and a very small stiffness in shear.
preset::Preset linkage() {
  preset::Preset p = network_of_rods(rhombi(50 * degree), 2);
  p.joints.twist_Nmm = 1e3, p.joints.shear_Nmm = 1e-3;
  return p;
}

/// The energy of a network as drawn.
Energies energy_drawn(const preset::NetworkData& file, preset::EndKind ends,
                      bool as_drawn = false) {
  preset::Preset p = network_of_rods(file, 3);
  p.rod.width_mm = 3, p.rod.thickness_mm = 1;
  p.joints.twist_Nmm = as_drawn ? 0 : 7, p.joints.shear_Nmm = 2;
  p.rod.as_drawn = as_drawn;
  p.ends.kind = ends;
  const Scene scene = value_of(scene_of(p));
  CHECK(scene.rod_model == RodModel::twist);
  const RodMesh mesh = mesh_rods(scene.footprint, 3);
  const Model model = value_of(build_model(mesh, scene.rods, scene.rod_model));
  Eigen::Matrix3Xd nodes = drawn_nodes(mesh, scene.flat);
  return energies_of(model, start_state(model, columns_of(mesh, model, nodes)));
}

}  // namespace

TEST_CASE("a twisted network in space has one energy however it is turned, mirrored or listed") {
  const preset::NetworkData file = mixed_network();
  for (const auto ends : {preset::EndKind::pinned, preset::EndKind::clamped}) {
    const Energies drawn = energy_drawn(file, ends);
    CHECK(drawn[Term::bend] > 1);
    CHECK(drawn[Term::joint] > 1e-4);
    for (const double degrees : {40.0, 170.0})
      for (const preset::NetworkData& same : same_otherwise(file, degrees * degree)) {
        const Energies other = energy_drawn(same, ends);
        for (const Term term : {Term::bend, Term::joint, Term::shear, Term::twist})
          CHECK(other[term] == Approx(drawn[term]).epsilon(1e-12).margin(1e-12));
      }
  }
}

TEST_CASE(
    "rods cut as they are drawn lie there without stress, in space or a ring, ends fixed or not") {
  preset::NetworkData vault = mixed_network(), ring;
  vault.joint_laws = {{6, -1, 0}};
  // a polygon of 24 corners, and a bow
  ring.rods.resize(1);
  for (int k = 0; k < 24; ++k) {
    ring.points.push_back({50 * std::cos(15 * k * degree), 50 * std::sin(15 * k * degree), 0});
    ring.rods[0].push_back(k);
  }
  ring.rods[0].push_back(0);
  ring.points.insert(ring.points.end(), {{0, 20, 0}, {-90, 0, 0}});
  ring.rods.push_back({0, 24, 12, 25});
  ring.supports = {{6, 0, 50, 0}, {18, 0, -50, 0}, {0, 50, 0, 0}, {25}};
  for (const preset::NetworkData& file : {vault, ring}) {
    for (const auto ends : {preset::EndKind::pinned, preset::EndKind::clamped})
      CHECK(std::abs(energy_drawn(file, ends, true).total()) < 1e-18);
    CHECK(energy_drawn(file, preset::EndKind::pinned).total() > 1);
  }
}

TEST_CASE("joints of three rods count equally, whichever the file lists first") {
  preset::NetworkData file;
  file.points = {{-50, 0, 0},  {50, 0, 0},   {-25, -43, 2}, {25, 43, 2},
                 {-25, 43, 4}, {25, -43, 4}, {0, 0, 10}};
  const std::vector<std::vector<int>> rods{{0, 6, 1}, {2, 6, 3}, {4, 6, 5}};
  std::vector<double> found;
  for (const std::vector<std::size_t>& order :
       {std::vector<std::size_t>{0, 1, 2}, {1, 2, 0}, {2, 1, 0}}) {
    file.rods.clear();
    for (const std::size_t k : order) file.rods.push_back(rods[k]);
    found.push_back(energy_drawn(file, preset::EndKind::pinned).total());
  }
  CHECK(found[1] == Approx(found[0]).epsilon(1e-12));
  CHECK(found[2] == Approx(found[0]).epsilon(1e-12));
}

TEST_CASE("a hinge that tilts twists the rod that it is on, as in closed form") {
  // a slim rod clamped at both ends; a stiff one across, whose ends are moved about it by springs
  const double psi = 0.05, a = 100, b = 40, k = 1e5;
  preset::NetworkData file = cross(a, b);
  file.diameters = {2, 10};
  file.supports = {{2, 0, -b * std::cos(psi), -b * std::sin(psi)},
                   {3, 0, b * std::cos(psi), b * std::sin(psi)}};
  file.springs = {{2, k, k, k}, {3, k, k, k}};
  file.joint_laws = {{4, 0, -1}};
  preset::Preset p = network_of_rods(file, 4);
  p.ends.kind = preset::EndKind::clamped;
  const auto slim = circular_material(2, 10, 4), stiff = circular_material(10, 10, 4);
  // the hub turns by M (a/(2 GJ) + b/(6 EI) + 1/(2 k b^2))
  const double give = a / (2 * slim.GJ) + b / (6 * stiff.EI1) + 1 / (2 * k * b * b);
  const auto outcome = run(p);
  CAPTURE(outcome.summary.limit_reason);
  CHECK(outcome.summary.stable);
  CHECK(outcome.summary.energies.total() == Approx(0.5 * psi * psi / give).epsilon(2e-3));
  CHECK(outcome.summary.energies[Term::twist] > 0.8 * outcome.summary.energies.total());
}

TEST_CASE("rhombi of straight rods open in the flat, against their shear alone") {
  preset::Preset p = linkage();
  p.step = {opened(80, 100), opened(95, 100)};
  const auto outcome = run(p);
  CAPTURE(outcome.summary.limit_reason);
  REQUIRE(outcome.summary.steps.size() == 2);
  CHECK_THAT(outcome.summary.steps[0], Catch::Contains("joints at 80.00 degrees on average"));
  CHECK_THAT(outcome.summary.steps[1], Catch::Contains("joints at 95.00 degrees on average"));
  // nine joints by 45 degrees
  CHECK(outcome.summary.energies.total() ==
        Approx(0.5 * 9 * 1e-3 * std::pow(45 * degree, 2)).epsilon(1e-3));
  CHECK(outcome.summary.height_mm == Approx(0).margin(1e-6));
}

TEST_CASE("one joint opens all rhombi, and what is wrong with a step is reported") {
  preset::Preset p = linkage();
  preset::Step step = opened(0, 100);
  step.angles = {{12, 0, 70}};
  p.step = {step};
  CHECK_THAT(run(p).summary.steps[0], Catch::Contains("joints at 70.00 degrees on average"));
  p.step[0].angles = {{3, 0, 70}};
  CHECK_THAT(refused_run(p), Catch::Contains("got [3, 0], expected a joint where two rods cross"));
  p.step[0].angles = {{12, 0, 70}, {12, 0, 80}};
  CHECK_THAT(refused_run(p), Catch::Contains("got [12, 0] twice"));
  p.step = {opened(179.5, 100)};
  CHECK_THAT(refused_run(p), Catch::Contains("expected 1 to 179"));
}

TEST_CASE("bolts of another stiffness are replaced with their torque before they open") {
  // all joints of the rhombi have one angle, which their shear would have at 50 degrees
  preset::Preset p = linkage();
  const double shear = 1e-3, hard = 4e-3, soft = 2e-3;
  const auto angle_of = [](const simulate::ExperimentResult& outcome) {
    return last_frame(outcome).joint_angle_deg;
  };
  // nine springs against nine shears
  const double first = (shear * 50 + hard * 80) / (shear + hard);
  p.step = {opened(80, hard)};
  CHECK(angle_of(run(p)) == Approx(first).epsilon(1e-4));
  // the softer bolts have larger target angles, so that their torque is the same; one of them gets
  // another target
  const double strives = first + hard / soft * (80 - first);
  preset::Step one = opened(0, soft);
  one.angles = {{12, 0, 120}};
  p.step.push_back(one);
  CHECK(angle_of(run(p)) ==
        Approx((shear * 50 + soft * (8 * strives + 120) / 9) / (shear + soft)).epsilon(1e-4));
  // a mean angle is reached whatever they strove for, and rigid bolts are replaced too
  p.step.back() = opened(95, 0);
  p.step.back().drive = preset::JointDrive::mean;
  CHECK(angle_of(run(p)) == Approx(95).epsilon(1e-4));
  p.step.push_back(opened(95, soft));
  CHECK(angle_of(run(p)) == Approx((shear * 50 + soft * 95) / (shear + soft)).epsilon(1e-4));
}

TEST_CASE("bolts of laths cut with corners are free of stress on every mesh") {
  const Scene scene = value_of(scene_of(shipped("lit_xshell_waist")));
  const auto lying = [&](const RodMesh& mesh, const Model& model) {
    return start_state(model, columns_of(mesh, model, drawn_nodes(mesh, scene.flat)));
  };
  ShellRods rods = scene.rods;
  const RodMesh fine = mesh_rods(scene.footprint, 4), coarse = mesh_rods(scene.footprint, 2);
  const Model loose = value_of(build_model(fine, rods, RodModel::twist));
  rods.bolts = std::make_shared<const Bolts>(tightened(fine, loose, lying(fine, loose), 2000));
  for (const RodMesh& mesh : {coarse, fine}) {
    const Model model = value_of(build_model(mesh, rods, RodModel::twist));
    CHECK(energies_of(model, lying(mesh, model)).total() < 1e-18);
  }
}

TEST_CASE("an X-shell that its joints open leaves the flat at a branch and bears on nothing",
          "[full]") {
  preset::Preset p = shipped("lit_xshell_lens");
  p.movie.frames = 3;
  const auto outcome = run_to_end(p);
  CHECK_THAT(outcome.summary.limit_reason, Catch::Contains("branches"));
  CHECK_THAT(outcome.summary.steps[0], Catch::Contains("joints at 79.95 degrees on average"));
  // on all its meshes 104.6 mJ, on 4 and 16 edges alone 106.5 and 104.7
  CHECK(outcome.summary.energies.total() == Approx(104.58).epsilon(2e-3));
  CHECK(outcome.summary.height_mm == Approx(20.85).epsilon(2e-3));
  CHECK(outcome.summary.energies[Term::support] < 1e-9);
}

TEST_CASE("stiff springs cost a path no more steps than soft ones") {
  preset::Preset p = shipped("lit_xshell_lens");
  p.movie.frames = 2;
  p.accuracy.edges_per_segment = 4;
  p.step[0].stiffness_Nmm *= 100;
  const auto outcome = run_to_end(p);
  CHECK(outcome.summary.stable);
  // 6364 if torques were computed from the angles that a step predicts
  CHECK(outcome.summary.factorizations < 400);
}

namespace {

/// Naturally straight strips on hinges: without springs they close to a bundle.
preset::Preset straight_strips() {
  preset::Preset p = shipped("lit_xshell_hyperboloid");
  p.movie.frames = 2;
  p.rod.as_drawn = false;
  p.joints.twist_Nmm = 1e9;
  p.accuracy.edges_per_segment = 4;
  return p;
}

}  // namespace

TEST_CASE("straight strips that close without springs start from the angles as drawn",
          "[standard]") {
  preset::Preset p = straight_strips();
  const auto outcome = run(p);  // it snaps out of the plane on so coarse a mesh
  CHECK(outcome.summary.stable);
  CHECK_THAT(outcome.summary.steps[0], Catch::Contains("fixed the angles as drawn") &&
                                           Catch::Contains("joint [1, 0] and 100 others close") &&
                                           Catch::Contains("\"shear_Nmm\": 0.1"));
  CHECK(last_frame(outcome).joint_angle_deg == Approx(72.1).epsilon(2e-3));
  p.step.clear();
  CHECK_THAT(refused_run(p), Catch::Contains("joint [1, 0] and 100 others close"));
}

TEST_CASE("one torque at all joints brings their mean angle to the target, strips straight or not",
          "[standard]") {
  preset::Preset p = straight_strips();
  p.step[0].drive = preset::JointDrive::mean;
  for (const bool as_drawn : {false, true}) {
    CAPTURE(as_drawn);
    p.rod.as_drawn = as_drawn;
    const auto outcome = run_to_end(p);
    const record::Frame& frame = last_frame(outcome);
    CHECK(frame.joint_angle_deg == Approx(72.1).epsilon(1e-4));
    CHECK(frame.largest_joint_angle_deg - frame.smallest_joint_angle_deg > 5);
    const double torque = frame.torque_Nmm.maxCoeff();
    CHECK(torque > 0.1);
    CHECK(frame.torque_Nmm.minCoeff() == Approx(torque).epsilon(1e-9));
    // the torque is the work by the angle: dE = 101 T d(mean angle)
    preset::Preset near = p;
    near.step[0].angle_deg += 0.2;
    const record::Frame further = last_frame(run_to_end(near));
    const auto work = [](const record::Frame& one) {
      return one.energies.total() - one.energies[Term::shear];
    };
    CHECK((work(further) - work(frame)) / (101 * 0.2 * degree) ==
          Approx(0.5 * (torque + further.torque_Nmm[1])).epsilon(2e-3));
  }
}

TEST_CASE("frames have the angles and torques of joints, with errors, as steps report them") {
  preset::Preset p = linkage();
  p.step = {opened(80, 100)};
  p.accuracy.edges_per_segment = 0;
  p.movie.frames = 5;
  const auto outcome = run(p);
  const record::Frame& frame = last_frame(outcome);
  CHECK(frame.joint_angle_deg == Approx(80).epsilon(1e-3));
  CHECK(frame.joint_angle_error_deg < 0.1);
  CHECK(frame.smallest_joint_angle_deg == Approx(frame.largest_joint_angle_deg).epsilon(1e-3));
  // bolts balance the resistance to shear, which is all that the linkage has
  CHECK(frame.joint_torque_Nmm < 1e-7);
  CHECK(frame.springs_error_mJ < 1e-4);
  CHECK(frame.angle_deg.size() == 9);
  CHECK(frame.torque_Nmm.size() == 9);
  for (const record::Frame& one : outcome.trajectory.frames)
    CHECK(std::isfinite(one.joint_angle_deg));
  // shells of free joints have none
  CHECK(std::isnan(last_frame(run(circle(4, 42, 36))).joint_angle_deg));
}

TEST_CASE("a plan refuses rods that run in the other direction, and names them") {
  preset::Preset p = linkage();
  p.step = {opened(80, 100)};
  const auto thick = value_of(simulate::plan(p)).left_out;
  std::ranges::reverse(p.footprint.file.rods[1]);
  const auto left_out = value_of(simulate::plan(p)).left_out;
  REQUIRE(left_out.size() == thick.size() + 1);
  CHECK_THAT(left_out.back(), Catch::Contains("an open turns 3 joints, [6, 0] first, against") &&
                                  Catch::Contains("rods[0] and rods[1]"));
  p.step = {opened(130, 100)};
  CHECK_THAT(refusal(simulate::plan(p)),
             Catch::Contains("[[step]] 1: joint [6, 0]: got an angle of") &&
                 Catch::Contains("rods[0] and rods[1]"));
}

TEST_CASE("how forces change as joints open, against differences") {
  preset::Preset p = network_of_rods(rhombi(50 * degree), 2);
  p.step = {opened(60, 100)};
  const Scene scene = value_of(scene_of(p));
  const RodMesh mesh = mesh_rods(scene.footprint, 2);
  const Model loose = value_of(build_model(mesh, scene.rods, RodModel::bend));
  const State flat = start_state(loose, columns_of(mesh, loose, drawn_nodes(mesh, scene.flat)));
  ShellRods rods = scene.rods;
  Bolts bolts = tightened(mesh, loose, flat, 100);
  bolts.opening.assign(bolts.rods.size(), 0.3);
  rods.bolts = std::make_shared<const Bolts>(bolts);
  const Model model = value_of(build_model(mesh, rods, RodModel::bend));
  const State state = start_state(model, flat.x);
  Assembly plus, minus;
  ExternalLoads outside;
  outside.opening = 0.4 + 1e-5;
  assemble_gradient(model, state, outside, plus);
  outside.opening = 0.4 - 1e-5;
  assemble_gradient(model, state, outside, minus);
  const Eigen::Matrix3Xd rate = opening_rate(model, plus.tangents);
  CHECK(rate.norm() > 1);
  CHECK(((plus.gradient - minus.gradient) / 2e-5 - rate).norm() < 1e-7 * rate.norm());
  outside.opening = 0.4;
  check_derivatives(model, state, outside, 1e-6, 1e-4, 1e-5);
}
