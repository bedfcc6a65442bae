// Curvature, forces and energies along the rods of a frame.
#include "engine/record/frame_values.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/engine/record/sample_run.h"

using namespace gridshell;
using namespace gridshell::record;

namespace {

// a rod 0-1-2, and one that ends on its middle: 1-3
Layout tee() {
  Layout layout;
  layout.rods = {{0, 1, 2}, {1, 3}};
  return layout;
}

Frame tee_frame() {
  Frame frame;
  frame.nodes = Eigen::Matrix3Xd::Zero(3, 5);
  frame.axial_force_N = Eigen::Vector3d(1, 2, -9);
  frame.bending_mJ_per_m.resize(5);
  frame.bending_mJ_per_m << 0, 6, 4, 0, 0;
  return frame;
}

}  // namespace

TEST_CASE("the curvature of points on a circle is one over its radius") {
  Eigen::Matrix3Xd points(3, 20);
  for (int k = 0; k < 20; ++k) points.col(k) << 50 * std::cos(0.05 * k), 1, 50 * std::sin(0.05 * k);
  const auto curvature = curvature_per_mm(points);
  REQUIRE(curvature.size() == 20);
  CHECK(curvature.front() == 0);
  CHECK(curvature.back() == 0);
  // 2 tan(a/2) over the chord 2 R sin(a/2)
  for (std::size_t k = 1; k + 1 < curvature.size(); ++k)
    CHECK(curvature[k] == Approx(1 / (50 * std::cos(0.025))).epsilon(1e-9));
}

TEST_CASE("forces at points are those of the neighbouring edges, and unknown where not recorded") {
  const Trajectory run = sample_trajectory();
  const Frame& frame = run.frames.back();
  // the second rod's three edges follow the first one's
  const auto force = axial_force_N(run.layout, frame, 1);
  REQUIRE(force.size() == 4);
  CHECK(force[0] == frame.axial_force_N[3]);
  CHECK(force[1] == 0.5 * (frame.axial_force_N[3] + frame.axial_force_N[4]));
  CHECK(force[3] == frame.axial_force_N[5]);
  CHECK(curvature_per_mm(run.layout, frame, 1)[2] == frame.curvature_per_mm[6]);
  CHECK(std::isnan(axial_force_N(run.layout, run.frames[1], 0)[1]));
}

TEST_CASE("a node bears the mean force of its edges, and the energy of what goes through it") {
  const Eigen::VectorXd force = axial_force_of_nodes_N(tee(), tee_frame());
  REQUIRE(force.size() == 5);
  CHECK(force[0] == 1);
  CHECK(force[1] == Approx((1 + 2 - 9) / 3.0));
  CHECK(force[3] == -9);
  CHECK(force[4] == 0);  // on no rod
  const Eigen::VectorXd bending = bending_of_nodes_mJ_per_m(tee(), tee_frame());
  CHECK(bending[1] == 6);  // the end on it does not bend
  CHECK(bending[2] == 4);  // an end of prescribed direction bends
  CHECK(bending[3] == 0);
  Frame old = tee_frame();
  old.axial_force_N.resize(0);
  old.bending_mJ_per_m.resize(0);
  CHECK(axial_force_of_nodes_N(tee(), old).size() == 0);
  CHECK(bending_of_nodes_mJ_per_m(tee(), old).size() == 0);
}

TEST_CASE("a value is reported in the digits that its error leaves certain") {
  CHECK(with_error(0.123456, 7.1e-4, "N") == "0.1235 ± 0.0007 N");
  CHECK(with_error(39.9791, 0.02, "mJ") == "39.98 ± 0.02 mJ");
  CHECK(with_error(1234.5, 30, "N") == "1234 ± 30 N");
  CHECK(with_error(2108745.3, 595, "mJ") == "2.1087 ± 0.0006 kJ");
  CHECK(with_error(7604400, 28000, "mJ") == "7.60 ± 0.03 kJ");
  CHECK(with_error(26168.5, 40, "mJ") == "26.17 ± 0.04 J");
  CHECK(with_error(12345, 60, "N") == "12.35 ± 0.06 kN");
  CHECK(with_error(0.25, 0, "N") == "0.25 N");
  // a value that its error rounds to zero has no sign
  CHECK(with_error(-0.3, 1, "N") == "0 ± 1 N");
  CHECK(with_error(-0.0004, 0.03, "N") == "0.00 ± 0.03 N");
  CHECK(with_error(-0.3, 40, "N") == "0 ± 40 N");
  CHECK(with_error(-0.3, 0.1, "N") == "-0.3 ± 0.1 N");
  CHECK(with_error(0.123456, unknown, "N") == "0.1235 N (error not known)");
}

TEST_CASE("a cell deviates from its net by the mean of its joints, over the length scale") {
  Trajectory run = sample_trajectory();
  Frame frame = run.frames[0];
  CHECK_FALSE(has_net(run.layout));
  CHECK(deviation_of_nodes(run.layout, frame).size() == 0);
  CHECK(deviation_of_cells(run.layout, frame).size() == 0);
  run.layout.net_nodes = frame.nodes;
  for (int joint = 0; joint < 4; ++joint) frame.nodes(2, joint) += 1.26 * (joint + 1);
  const Eigen::VectorXd of_nodes = deviation_of_nodes(run.layout, frame);
  REQUIRE(of_nodes.size() == 12);
  CHECK(of_nodes[3] == Approx(0.04));
  CHECK(of_nodes[4] == 0);
  const Eigen::VectorXd of_cells = deviation_of_cells(run.layout, frame);
  REQUIRE(of_cells.size() == 1);
  CHECK(of_cells[0] == Approx(0.025));
}

TEST_CASE("the angles of joints are linear along the rods between them") {
  Layout layout;
  layout.rods = {{0, 1, 2, 3, 4, 5}, {6, 7}};
  layout.joints = {{0, 0, 0, 0, 1}, {1, 0, 0, 0, 3}};
  Frame frame;
  frame.nodes = Eigen::Matrix3Xd::Zero(3, 8);
  CHECK(joint_angle_of_nodes_deg(layout, frame).size() == 0);
  frame.angle_deg = Eigen::Vector2d(60, 70);
  const Eigen::VectorXd angle = joint_angle_of_nodes_deg(layout, frame);
  const double expected[] = {60, 60, 65, 70, 70, 70};
  for (int node = 0; node < 6; ++node) CHECK(angle[node] == expected[node]);
  CHECK(std::isnan(angle[6]));
}
