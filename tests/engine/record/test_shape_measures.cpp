#include <catch2/catch.hpp>
#include <cmath>

#include "engine/footprint/symmetry.h"
#include "engine/record/shape_measures.h"

using namespace gridshell;

TEST_CASE("bins of K: five, 0.4 wide, mean and standard deviation of the cells in each") {
  Eigen::VectorXd x(6), K(6);
  x << -0.9, -0.7, 0.0, 0.19, 0.3, 1.02;  // one just outside the end
  K << 1, 3, 2, 4, 7, -1;
  const CurvatureBins bins = curvature_bins(x, K);
  REQUIRE(bins.low.size() == 5);
  for (int k = 0; k < 5; ++k) {
    CHECK(bins.low[k] == Approx(-1 + 0.4 * k));
    CHECK(bins.high[k] == Approx(-0.6 + 0.4 * k));
  }
  CHECK(bins.cells == (Eigen::VectorXi(5) << 2, 0, 2, 1, 1).finished());
  CHECK(bins.mean[0] == 2);
  CHECK(bins.deviation[0] == 1);
  CHECK(std::isnan(bins.mean[1]));
  CHECK(bins.mean[2] == 3);
  CHECK(bins.deviation[2] == 1);
  CHECK(bins.deviation[3] == 0);
  CHECK(bins.mean[4] == -1);
}

TEST_CASE("the means of the bins weighed by their cells are the mean of all cells") {
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(97, -0.99, 0.99);
  const Eigen::VectorXd K = (7 * x.array()).sin() + 0.3 * x.array();
  const CurvatureBins bins = curvature_bins(x, K);
  CHECK(bins.cells.sum() == 97);
  CHECK(bins.mean.dot(bins.cells.cast<double>()) == Approx(K.sum()).margin(1e-12));
}

TEST_CASE("reach: shares of joints moved and the lowest latitude among them") {
  Eigen::Matrix3Xd before(3, 4), now;
  before.col(0) << 0, 0, 10;
  before.col(1) << 10 * std::cos(M_PI / 4), 0, 10 * std::sin(M_PI / 4);
  before.col(2) << 0, 10 * std::cos(M_PI / 6), 10 * std::sin(M_PI / 6);
  before.col(3) << 10, 0, 0;
  now = before;
  now(2, 0) -= 2;    // 1 of the depth
  now(0, 1) += 0.8;  // 0.4
  now(1, 2) -= 0.3;  // 0.15
  now(2, 3) += 0.1;  // 0.05
  const PushReach reach = push_reach(before, now, 2);
  CHECK(reach.above_tenth == 0.75);
  CHECK(reach.above_half == 0.25);
  CHECK(reach.lowest_latitude_deg == Approx(30));
  CHECK(std::isnan(push_reach(before, now, 0).above_tenth));
}

TEST_CASE("mirror defect: zero for a mirror plane, the distance to the nearest joint else") {
  Eigen::Matrix3Xd joints(3, 4);
  joints << 3, -3, 0, 0, 0, 0, 3, -3, 1, 1, 1, 1;
  const double half = std::sqrt(0.5);
  for (const Eigen::Vector2d& normal :
       {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(half, half)})
    CHECK(mirror_defect(joints, normal) < 1e-15);
  joints(2, 0) += 0.25;
  CHECK(mirror_defect(joints, {0, 1}) < 1e-15);
  CHECK(mirror_defect(joints, {1, 0}) == Approx(0.25));
}

TEST_CASE("deviation: largest, mean and quantiles are fractions of rho") {
  Eigen::Matrix3Xd net = Eigen::Matrix3Xd::Random(3, 5), joints = net;
  // distances 5, 1, 2, 0, 13 mm
  joints.col(0) += Eigen::Vector3d(3, 0, -4);
  joints.col(1) += Eigen::Vector3d(0, 1, 0);
  joints.col(2) += Eigen::Vector3d(-2, 0, 0);
  joints.col(4) += Eigen::Vector3d(3, 4, 12);
  const NetDeviation deviation(joints, net, 10);
  CHECK(deviation.largest() == Approx(1.3));
  CHECK(deviation.mean() == Approx(0.42));
  CHECK(deviation.quantile(0) == 0);
  CHECK(deviation.quantile(0.5) == Approx(0.2));
  CHECK(deviation.quantile(0.25) == Approx(0.1));
  CHECK(deviation.quantile(0.875) == Approx(0.9));
  CHECK(deviation.of_joints()[0] == Approx(0.5));
}

TEST_CASE("deviation: what is not a number shows in the largest and the mean") {
  Eigen::Matrix3Xd net = Eigen::Matrix3Xd::Zero(3, 4), joints = net;
  joints(1, 1) = std::nan("");
  const NetDeviation deviation(joints, net, 1);
  CHECK(std::isnan(deviation.largest()));
  CHECK(std::isnan(deviation.mean()));
  CHECK(deviation.quantile(0) == 0);
  CHECK(std::isnan(NetDeviation(Eigen::Matrix3Xd(3, 0), Eigen::Matrix3Xd(3, 0), 1).mean()));
}
