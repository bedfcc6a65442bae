// Names of symmetry groups, modes of rods, and estimates of the number of states.

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "engine/record/shape_measures.h"
#include "engine/record/states.h"
#include "tests/engine/solve/single_rod.h"

using namespace gridshell;

namespace {

std::vector<MeshSymmetry> all_maps() {
  std::vector<MeshSymmetry> all;
  for (std::size_t k = 0; k < square_symmetries().size(); ++k)
    all.push_back({int(k), square_symmetries()[k], Eigen::Vector3d::Zero(), {}});
  return all;
}

}  // namespace

TEST_CASE("groups: those of upright shapes are the seven of the square, each named once") {
  std::vector<MeshSymmetry> upright;
  for (const MeshSymmetry& one : all_maps())
    if (!one.turns_over()) upright.push_back(one);
  std::set<std::string> names;
  for (const SymmetryGroup& group : subgroups(upright)) {
    CHECK(names.insert(name_of_group(group)).second);
    CHECK(8 % group.size() == 0);
  }
  CHECK(names == std::set<std::string>{"C4v", "C4", "C2v_axes", "C2v_diagonals", "C2", "Cs_axis",
                                       "Cs_diagonal"});
  CHECK(name_of_group({0}) == "C1");
}

TEST_CASE("groups: with maps that turn over, each is closed, of a fitting size and none is flat") {
  const auto groups = subgroups(all_maps());
  std::set<std::string> names;
  for (const SymmetryGroup& group : groups) {
    const std::string name = name_of_group(group);
    CAPTURE(name);
    CHECK(names.insert(name).second);
    CHECK(16 % group.size() == 0);
    std::set<int> members(group.begin(), group.end());
    for (const int a : group)
      for (const int b : group) {
        const Eigen::Matrix3d product =
            square_symmetries()[std::size_t(a)] * square_symmetries()[std::size_t(b)];
        bool held = false;
        for (const int c : members) held |= square_symmetries()[std::size_t(c)] == product;
        CHECK(held);
      }
  }
  for (const char* name : {"C4v", "D2d_axes", "D2d_diagonals", "S4", "D4", "D2_axes", "Ci"})
    CHECK(names.contains(name));
  CHECK(!names.contains("flat"));
  CHECK(groups.front().size() == 8);
}

TEST_CASE("rod modes: a sine of k half waves has k - 1 inflections, straight pieces have none") {
  const RodMesh mesh = single_rod(64, 100);
  for (int waves = 1; waves <= 6; ++waves) {
    Eigen::Matrix3Xd x = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
    for (int k = 0; k < mesh.nodes(); ++k) {
      const double s = mesh.flat(0, k) / 100, bend = 6 * std::sin(waves * M_PI * s) / waves;
      // in a plane that is neither upright nor level
      x.col(k) << 100 * s, 0.6 * bend, 0.8 * bend;
    }
    CHECK(inflections(mesh, x) == std::vector<int>{waves - 1});
  }
  // an arch between two straight pieces
  Eigen::Matrix3Xd arch = Eigen::Matrix3Xd::Zero(3, mesh.nodes());
  for (int k = 0; k < mesh.nodes(); ++k) {
    const double s = mesh.flat(0, k) / 100;
    arch.col(k) << 100 * s, 0, s < 0.3 ? s : s > 0.7 ? 1 - s : 0.3 + (s - 0.3) * (0.7 - s) / 0.4;
  }
  CHECK(inflections(mesh, arch) == std::vector<int>{0});
}

TEST_CASE("Chao1: known values, and an interval that contains what was seen") {
  std::vector<int> counts(5, 2);
  counts.insert(counts.end(), 10, 1);
  counts.insert(counts.end(), 5, 7);
  const RichnessEstimate some = chao1(counts);
  CHECK(some.seen == 20);
  CHECK(some.once == 10);
  CHECK(some.twice == 5);
  CHECK(some.estimate == Approx(30));
  // variance 5 (2 + 8 + 4) = 70 of 10 unseen: 20 + 10/K to 20 + 10 K
  const double K = std::exp(1.96 * std::sqrt(std::log(1 + 70.0 / 100)));
  CHECK(some.low == Approx(20 + 10 / K));
  CHECK(some.high == Approx(20 + 10 * K));

  const RichnessEstimate complete = chao1({4, 9, 3});
  CHECK(complete.estimate == 3);
  CHECK(complete.low == 3);
  CHECK(complete.high == 3);
  // no state was found exactly twice: the bias-corrected form
  CHECK(chao1({1, 1, 1, 5}).estimate == Approx(4 + 3));
  CHECK(chao1({}).estimate == 0);
  // a state with a count of 0 was not met at random
  CHECK(chao1({0, 0, 3}).seen == 1);
}

namespace {

/// A square grid of joints about (3, -2), with a height z(x, y) about the middle.
template <class Height>
void grid(const Height& height, Eigen::Matrix2Xd& flat, Eigen::Matrix3Xd& shape) {
  flat.resize(2, 36);
  shape.resize(3, 36);
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      const double x = i - 2.5, y = j - 2.5;
      flat.col(6 * i + j) << 20 * x + 3, 20 * y - 2;
      shape.col(6 * i + j) << 18 * x + 3, 18 * y - 2, height(x, y);
    }
}

int order_of(double (*height)(double, double)) {
  Eigen::Matrix2Xd flat;
  Eigen::Matrix3Xd shape;
  grid(height, flat, shape);
  return SharedSymmetry(flat, shape, 1e-9).order();
}

}  // namespace

TEST_CASE("symmetries that a shape shares with its footprint") {
  CHECK(order_of([](double x, double y) { return x * x + y * y; }) == 8);
  CHECK(order_of([](double x, double y) { return x * y; }) == 4);
  CHECK(order_of([](double x, double y) { return x * x + 2 * y * y; }) == 4);
  // a rotation alone
  CHECK(order_of([](double x, double y) { return x * y * (x * x - y * y); }) == 4);
  CHECK(order_of([](double x, double) { return x; }) == 2);
  CHECK(order_of([](double x, double y) { return x + 0.3 * y * y * y; }) == 1);
}

TEST_CASE("what breaks a symmetry") {
  Eigen::Matrix2Xd flat;
  Eigen::Matrix3Xd dome, tilted;
  grid([](double x, double y) { return 9 - x * x - y * y; }, flat, dome);
  grid([](double x, double y) { return 9 - x * x - y * y + 0.25 * x; }, flat, tilted);
  const SharedSymmetry symmetry(flat, dome, 1e-9);
  CHECK(root_mean_square(symmetry.broken(dome)) < 1e-12);
  const Eigen::Matrix3Xd broken = symmetry.broken(tilted);
  // the tilt alone is left, whose mean square over the six columns is 0.0625 * 35 / 12
  CHECK(root_mean_square(broken) == Approx(std::sqrt(0.0625 * 35 / 12)));
  // a tilt to the other side has the opposite sign
  grid([](double x, double y) { return 9 - x * x - y * y - 0.25 * x; }, flat, tilted);
  CHECK((symmetry.broken(tilted) + broken).norm() < 1e-9);
}
