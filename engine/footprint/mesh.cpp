#include "engine/footprint/mesh.h"

#include <algorithm>

namespace gridshell {
namespace {

/// Edges of a leg shorter than d/4: the power of two that makes k nest in its base (at most 4).
int edges_of_short_leg(int edges_per_segment) {
  int base = edges_per_segment, halvings = 1;
  while (base > 4 && base % 2 == 0) base /= 2, halvings *= 2;
  return halvings;
}

}  // namespace

RodMesh mesh_rods(const Footprint& footprint, int edges_per_segment) {
  RodMesh mesh;
  mesh.edges_per_segment = edges_per_segment;
  mesh.joints = int(footprint.joints.size());
  mesh.edge_points = 2 * int(footprint.rods.size());
  int next = mesh.joints + mesh.edge_points;

  for (int r = 0; r < int(footprint.rods.size()); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    std::vector<int> stops{mesh.joints + 2 * r};
    std::vector<double> at{rod.span.begin};
    for (int joint : rod.joints) {
      stops.push_back(joint);
      const FootprintJoint& crossing = footprint.joints[joint];
      at.push_back(rod.family == Family::u ? crossing.u : crossing.v);
    }
    stops.push_back(mesh.joints + 2 * r + 1);
    at.push_back(rod.span.end);

    std::vector<int> nodes{stops.front()};
    std::vector<double> position{at.front()};
    for (std::size_t k = 1; k < stops.size(); ++k) {
      const bool is_leg = k == 1 || k + 1 == stops.size();
      const double length = at[k] - at[k - 1];
      const int edges = is_leg && length < footprint.spacing / 4
                            ? edges_of_short_leg(edges_per_segment)
                            : edges_per_segment;
      for (int e = 1; e < edges; ++e) {
        nodes.push_back(next++);
        position.push_back(at[k - 1] + length * e / edges);
      }
      nodes.push_back(stops[k]);
      position.push_back(at[k]);
    }
    mesh.rods.push_back(std::move(nodes));
    mesh.position.push_back(std::move(position));
  }

  mesh.flat.resize(2, next);
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
      const double along = mesh.position[r][k];
      mesh.flat.col(mesh.rods[r][k]) = rod.family == Family::u ? Eigen::Vector2d(along, rod.line)
                                                               : Eigen::Vector2d(rod.line, along);
    }
  }
  return mesh;
}

Eigen::Matrix3Xd interpolate(const RodMesh& from, const Eigen::Matrix3Xd& x, const RodMesh& to) {
  Eigen::Matrix3Xd result(3, to.nodes());
  for (std::size_t r = 0; r < from.rods.size(); ++r) {
    const std::vector<int>& node = from.rods[r];
    const std::vector<double>& s = from.position[r];
    const int last = int(node.size()) - 1;

    // derivative by arc length at each node: quadratic through its neighbours, one-sided at ends
    Eigen::Matrix3Xd slope(3, last + 1);
    const auto chord = [&](int k) -> Eigen::Vector3d {
      return (x.col(node[k + 1]) - x.col(node[k])) / (s[k + 1] - s[k]);
    };
    for (int k = 1; k < last; ++k) {
      const double before = s[k] - s[k - 1], after = s[k + 1] - s[k];
      slope.col(k) = (chord(k - 1) * after + chord(k) * before) / (before + after);
    }
    slope.col(0) = last > 1 ? Eigen::Vector3d(2 * chord(0) - slope.col(1)) : chord(0);
    slope.col(last) =
        last > 1 ? Eigen::Vector3d(2 * chord(last - 1) - slope.col(last - 1)) : chord(last - 1);

    int k = 0;
    for (std::size_t m = 0; m < to.rods[r].size(); ++m) {
      const double at = to.position[r][m];
      while (k + 1 < last && at >= s[k + 1]) ++k;
      const double h = s[k + 1] - s[k], t = std::clamp((at - s[k]) / h, 0.0, 1.0);
      const double t2 = t * t, t3 = t2 * t;
      result.col(to.rods[r][m]) =
          (2 * t3 - 3 * t2 + 1) * x.col(node[k]) + (t3 - 2 * t2 + t) * h * slope.col(k) +
          (3 * t2 - 2 * t3) * x.col(node[k + 1]) + (t3 - t2) * h * slope.col(k + 1);
    }
  }
  return result;
}

}  // namespace gridshell
