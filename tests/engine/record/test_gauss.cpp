#include <array>
#include <catch2/catch.hpp>
#include <random>

#include "engine/record/shape_measures.h"

using namespace gridshell;

namespace {

struct Shape {
  Footprint net;
  RodMesh mesh;
  Eigen::Matrix3Xd x;
};

template <class Position>
Shape shape(double radius, int rods, int edges, Position position) {
  const auto placement = rods % 2 ? Placement::on_axis : Placement::half;
  Shape s{circular_footprint(radius, rods, 20, placement).value(), {}, {}};
  s.mesh = mesh_rods(s.net, edges);
  s.x.resize(3, s.mesh.nodes());
  for (int k = 0; k < s.mesh.nodes(); ++k)
    s.x.col(k) = position(s.mesh.flat(0, k), s.mesh.flat(1, k));
  return s;
}

/// Total of K from the joints alone. A rod has one tangent at a joint, so the four angles at a
/// joint add up to 2 pi, and joints with four cells contribute nothing. With alpha the angle of a
/// cell, the others contribute pi/2 - alpha with one cell, beta - pi/2 with three (beta: the angle
/// without a cell), 2 (pi/2 - alpha) with two opposite cells, and otherwise 0. Computed from the
/// directions of the rods, not by cell_curvature.
double total_curvature_from_corners(const Footprint& footprint, const JointTangents& tangents) {
  // which of the four quadrants around a joint contain a cell, counter-clockwise from (+u, +v)
  std::vector<std::array<bool, 4>> holds(footprint.joints.size(), {false, false, false, false});
  for (const FootprintCell& cell : footprint.cells)
    for (int corner = 0; corner < 4; ++corner) holds[cell.joints[corner]][corner] = true;

  double total = 0;
  for (std::size_t j = 0; j < holds.size(); ++j) {
    // omega: the angle of quadrants (+,+) and (-,-); the other two have pi - omega
    const Eigen::Vector3d u = tangents.u.col(Eigen::Index(j)), v = tangents.v.col(Eigen::Index(j));
    const double omega = 2 * std::atan2((u - v).norm(), (u + v).norm());
    const int even = holds[j][0] + holds[j][2], odd = holds[j][1] + holds[j][3];
    const int cells = even + odd;
    if (cells == 1) total += even ? M_PI / 2 - omega : omega - M_PI / 2;
    if (cells == 3) total += (even == 1 ? omega : M_PI - omega) - M_PI / 2;
    if (cells == 2 && even != 1) total += even == 2 ? M_PI - 2 * omega : 2 * omega - M_PI;
  }
  return total;
}

}  // namespace

TEST_CASE("K of cells: the sum equals the corner identity on any shape") {
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  for (int rods : {4, 5, 9, 12}) {
    const double radius = 20 * ((rods - 1) / 2.0 + 0.7);
    const Shape s = shape(radius, rods, 4, [&](double u, double v) {
      return Eigen::Vector3d(u + normal(random), v + normal(random),
                             30 * std::cos(u / 60) + 1e-3 * u * v + normal(random));
    });
    const JointTangents tangents = joint_tangents(s.net, s.mesh, s.x);
    CHECK(cell_curvature(s.net, tangents).sum() ==
          Approx(total_curvature_from_corners(s.net, tangents)).margin(1e-9));
  }
}

TEST_CASE("K of cells: flat is zero, dome positive, saddle negative") {
  const Shape flat = shape(126, 12, 4, [](double u, double v) { return Eigen::Vector3d(u, v, 0); });
  CHECK(
      cell_curvature(flat.net, joint_tangents(flat.net, flat.mesh, flat.x)).cwiseAbs().maxCoeff() <
      1e-12);
  // on a translation surface X(u) + Y(v) the integral of K sin(omega) is exact: -[omega] of the
  // corners
  const auto dome = shape(60, 4, 64, [](double u, double v) {
    return Eigen::Vector3d(u, v, -0.5e-2 * (u * u + v * v));
  });
  const auto saddle = shape(60, 4, 64, [](double u, double v) {
    return Eigen::Vector3d(u, v, 0.5e-2 * (u * u - v * v));
  });
  const auto middle = [](const Shape& s) {
    const Eigen::VectorXd K = cell_curvature(s.net, joint_tangents(s.net, s.mesh, s.x));
    for (std::size_t k = 0; k < s.net.cells.size(); ++k)
      if (s.net.cells[k].i == -1 && s.net.cells[k].j == -1) return K[Eigen::Index(k)];
    return 0.0;
  };
  // z = -c (u^2 + v^2)/2: tangents (1, 0, -c u), (0, 1, -c v), so at the corners (+-10, +-10) all
  // four interior angles have the cosine (c 10)^2/(1 + (c 10)^2); on the saddle that cosine is
  // negative
  const double angle = std::acos(0.1 * 0.1 / (1 + 0.1 * 0.1));
  CHECK(middle(dome) == Approx(2 * M_PI - 4 * angle).margin(1e-12));
  CHECK(middle(saddle) == Approx(2 * M_PI - 4 * (M_PI - angle)).margin(1e-12));
}

TEST_CASE("tangents at joints converge at second order") {
  double before = 0;
  for (int edges : {4, 8, 16, 32}) {
    const Shape s = shape(126, 12, edges, [](double u, double v) {
      return Eigen::Vector3d(u, v, 40 * std::cos(u / 50 + 0.3) * std::cos(v / 70));
    });
    const JointTangents tangents = joint_tangents(s.net, s.mesh, s.x);
    double worst = 0;
    for (int k = 0; k < s.mesh.joints; ++k) {
      const double u = s.net.joints[k].u, v = s.net.joints[k].v;
      const Eigen::Vector3d exact =
          Eigen::Vector3d(1, 0, -0.8 * std::sin(u / 50 + 0.3) * std::cos(v / 70)).normalized();
      worst = std::max(worst, (tangents.u.col(k) - exact).norm());
    }
    if (before > 0) CHECK(std::log2(before / worst) == Approx(2).margin(0.25));
    before = worst;
  }
}
