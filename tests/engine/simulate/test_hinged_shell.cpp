// An X-shell whose laths are hinged, compared with a separate implementation of its energy, which
// Eigen's solver minimises.
#include <numeric>
#include <random>
#include <unsupported/Eigen/AutoDiff>
#include <unsupported/Eigen/NonLinearOptimization>

#include "tests/engine/elastic/vector_of.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

using T = Eigen::AutoDiffScalar<Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 100, 1>>;

using V = VectorOf<T>;

/// Laths of two families, hinged, with a spring at each joint.
struct Laths {
  RodMesh mesh;
  RodMaterial lath;
  double spring = 0;         ///< N mm/rad
  std::vector<double> rest;  ///< natural angles, of every joint

  /// A joint on a rod, with the ends of the edge in whose middle it is.
  struct Centre {
    int before, joint, after;
  };
  std::vector<Centre> centres() const {
    std::vector<Centre> all;
    for (const auto& rod : mesh.rods)
      for (std::size_t k = 1; k + 1 < rod.size(); ++k)
        if (rod[k] < mesh.joints) all.push_back({rod[k - 1], rod[k], rod[k + 1]});
    return all;
  }
  std::vector<int> free() const {
    std::vector<int> nodes;
    for (int node = 0; node < mesh.nodes(); ++node)
      if (node < mesh.joints || node >= mesh.joints + mesh.edge_points) nodes.push_back(node);
    for (const Centre& one : centres()) std::erase(nodes, one.after);
    return nodes;
  }
  int edges() const {
    int sum = 0;
    for (const auto& rod : mesh.rods) sum += int(rod.size()) - 1;
    return sum;
  }

  /// The rods' tangents at every joint.
  std::vector<std::vector<V>> tangents(const std::vector<V>& x) const {
    std::vector<std::vector<V>> at(std::size_t(mesh.joints));
    for (const Centre& one : centres())
      at[std::size_t(one.joint)].push_back(
          unit(x[std::size_t(one.after)] - x[std::size_t(one.before)]));
    return at;
  }

  /// E of positions and, for every edge, the angle of its section relative to a frame without
  /// twist; at joints it is that of their normal.
  T energy(const std::vector<V>& x, const std::vector<T>& angles) const {
    T sum(0);
    const auto at = tangents(x);
    std::size_t edge = 0;
    for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
      V before{}, frame{T(0), T(0), T(1)};
      double last = 0;
      T turned(0);
      for (std::size_t k = 1; k < mesh.rods[r].size(); ++k, ++edge) {
        const int node = mesh.rods[r][k - 1], to = mesh.rods[r][k];
        const double length = mesh.position[r][k] - mesh.position[r][k - 1];
        const V way = x[std::size_t(to)] - x[std::size_t(node)], t = unit(way);
        const T strain = norm(way) / length - 1.0;
        sum += 0.5 * lath.EA * length * strain * strain;
        if (k == 1)
          frame = unit(frame - dot(frame, t) * t);
        else
          frame = frame - T(dot(frame, t) / (1.0 + dot(before, t))) * (before + t);
        const V side = cross(t, frame);
        const int joint = node < mesh.joints ? node : to < mesh.joints ? to : -1;
        T angle = angles[edge];
        if (joint >= 0) {
          V n = cross(at[std::size_t(joint)][0], at[std::size_t(joint)][1]);
          if (n.z.value() < 0) n = T(-1.0) * n;
          angle = atan2(dot(n, side), dot(n, frame));
        }
        // halves of an edge, at a joint or at a rod's end, represent the complete edge
        const double whole =
            joint >= 0 || k == 1 || k + 1 == mesh.rods[r].size() ? 2 * length : length;
        if (k > 1 && node >= mesh.joints) {
          const double l = 0.5 * (last + whole);
          const T twist = angle - turned, turn = 0.5 * (angle + turned);
          // kb is perpendicular to both tangents, so that both frames see it equally
          const V kb = T(2.0 / (1.0 + dot(before, t))) * cross(before, t);
          const T a = dot(kb, frame), b = dot(kb, side);
          const T w1 = a * cos(turn) + b * sin(turn), w2 = b * cos(turn) - a * sin(turn);
          sum += 0.5 / l * (lath.GJ * twist * twist + lath.EI1 * w1 * w1 + lath.EI2 * w2 * w2);
        }
        before = t;
        last = whole;
        turned = angle;
      }
    }
    for (std::size_t joint = 0; spring > 0 && joint < at.size(); ++joint) {
      const T off = acos(dot(at[joint][0], at[joint][1])) - rest[joint];
      sum += 0.5 * spring * off * off;
    }
    return sum;
  }

  /// The energy with its derivatives by the free positions and the angles.
  T at_place(const Eigen::Matrix3Xd& nodes, const Eigen::VectorXd& by) const {
    const Eigen::Index size = by.size();
    std::vector<V> x;
    for (const auto& place : nodes.colwise())
      x.push_back({T(place.x()), T(place.y()), T(place.z())});
    Eigen::Index k = 0;
    for (const int node : free())
      for (T* one : {&x[std::size_t(node)].x, &x[std::size_t(node)].y, &x[std::size_t(node)].z}) {
        *one = T(one->value() + by[k], size, k);
        ++k;
      }
    for (const auto& [before, joint, after] : centres())
      x[std::size_t(after)] = T(2.0) * x[std::size_t(joint)] - x[std::size_t(before)];
    std::vector<T> angle;
    for (; k < size; ++k) angle.emplace_back(by[k], size, k);
    return energy(x, angle);
  }

  /// The derivatives of the energy, as Eigen's solver of equations needs them.
  struct Slopes {
    const Laths& laths;
    const Eigen::Matrix3Xd& nodes;

    int operator()(const Eigen::VectorXd& by, Eigen::VectorXd& slopes) const {
      slopes = laths.at_place(nodes, by).derivatives();
      // the energy does not depend on the angles at joints, which are set to 0
      for (Eigen::Index k = 0; k < slopes.size(); ++k)
        if (slopes[k] == 0 && k >= 3 * Eigen::Index(laths.free().size())) slopes[k] = by[k];
      return 0;
    }
  };

  /// The energy at its minimum, searched for from these perturbed positions.
  double least(const Eigen::Matrix3Xd& nodes) const {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> off(-0.01, 0.01);
    Eigen::VectorXd by(3 * Eigen::Index(free().size()) + edges());
    for (double& one : by) one = off(random);
    Slopes slopes{*this, nodes};
    Eigen::HybridNonLinearSolver<Slopes> solver(slopes);
    solver.solveNumericalDiff(by);
    const T here = at_place(nodes, by);
    CHECK(here.derivatives().norm() < 1e-6);
    return here.value();
  }
};

/// Four laths that cross at angles of about 60 degrees, with their ends moved inwards to 0.97.
preset::Preset hinged() {
  preset::NetworkData file;
  file.points = {{-22, -2, 0},  {0, -14, 0},  {23, 1, 0},    {1, 13, 0},  // joints
                 {-44, 10, 0},  {22, -26, 0}, {-21, 25, 0},  {45, -11, 0},
                 {-45, -17, 0}, {24, 28, 0},  {-23, -29, 0}, {46, 16, 0}};
  file.rods = {{4, 0, 1, 5}, {6, 3, 2, 7}, {8, 0, 3, 9}, {10, 1, 2, 11}};
  for (int joint = 0; joint < 4; ++joint) file.joint_laws.push_back({double(joint), 0, -1});
  preset::Preset p = network(file, 2);
  p.rod.width_mm = 2, p.rod.thickness_mm = 0.8, p.rod.young_GPa = 10, p.rod.shear_GPa = 4;
  p.actuation.scale = 0.97;
  p.limits.max_strain = 0.02;
  return p;
}

}  // namespace

TEST_CASE("a hinged X-shell, formed and opened, is where its energy is least") {
  preset::Preset p = hinged();
  const Scene scene = value_of(scene_of(p));
  Laths laths{mesh_rods(scene.footprint, 2), scene.rods.materials.front(), 0, {}};
  const auto formed = run(p);
  REQUIRE(formed.summary.stable);
  const Eigen::Matrix3Xd rest = last_frame(formed).nodes;
  REQUIRE(rest.cols() == laths.mesh.nodes());
  CHECK(formed.summary.energies[Term::twist] > 1e-3);
  CHECK(laths.least(rest) == Approx(formed.summary.energies.total()).epsilon(1e-8));

  // the current angles of its joints, and the requested change
  constexpr double target = 1.2;
  laths.spring = 300;
  std::vector<double> standing(4);
  const auto of = [&](const Laths::Centre& one) {
    return Eigen::Vector3d((rest.col(one.after) - rest.col(one.before)).normalized());
  };
  for (const Laths::Centre& one : laths.centres())
    for (const Laths::Centre& other : laths.centres())
      if (one.joint == other.joint && one.before != other.before)
        standing[std::size_t(one.joint)] = std::acos(of(one).dot(of(other)));
  const double by = target - std::accumulate(standing.begin(), standing.end(), 0.0) / 4;
  for (const double one : standing) laths.rest.push_back(one + by);
  preset::Step step;
  step.kind = preset::StepKind::open;
  step.angle_deg = target * 180 / M_PI;
  step.stiffness_Nmm = laths.spring;
  p.step = {step};
  const auto opened = run(p);
  CAPTURE(opened.summary.limit_reason);
  REQUIRE(opened.summary.stable);
  CHECK(opened.summary.energies[Term::shear] > 1);
  CHECK(laths.least(last_frame(opened).nodes) ==
        Approx(opened.summary.energies.total()).epsilon(1e-8));
}
