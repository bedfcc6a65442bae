#include "engine/footprint/faces.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace gridshell {
namespace {

/// The net as a planar graph.
struct Graph {
  Eigen::Matrix3Xd place;                // of nodes in the flat
  std::vector<std::vector<int>> beside;  // the nodes around each, anticlockwise

  explicit Graph(const Footprint& footprint) {
    const std::size_t joints = footprint.joints.size(), rods = footprint.rods.size();
    place.setZero(3, Eigen::Index(joints + 2 * rods));
    beside.resize(joints + 2 * rods);
    for (std::size_t k = 0; k < joints; ++k)
      place.col(Eigen::Index(k)).head<2>() << footprint.joints[k].u, footprint.joints[k].v;
    for (std::size_t r = 0; r < rods; ++r) lay(footprint.rods[r], int(joints + 2 * r));
    for (std::size_t node = 0; node < beside.size(); ++node) sort_around(int(node));
  }

 private:
  void lay(const FootprintRod& rod, int begin) {
    std::vector<int> nodes = rod.joints;
    place.col(begin).head<2>() = rod.at(rod.span.begin);
    place.col(begin + 1).head<2>() = rod.at(rod.span.end);
    if (!rod.closed() && rod.begin != RodEnd::joined) nodes.insert(nodes.begin(), begin);
    if (!rod.closed() && rod.end != RodEnd::joined) nodes.push_back(begin + 1);
    for (std::size_t k = 1; k < nodes.size(); ++k) {
      beside[std::size_t(nodes[k - 1])].push_back(nodes[k]);
      beside[std::size_t(nodes[k])].push_back(nodes[k - 1]);
    }
  }

  void sort_around(int node) {
    std::ranges::sort(beside[std::size_t(node)], {}, [&](int other) {
      const Eigen::Vector3d way = place.col(other) - place.col(node);
      return std::atan2(way.y(), way.x());
    });
  }
};

/// All that lies to the left of the way from a to b, round to a again.
std::vector<int> walk(const Graph& graph, int a, int b, std::set<std::pair<int, int>>& walked) {
  std::vector<int> way;
  while (walked.insert({a, b}).second) {
    way.push_back(a);
    const std::vector<int>& around = graph.beside[std::size_t(b)];
    const auto back = std::ranges::find(around, a);
    a = std::exchange(b, *(back == around.begin() ? around.end() - 1 : back - 1));
  }
  return way;
}

}  // namespace

std::vector<Face> faces_of(const Footprint& footprint) {
  const Graph graph(footprint);
  std::vector<Face> faces;
  const auto keep = [&](std::vector<int> corners, bool on_boundary) {
    Face face{std::move(corners), on_boundary};
    // what is outside is walked round clockwise, and what has no area is no face
    const double least = 1e-9 * footprint.spacing * footprint.spacing;
    if (area_of(face, graph.place).z() > least) faces.push_back(std::move(face));
  };
  const auto is_edge_point = [&](int node) { return node >= int(footprint.joints.size()); };
  std::set<std::pair<int, int>> walked;
  for (int a = 0; a < int(graph.beside.size()); ++a)
    for (const int b : graph.beside[std::size_t(a)]) {
      std::vector<int> way = walk(graph, a, b, walked);
      const auto first = std::ranges::find_if(way, is_edge_point);
      if (way.empty()) continue;
      if (first == way.end()) {
        keep(way, false);
        continue;
      }
      std::ranges::rotate(way, first);
      way.push_back(way.front());
      for (std::size_t from = 0, k = 1; k < way.size(); ++k) {
        if (!is_edge_point(way[k])) continue;
        keep({way.begin() + std::ptrdiff_t(from), way.begin() + std::ptrdiff_t(k) + 1}, true);
        from = k;
      }
    }
  return faces;
}

Eigen::Vector3d area_of(const Face& face, const Eigen::Matrix3Xd& nodes) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d origin = nodes.col(face.corners.front());
  for (std::size_t k = 2; k < face.corners.size(); ++k)
    sum += 0.5 * (nodes.col(face.corners[k - 1]) - origin)
                     .cross(Eigen::Vector3d(nodes.col(face.corners[k]) - origin));
  return sum;
}

}  // namespace gridshell
