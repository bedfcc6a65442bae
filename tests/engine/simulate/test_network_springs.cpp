// Networks whose supports are on springs, from the file to certified states.
#include <Eigen/Geometry>

#include "tests/engine/simulate/run.h"

using namespace gridshell;
using simulate::frame_of;

namespace {

preset::Preset triaxial() { return shipped("network_triaxial"); }

/// The triaxial dome with a spring at every end.
preset::Preset on_springs(const Eigen::Vector3d& k) {
  preset::Preset p = triaxial();
  auto& file = p.footprint.file;
  for (const auto& rod : file.rods)
    for (const int end : {rod.front(), rod.back()}) {
      file.supports.push_back({double(end)});
      file.springs.push_back({double(end), k.x(), k.y(), k.z()});
    }
  return p;
}

Eigen::Matrix3Xd joints_of(const Simulation& session) {
  return session.nodes().leftCols(session.shell().finest().joints);
}

}  // namespace

TEST_CASE("stiff springs converge to fixed supports, the distance falling as 1/k", "[standard]") {
  // the supports move so little that the path has no event
  constexpr double scale = 0.99, shortening = 0.005;
  for (const auto rod_model : {RodModel::bend, RodModel::twist}) {
    const auto joints = [&](preset::Preset p) {
      p.accuracy.model = rod_model;
      p.rod.shear_GPa = 30;
      p.actuation.scale = scale;
      return joints_of(formed(p, {{4}, false}, shortening));
    };
    const Eigen::Matrix3Xd held = joints(triaxial());
    CHECK(held.row(2).maxCoeff() > 5);
    double before = 0;
    for (const double k : {100.0, 1e3, 1e4}) {
      const double off =
          (joints(on_springs(Eigen::Vector3d::Constant(k))) - held).colwise().norm().maxCoeff();
      CAPTURE(int(rod_model), k, off);
      CHECK(off < 1);
      if (before > 0) CHECK(before / off == Approx(10).epsilon(0.05));
      before = off;
    }
    CHECK(before < 1e-3);
  }
}

TEST_CASE("forces of springs are k times what the ends stay behind, and balance") {
  const Eigen::Vector3d k{0.05, 0.02, 0.04};
  Simulation session = formed(on_springs(k), {{4, 8}, false});
  const record::Frame frame = frame_of(session);
  const RodMesh& mesh = session.shell().finest();
  const auto layout = value_of(simulate::layout_of(session.scene(), mesh));
  const Eigen::Matrix3Xd& goes_to = session.scene().motion.end;
  Eigen::Vector3d sum = Eigen::Vector3d::Zero(), moment = sum;
  double energy = 0, largest = 0, furthest = 0;
  int ends = 0;
  for (std::size_t s = 0; s < layout.supports.size(); ++s) {
    const Eigen::Vector3d force = frame.reactions_N.col(Eigen::Index(s));
    const Eigen::Vector3d at = frame.nodes.col(layout.supports[s]);
    sum += force;
    moment += at.cross(force);
    largest = std::max(largest, force.norm());
    const int end = layout.supports[s] - mesh.joints;
    if (end < 0 || end >= mesh.edge_points) continue;
    ++ends;
    const Eigen::Vector3d behind = goes_to.col(end) - at;
    CHECK((force - k.cwiseProduct(behind)).norm() < 1e-9);
    energy += 0.5 * k.dot(behind.cwiseAbs2());
    furthest = std::max(furthest, behind.norm());
  }
  CHECK(ends == mesh.edge_points);
  CHECK(furthest > 0.1);
  CHECK(sum.norm() < 1e-6 * largest);
  CHECK(moment.norm() < 1e-4 * largest);
  CHECK(frame.energies[Term::support] == Approx(energy).epsilon(1e-6));
  // the recorded energies sum to the energy that the solver minimises
  NestedShell& shell = session.shell();
  CHECK(frame.energies.total() ==
        Approx(shell.system(1).energy_at(shell.state().levels[1])).epsilon(1e-12));
}

TEST_CASE("a joint inside rods on a spring yields, and may be pushed") {
  preset::Preset p = triaxial();
  auto& file = p.footprint.file;
  // the joint of most rods, supported from below
  std::vector<int> rods(file.points.size());
  for (const auto& rod : file.rods)
    for (const int point : rod) ++rods[std::size_t(point)];
  const int point = int(std::ranges::max_element(rods) - rods.begin());
  const auto& at = file.points[std::size_t(point)];
  file.supports.push_back({double(point), at[0], at[1], at[2]});
  file.springs.push_back({double(point), 0, 0, 1e-4});
  Simulation session = formed(p, {{4}, false});
  const Footprint& net = session.scene().footprint;
  REQUIRE(net.springs.size() == 1);
  const int joint = net.springs.front().joint;
  CHECK(net.is_sprung(joint));
  const auto reaction = [&] {
    const record::Frame frame = frame_of(session);
    return Eigen::Vector3d(frame.reactions_N.col(joint));
  };
  const double height = session.nodes()(2, joint);
  CHECK(height > 1);
  CHECK((reaction() - Eigen::Vector3d(0, 0, -1e-4 * height)).norm() < 1e-9);
  // pushed by a user: the push and the spring support it
  REQUIRE(session.push(joint, {0, 0, -0.5}, Across::free, unwatched).end == Outcome::reached);
  CHECK(session.nodes()(2, joint) == Approx(height - 0.5));
  CHECK(reaction().z() ==
        Approx(session.force(0).z() - 1e-4 * session.nodes()(2, joint)).epsilon(1e-6));
}

TEST_CASE("symmetries of a mesh keep its supports, and how stiff they are") {
  const auto count = [](const preset::Preset& p) {
    const auto scene = value_of(scene_of(p));
    const RodMesh mesh = mesh_rods(scene.footprint, 4);
    return symmetries_of(mesh, pinned_motion(mesh, scene.motion).at(1)).size();
  };
  const std::size_t all = count(triaxial());
  CHECK(all > 1);
  CHECK(count(on_springs({2, 2, 1})) == all);
  // with one end softer, or free, only symmetries that map it to itself remain
  preset::Preset p = on_springs({2, 2, 1});
  p.footprint.file.springs[0][3] = 0.5;
  CHECK(count(p) < all);
  p = triaxial();
  p.footprint.file.free.push_back(p.footprint.file.rods[0].front());
  CHECK(count(p) < all);
}

TEST_CASE("the cantilever of a public code agrees with the elastica, and nearly with that code") {
  const auto outcome = run_stills(shipped("lit_drm_cantilever"));
  CHECK(outcome.summary.stable);
  // by shooting along theta'' = -P L^2/EI cos theta, of P L^2/EI = 1.185185
  constexpr double up = 345.676, in = 74.8805, theirs = 346.115;
  const Eigen::Matrix3Xd& nodes = last_frame(outcome).nodes;
  CHECK(outcome.summary.height_mm == Approx(up).epsilon(5e-5));
  CHECK(1000 - nodes.row(0).maxCoeff() == Approx(in).epsilon(2e-4));
  // the elastica is not extensible, and known to half a micrometre
  preset::Preset stiff = shipped("lit_drm_cantilever");
  stiff.rod.EA_N = 1e8;
  const auto inextensible = run_stills(stiff).summary;
  CHECK(std::abs(inextensible.height_mm - up) < 2 * inextensible.error_estimate_mm + 5e-4);
  CHECK(outcome.summary.height_mm == Approx(theirs).epsilon(2e-3));  // ten elements
  // one alone, clamped; a short piece extends past its load
  preset::Preset alone = shipped("lit_drm_cantilever");
  preset::NetworkData& file = alone.footprint.file;
  file = {};
  file.points = {{0, 0, 0}, {1000, 0, 0}, {1010, 0, 0}};
  file.rods = {{0, 1, 2}};
  file.free = {2};
  file.end_constraints = {{0, 0, double(preset::EndKind::clamped)}};
  alone.loads.points = {{1, 0, 0, 0, 5}};
  const auto one = run_stills(alone);
  CHECK(one.summary.stable);
  CHECK(one.summary.height_mm == Approx(up).epsilon(5e-5));
  CHECK(1000 - last_frame(one).nodes(0, 0) == Approx(in).epsilon(2e-4));
}
