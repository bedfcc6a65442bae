#include <catch2/catch.hpp>
#include <cmath>

#include "engine/record/shape_measures.h"

using namespace gridshell;

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
