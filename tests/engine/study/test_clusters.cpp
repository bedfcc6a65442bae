// Clusters of points.
#include <catch2/catch.hpp>
#include <random>

#include "engine/study/scan.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

/// points on a level disc, evenly
void add_disc(const Eigen::Vector3d& middle, double radius, int points, unsigned seed,
              std::vector<Eigen::Vector3d>& cloud) {
  std::mt19937_64 draw(seed);
  std::uniform_real_distribution<double> share(0, 1);
  for (int k = 0; k < points; ++k) {
    const double r = radius * std::sqrt(share(draw)), angle = 2 * M_PI * share(draw);
    cloud.push_back(middle + Eigen::Vector3d(r * std::cos(angle), r * std::sin(angle), 0));
  }
}

Eigen::Matrix3Xd matrix_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Matrix3Xd matrix(3, Eigen::Index(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) matrix.col(Eigen::Index(k)) = points[k];
  return matrix;
}

}  // namespace

TEST_CASE("discs apart are clusters, each with its middle, whatever part of it is seen more") {
  std::vector<Eigen::Vector3d> cloud;
  const Eigen::Vector3d a(0, 0, 1), b(6, 0, 2), c(0, 7, -3);
  add_disc(a, 1.5, 400, 1, cloud);
  add_disc(b, 1.5, 400, 2, cloud);
  add_disc(c, 1.5, 150, 3, cloud);
  // one half of c is seen twice as well
  std::vector<Eigen::Vector3d> more;
  add_disc(c, 1.5, 300, 4, more);
  for (const auto& p : more)
    if (p.x() > 0) cloud.push_back(p);
  const auto found = value_of(cluster_joint_tops(matrix_of(cloud), 3));
  REQUIRE(found.tops.cols() == 3);
  CHECK(found.specks == 0);
  CHECK(found.others == 0);
  for (const Eigen::Vector3d& middle : {a, b, c})
    CHECK((found.tops.colwise() - middle).colwise().norm().minCoeff() < 0.06);
}

TEST_CASE("single points are specks among discs, joints where there is nothing else") {
  std::vector<Eigen::Vector3d> cloud;
  add_disc({0, 0, 0}, 1.5, 100, 1, cloud);
  add_disc({20, 0, 0}, 1.5, 100, 2, cloud);
  cloud.emplace_back(10, 10, 10);
  cloud.emplace_back(-10, 10, 10);
  auto found = cluster_joint_tops(matrix_of(cloud), 3);
  REQUIRE(found);
  CHECK(found->tops.cols() == 2);
  CHECK(found->specks == 2);
  // a table, wider than any joint
  for (int k = 0; k < 60; ++k) cloud.emplace_back(-40, 0.5 * k, 0);
  found = cluster_joint_tops(matrix_of(cloud), 3);
  REQUIRE(found);
  CHECK(found->tops.cols() == 2);
  CHECK(found->others == 1);

  Eigen::Matrix3Xd single(3, 4);
  single << 0, 20, 0, 20, 0, 0, 20, 20, 0, 0, 0, 5;
  found = cluster_joint_tops(single, 3);
  REQUIRE(found);
  CHECK(found->tops.cols() == 4);
}

TEST_CASE("points that no shell of such joints could hold are refused") {
  Eigen::Matrix3Xd far(3, 2);
  far << 0, 1e9, 0, 0, 0, 0;
  const auto refused = cluster_joint_tops(far, 3);
  REQUIRE_FALSE(refused);
  CHECK(refused.error().message ==
        "the points reach over 1e+09 mm, joints of 3 mm are not to be found among them");
}
