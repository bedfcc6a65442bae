// An X-shell whose laths are hinged, against energies written down and solved by themselves.
#include <numeric>
#include <random>
#include <unsupported/Eigen/AutoDiff>
#include <unsupported/Eigen/NonLinearOptimization>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

using T = Eigen::AutoDiffScalar<Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 90, 1>>;

struct V {
  T x, y, z;
};
V operator+(const V& a, const V& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
V operator-(const V& a, const V& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
V operator*(const T& s, const V& a) { return {s * a.x, s * a.y, s * a.z}; }
T dot(const V& a, const V& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
V cross(const V& a, const V& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
T norm(const V& a) { return sqrt(dot(a, a)); }
V unit(const V& a) { return T(1 / norm(a)) * a; }

/// Next to a joint: an edge's tangent, its material director and its natural length.
struct Beside {
  V tangent, director;
  double length = 0;
};
using Hinge = std::vector<std::vector<Beside>>;  // of each of a joint's two rods

double share(const std::vector<Beside>& rod, std::size_t k) {
  return rod[1 - k].length / (rod[0].length + rod[1].length);
}

/// What a rod turns between its joint and its edges, over its stiffness.
double between(const std::vector<Beside>& rod) {
  return rod[0].length * rod[1].length / (2 * (rod[0].length + rod[1].length));
}

template <class Angle>
T mean(const Hinge& at, Angle angle) {
  T sum(0);
  for (std::size_t e = 0; e < 2; ++e)
    for (std::size_t f = 0; f < 2; ++f)
      sum += share(at[0], e) * share(at[1], f) * angle(at[0][e], at[1][f]);
  return sum;
}

T mean_angle(const Hinge& at) {
  return mean(at,
              [](const Beside& e, const Beside& f) { return T(acos(dot(e.tangent, f.tangent))); });
}

/// About the tangent of the first from the joint's upper normal to its director.
T spin(const Beside& e, const Beside& f) {
  V n = cross(e.tangent, f.tangent);
  if (n.z.value() < 0) n = T(-1.0) * n;
  return atan2(dot(e.tangent, cross(n, e.director)), dot(n, e.director));
}

/// Laths of two families, hinged, with a spring at each joint.
struct Laths {
  RodMesh mesh;
  RodMaterial lath;
  double spring = 0;         ///< N mm/rad
  std::vector<double> rest;  ///< natural angles, of every joint

  std::vector<int> free() const {
    std::vector<int> nodes;
    for (int node = 0; node < mesh.nodes(); ++node)
      if (node < mesh.joints || node >= mesh.joints + mesh.edge_points) nodes.push_back(node);
    return nodes;
  }
  int edges() const {
    int sum = 0;
    for (const auto& rod : mesh.rods) sum += int(rod.size()) - 1;
    return sum;
  }

  /// E of positions and, for every edge, the angle of its section relative to a frame without
  /// twist; the edges next to the joints are stored in `at`.
  T energy(const std::vector<V>& x, const std::vector<T>& angle, std::vector<Hinge>& at) const {
    T sum(0);
    at.assign(std::size_t(mesh.joints), {});
    std::size_t edge = 0;
    for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
      V before{}, frame{T(0), T(0), T(1)};
      double last = 0;
      for (std::size_t k = 1; k < mesh.rods[r].size(); ++k, ++edge) {
        const int node = mesh.rods[r][k - 1];
        const double length = mesh.position[r][k] - mesh.position[r][k - 1];
        const V way = x[std::size_t(mesh.rods[r][k])] - x[std::size_t(node)], t = unit(way);
        const T strain = norm(way) / length - 1.0;
        sum += 0.5 * lath.EA * length * strain * strain;
        if (k == 1)
          frame = unit(frame - dot(frame, t) * t);
        else
          frame = frame - T(dot(frame, t) / (1.0 + dot(before, t))) * (before + t);
        const V side = cross(t, frame),
                director = T(cos(angle[edge])) * frame + T(sin(angle[edge])) * side;
        if (k > 1) {
          const double l = 0.5 * (last + length);
          const T twist = angle[edge] - angle[edge - 1],
                  turn = 0.5 * (angle[edge] + angle[edge - 1]);
          // kb is perpendicular to both tangents, so that both frames see it equally
          const V kb = T(2.0 / (1.0 + dot(before, t))) * cross(before, t);
          const T a = dot(kb, frame), b = dot(kb, side);
          const T w1 = a * cos(turn) + b * sin(turn), w2 = b * cos(turn) - a * sin(turn);
          sum += 0.5 / l * (lath.GJ * twist * twist + lath.EI1 * w1 * w1 + lath.EI2 * w2 * w2);
        }
        if (k > 1 && node < mesh.joints)
          at[std::size_t(node)].back().push_back({t, director, length});
        if (const int to = mesh.rods[r][k]; to < mesh.joints)
          at[std::size_t(to)].push_back({{t, director, length}});
        before = t;
        last = length;
      }
    }
    for (std::size_t joint = 0; joint < at.size(); ++joint) {
      const Hinge& one = at[joint];
      // couples about both rods, which twist them and bend them out of the surface
      const double a = between(one[0]), b = between(one[1]);
      const T angle = mean_angle(one), c = cos(angle), out = 1.0 / (lath.EI2 * (1.0 - c * c));
      const T aa = a / lath.GJ + out * (b + a * c * c), bb = b / lath.GJ + out * (a + b * c * c),
              ab = out * c * (a + b);
      const T phi = mean(one, spin), psi = mean({one[1], one[0]}, spin);
      sum += 0.5 * (bb * phi * phi - 2.0 * ab * phi * psi + aa * psi * psi) / (aa * bb - ab * ab);
      if (spring == 0) continue;
      const T off = mean_angle(one) - rest[joint];
      sum += 0.5 / (1 / spring + (between(one[0]) + between(one[1])) / lath.EI1) * off * off;
    }
    return sum;
  }

  /// The energy with its derivatives by the free positions and the angles, which are in `at`.
  T at_place(const Eigen::Matrix3Xd& nodes, const Eigen::VectorXd& by,
             std::vector<Hinge>& at) const {
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
    std::vector<T> angle;
    for (; k < size; ++k) angle.emplace_back(by[k], size, k);
    return energy(x, angle, at);
  }

  /// Its slopes, as the solver of equations asks for them.
  struct Slopes {
    const Laths& laths;
    const Eigen::Matrix3Xd& nodes;

    int operator()(const Eigen::VectorXd& by, Eigen::VectorXd& slopes) const {
      std::vector<Hinge> at;
      slopes = laths.at_place(nodes, by, at).derivatives();
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
    std::vector<Hinge> at;
    const T here = at_place(nodes, by, at);
    CHECK(here.derivatives().norm() < 1e-6);
    return here.value();
  }
};

/// Four laths that cross at angles of 60 degrees and about, ends drawn in to 0.97.
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
  CHECK(formed.summary.energies[Term::joint] > 1e-3);
  CHECK(laths.least(rest) == Approx(formed.summary.energies.total()).epsilon(1e-8));

  // the current angles of its joints, and the requested change
  constexpr double target = 1.2;
  laths.spring = 300;
  std::vector<Hinge> at;
  const Eigen::Index size = 3 * Eigen::Index(laths.free().size()) + laths.edges();
  laths.rest.assign(4, 0);
  laths.at_place(rest, Eigen::VectorXd::Zero(size), at);
  std::vector<double> standing;
  for (const Hinge& one : at) {
    const auto through = [](const std::vector<Beside>& rod) {
      return T(share(rod, 0)) * rod[0].tangent + T(share(rod, 1)) * rod[1].tangent;
    };
    const V a = unit(through(one[0])), b = unit(through(one[1]));
    standing.push_back(std::acos(dot(a, b).value()));
  }
  const double by = target - std::accumulate(standing.begin(), standing.end(), 0.0) / 4;
  for (std::size_t joint = 0; joint < 4; ++joint)
    laths.rest[joint] = mean_angle(at[joint]).value() + by;
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
