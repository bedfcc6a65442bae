#include <cmath>

#include "engine/footprint/footprint.h"
#include "engine/footprint/mesh.h"
#include "tests/results.h"

using namespace gridshell;

TEST_CASE("footprint: the circle of Fig. 1") {
  const Footprint net = circular_footprint(126.0, 12, 20.0, Placement::half).value();
  CHECK(net.rods.size() == 24);
  CHECK(net.joints.size() == 120);
  CHECK(net.cells.size() == 97);
  // R_o/d - (n-1)/2 = 0.8 is the length of a leg on the circle's axis, over d; with half placement
  // no rod is there, and each leg ends exactly where its rod meets the circle
  for (const FootprintRod& rod : net.rods) {
    CHECK(std::hypot(rod.span.end, rod.line()) == Approx(126.0).epsilon(1e-15));
    CHECK(rod.span.begin == -rod.span.end);
    for (std::size_t k = 1; k < rod.joints.size(); ++k) {
      const auto& a = net.joints[rod.joints[k - 1]];
      const auto& b = net.joints[rod.joints[k]];
      CHECK(std::hypot(b.u - a.u, b.v - a.v) == Approx(20.0).epsilon(1e-14));
    }
  }
  for (const FootprintJoint& joint : net.joints) {
    CHECK(joint.u == (joint.i + 0.5) * 20.0);
    CHECK(joint.v == (joint.j + 0.5) * 20.0);
    CHECK(std::hypot(joint.u, joint.v) < 126.0);
  }
  for (const FootprintCell& cell : net.cells) {
    const auto& corner = net.joints[cell.joints[0]];
    CHECK((corner.i == cell.i && corner.j == cell.j));
    const auto& opposite = net.joints[cell.joints[2]];
    CHECK((opposite.i == cell.i + 1 && opposite.j == cell.j + 1));
  }
  CHECK(net.shortest_leg() == Approx(std::sqrt(126.0 * 126.0 - 50.0 * 50.0) - 110.0));
}

TEST_CASE("footprint: legs may be longer than a cell, corners may be cut off") {
  const Footprint dome = circular_footprint(20.0 * (5.5 + 3.1), 12, 20.0, Placement::half).value();
  CHECK(dome.rods.size() == 24);
  CHECK(dome.joints.size() == 144);
  CHECK(dome.cells.size() == 121);
  CHECK(dome.longest_leg() > 20.0);
  const Footprint odd = circular_footprint(105.0, 11, 20.0, Placement::on_axis).value();
  CHECK(odd.rods.size() == 22);
  CHECK(odd.longest_leg() == Approx(std::sqrt(105.0 * 105.0 - 40.0 * 40.0) - 80.0));
}

TEST_CASE("footprint: what makes no sense is refused with its reason") {
  const auto message = [](double radius, int rods, double spacing, Placement placement) {
    return refusal(circular_footprint(radius, rods, spacing, placement));
  };
  CHECK(message(126, 1, 20, Placement::on_axis) ==
        "rods: got 1 per direction, expected at least 2");
  CHECK(
      message(126, 11, 20, Placement::half) ==
      "11 rods per direction do not fit placement \"half\": rods at (i + 1/2) d (\"half\") are an "
      "even number, rods at i d (\"on_axis\") an odd one");
  CHECK(message(100, 12, 20, Placement::half) ==
        "12 rods per direction at d = 20 mm do not fit the boundary: the outermost crossing lies "
        "at 110.4536 mm; take R_o >= 110.4737 mm or n <= 10");
  CHECK(message(100, 13, 20, Placement::on_axis) ==
        "13 rods per direction at d = 20 mm do not fit the boundary: the outermost crossing lies "
        "at 120 mm; take R_o >= 120.02 mm or n <= 9");
  // no number of rods fits a boundary smaller than a cell
  CHECK(message(0.1, 12, 20, Placement::half) ==
        "12 rods per direction at d = 20 mm do not fit the boundary: the outermost crossing lies "
        "at 110.4536 mm; take R_o >= 110.4737 mm");
  // the proposed values are accepted
  CHECK(circular_footprint(110.4737, 12, 20, Placement::half));
  CHECK(circular_footprint(100, 10, 20, Placement::half));
  CHECK(circular_footprint(120.02, 13, 20, Placement::on_axis));
  CHECK(circular_footprint(100, 9, 20, Placement::on_axis));
  CHECK(refusal(cut_footprint(Disk(1e6), 1.0, Placement::half)) ==
        "a spacing of 1 mm in a boundary that reaches 1e+06 mm gives more than 1e+06 joints or "
        "none");
}

TEST_CASE("footprint: grid lines that cross no other within the boundary are left out") {
  // the lines at 10 and 30 mm cross, those at 50 mm end before them
  const auto net = value_of(cut_footprint(Disk(50.5), 20, Placement::half));
  CHECK(net.rods.size() == 8);
  CHECK(net.lone_lines == 4);
  CHECK(net.joints.size() == 16);
  for (const FootprintRod& rod : net.rods) CHECK(rod.joints.size() >= 2);
  CHECK(cut_footprint(Disk(51.5), 20, Placement::half)->lone_lines == 0);
  CHECK(refusal(cut_footprint(Disk(9), 20, Placement::on_axis)) == "none");
  CHECK(refusal(cut_footprint(Disk(11), 20, Placement::half)) ==
        "got no two rods that cross within the boundary, expected a boundary larger than 20 mm, or "
        "the spacing smaller");
}

namespace {

Footprint shell() { return circular_footprint(126.0, 12, 20.0, Placement::half).value(); }

}  // namespace

TEST_CASE("mesh: nodes, edges and natural lengths") {
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

TEST_CASE(
    "mesh transfer: exact at shared nodes, fourth order between, third next to the ends of rods") {
  const Footprint net = shell();
  const auto curved = [](const RodMesh& mesh) {
    Eigen::Matrix3Xd x(3, mesh.nodes());
    for (int k = 0; k < mesh.nodes(); ++k) {
      const double u = mesh.flat(0, k), v = mesh.flat(1, k);
      x.col(k) << u, v, 30 * std::cos(u / 40) * std::cos(v / 50);
    }
    return x;
  };
  double before = 0, inside_before = 0;
  for (int edges : {4, 8, 16}) {
    const RodMesh coarse = mesh_rods(net, edges), fine = mesh_rods(net, 2 * edges);
    Eigen::Matrix3Xd carried;
    MeshTransfer(coarse, fine).nodes(curved(coarse), carried);
    CHECK((carried - curved(fine)).leftCols(fine.joints + fine.edge_points).norm() < 1e-11);
    // next to ends of rods, and to edges of another length, the slopes are one order lower
    double error = 0, inside = 0;
    for (std::size_t r = 0; r < fine.rods.size(); ++r) {
      const auto& at = coarse.position[r];
      for (std::size_t k = 0; k + 1 < at.size(); ++k) {
        const double off = (carried - curved(fine)).col(fine.rods[r][2 * k + 1]).norm();
        error = std::max(error, off);
        const bool equal = k > 0 && k + 2 < at.size() &&
                           at[k] - at[k - 1] == Approx(at[k + 1] - at[k]) &&
                           at[k + 2] - at[k + 1] == Approx(at[k + 1] - at[k]);
        if (equal) inside = std::max(inside, off);
      }
    }
    if (before > 0) {
      CHECK(before / error == Approx(8).epsilon(0.03));
      CHECK(inside_before / inside == Approx(16).epsilon(0.05));
    }
    before = error, inside_before = inside;
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
