// Faces that rods and boundary enclose: none is lost, none counts twice.
#include "engine/scene/load_case.h"

#include <cmath>
#include <numeric>

#include "tests/presets.h"

using namespace gridshell;

namespace {

Eigen::Matrix3Xd flat_nodes(const Footprint& net) {
  const auto joints = Eigen::Index(net.joints.size());
  Eigen::Matrix3Xd nodes = Eigen::Matrix3Xd::Zero(3, joints + 2 * Eigen::Index(net.rods.size()));
  for (Eigen::Index k = 0; k < joints; ++k)
    nodes.col(k).head<2>() << net.joints[std::size_t(k)].u, net.joints[std::size_t(k)].v;
  for (std::size_t r = 0; r < net.rods.size(); ++r) {
    const FootprintRod& rod = net.rods[r];
    nodes.col(joints + 2 * Eigen::Index(r)).head<2>() = rod.at(rod.span.begin);
    nodes.col(joints + 2 * Eigen::Index(r) + 1).head<2>() = rod.at(rod.span.end);
  }
  return nodes;
}

double plan(const std::vector<Face>& faces, const Eigen::Matrix3Xd& nodes) {
  return std::accumulate(faces.begin(), faces.end(), 0.0, [&](double sum, const Face& face) {
    return sum + area_of(face, nodes).z();
  });
}

}  // namespace

TEST_CASE("faces of a circle: its cells, and what lies between them and the boundary") {
  const Footprint net = circular_footprint(126, 12, 20, Placement::half).value();
  const std::vector<Face> faces = faces_of(net);
  const auto cells = std::ranges::count(faces, false, &Face::on_boundary);
  CHECK(std::size_t(cells) == net.cells.size());
  // a piece from each edge point to the next
  CHECK(std::size_t(std::ranges::count(faces, true, &Face::on_boundary)) == 2 * net.rods.size());
  const Eigen::Matrix3Xd nodes = flat_nodes(net);
  for (const Face& face : faces)
    if (!face.on_boundary) CHECK(area_of(face, nodes).z() == Approx(400));
  // all together the polygon of the edge points, in their order round the circle
  std::vector<double> angles;
  for (Eigen::Index k = Eigen::Index(net.joints.size()); k < nodes.cols(); ++k)
    angles.push_back(std::atan2(nodes(1, k), nodes(0, k)));
  std::ranges::sort(angles);
  double polygon = 0.5 * 126 * 126 * std::sin(angles.front() - angles.back());
  for (std::size_t k = 1; k < angles.size(); ++k)
    polygon += 0.5 * 126 * 126 * std::sin(angles[k] - angles[k - 1]);
  CHECK(plan(faces, nodes) == Approx(polygon).epsilon(1e-12));
}

TEST_CASE("each load case has its own wind") {
  preset::Preset p = circle(6, 66, 54);
  p.loads.wind_N_m2 = 100;
  p.loads.wind_deg = 30;
  p.load_case.resize(2);
  p.load_case[0].wind = p.load_case[1].wind = 1;
  p.load_case[1].wind_deg = 90;
  const auto cases = value_of(load_cases_of(p, value_of(scene_of(p)).footprint));
  CHECK(cases[0].wind_rad == Approx(M_PI / 6));
  CHECK(cases[1].wind_rad == Approx(M_PI / 2));
}

TEST_CASE("an upright face has its area along its normal, and none in plan") {
  const Face face{{0, 1, 2, 3}};
  Eigen::Matrix3Xd square(3, 4);
  square << 0, 0, 0, 0, 0, 3, 3, 0, 0, 0, 2, 2;
  CHECK(area_of(face, square).isApprox(Eigen::Vector3d(6, 0, 0)));
  square.row(0) = square.row(2);
  CHECK(area_of(face, square).isApprox(Eigen::Vector3d(6, 0, -6)));
}
