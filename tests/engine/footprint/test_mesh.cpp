#include <catch2/catch.hpp>
#include <cmath>

#include "engine/footprint/mesh.h"

using namespace gridshell;

namespace {
Footprint shell() { return circular_footprint(126.0, 12, 20.0, Placement::half).value(); }
}  // namespace

TEST_CASE("mesh: nodes, edges and rest lengths") {
  const Footprint net = shell();
  const RodMesh mesh = mesh_rods(net, 4);
  CHECK(mesh.nodes() - mesh.edge_points == 912);  // 2736 degrees of freedom
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (std::size_t k = 1; k < mesh.rods[r].size(); ++k) {
      const double rest = mesh.position[r][k] - mesh.position[r][k - 1];
      CHECK((mesh.flat.col(mesh.rods[r][k]) - mesh.flat.col(mesh.rods[r][k - 1])).norm() ==
            Approx(rest).epsilon(1e-12));
    }
}

TEST_CASE("mesh: 4, 8 and 16 edges nest, short legs too") {
  // legs of 1e-3 d at the ends of the middle rods
  const Footprint net =
      circular_footprint(std::hypot(110.02, 10.0), 12, 20.0, Placement::half).value();
  CHECK(net.shortest_leg() < 0.03);
  for (int edges : {4, 8}) {
    const RodMesh coarse = mesh_rods(net, edges), fine = mesh_rods(net, 2 * edges);
    for (std::size_t r = 0; r < coarse.rods.size(); ++r) {
      REQUIRE(fine.rods[r].size() == 2 * coarse.rods[r].size() - 1);
      for (std::size_t k = 0; k < coarse.rods[r].size(); ++k)
        CHECK(fine.position[r][2 * k] == Approx(coarse.position[r][k]).margin(1e-12));
    }
  }
}

TEST_CASE("mesh transfer: exact at shared nodes, fourth order between") {
  const Footprint net = shell();
  const auto curved = [](const RodMesh& mesh) {
    Eigen::Matrix3Xd x(3, mesh.nodes());
    for (int k = 0; k < mesh.nodes(); ++k) {
      const double u = mesh.flat(0, k), v = mesh.flat(1, k);
      x.col(k) << u, v, 30 * std::cos(u / 40) * std::cos(v / 50);
    }
    return x;
  };
  double before = 0;
  for (int edges : {4, 8, 16}) {
    const RodMesh coarse = mesh_rods(net, edges), fine = mesh_rods(net, 2 * edges);
    Eigen::Matrix3Xd carried;
    MeshTransfer(coarse, fine).nodes(curved(coarse), carried);
    CHECK((carried - curved(fine)).leftCols(fine.joints + fine.edge_points).norm() < 1e-11);
    // within the rods; one-sided slopes at their ends are a order lower
    const double error = (carried - curved(fine)).colwise().norm().maxCoeff();
    if (before > 0) CHECK(before / error > 6);
    before = error;
  }
  CHECK(before < 1e-4);
}

TEST_CASE("mesh transfer: a force goes to the edges that lie in its edge") {
  const Footprint net = shell();
  const RodMesh coarse = mesh_rods(net, 2), fine = mesh_rods(net, 4);
  int count = 0;
  for (const auto& rod : coarse.rods) count += int(rod.size()) - 1;
  Eigen::VectorXd force(count), carried;
  for (int k = 0; k < count; ++k) force[k] = k;
  MeshTransfer(coarse, fine).edges(force, carried);
  REQUIRE(carried.size() == 2 * count);
  for (int k = 0; k < count; ++k) {
    CHECK(carried[2 * k] == k);
    CHECK(carried[2 * k + 1] == k);
  }
}
