#include "engine/footprint/mesh.h"

#include <algorithm>
#include <cmath>

namespace gridshell {

Eigen::Vector3d FlatFrame::at(const Eigen::Vector2d& uv) const { return origin + axes * uv; }

Eigen::Matrix3Xd FlatFrame::all(const Eigen::Matrix2Xd& uv) const {
  return (axes * uv).colwise() + origin;
}

namespace {

/// A position at which a rod is cut into segments, legs and tails: a far end, an edge point or a
/// joint.
struct Stop {
  int node;
  double at;
  bool joint = false, centred = false;
};

/// The node of rod `r` at a joint: the joint's, or, if the joint is eccentric and `r` is its second
/// rod, a new one.
int node_at(const FootprintJoint& joint, int number, int r, std::vector<int>& first_rod, int& next,
            RodMesh& mesh) {
  int& first = first_rod[std::size_t(number)];
  if (first < 0) first = r;
  if (joint.eccentricity == 0 || first == r) return number;
  const auto known = std::ranges::find(mesh.eccentric, number, &EccentricJoint::joint);
  if (known != mesh.eccentric.end()) return known->node;
  mesh.eccentric.push_back({number, next, joint.eccentricity});
  return next++;
}

std::vector<Stop> stops_of(const Footprint& footprint, std::size_t r, std::vector<int>& first_rod,
                           int& next, RodMesh& mesh) {
  const FootprintRod& rod = footprint.rods[r];
  const int first = mesh.joints + 2 * int(r);
  std::vector<Stop> stops;
  const auto far_end = [&](int edge_point, double at) {
    stops.push_back({next, at});
    mesh.far_ends.resize(std::size_t(mesh.edge_points), -1);
    mesh.far_ends[std::size_t(edge_point - mesh.joints)] = next++;
  };
  if (rod.tail_begin > 0) far_end(first, rod.span.begin - rod.tail_begin);
  if (rod.begin != RodEnd::joined) stops.push_back({first, rod.span.begin});
  for (std::size_t k = 0; k < rod.joints.size(); ++k) {
    const int joint = rod.joints[k];
    const int node =
        node_at(footprint.joints[std::size_t(joint)], joint, int(r), first_rod, next, mesh);
    stops.push_back({node, rod.marks[k], true, footprint.joints[std::size_t(joint)].centred});
  }
  if (rod.end != RodEnd::joined) stops.push_back({first + 1, rod.span.end});
  if (rod.tail_end > 0) far_end(first + 1, rod.span.end + rod.tail_end);
  return stops;
}

/// Number of edges between two stops. Legs and tails shorter than d/4 have fewer than segments; two
/// centred edges need at least two.
int edges_between(const Stop& a, const Stop& b, const Footprint& footprint, const RodMesh& mesh) {
  if (a.centred && b.centred) return std::max(2, mesh.edges_per_segment);
  if ((a.joint && b.joint) || !(b.at - a.at < footprint.spacing / 4)) return mesh.edges_per_segment;
  return std::max(1, int(std::lround(mesh.edges_per_segment / 4.0)));
}

/// Positions of the nodes between stop k - 1 and stop k of a rod.
std::vector<double> cuts_of(const std::vector<Stop>& stops, std::size_t k,
                            const Footprint& footprint, const RodMesh& mesh) {
  const std::size_t last = stops.size() - 1;
  const bool ring = stops[0].node == stops[last].node;
  const auto pieces = [&](std::size_t n) {
    return edges_between(stops[n - 1], stops[n], footprint, mesh);
  };
  const auto piece = [&](std::size_t n) { return (stops[n].at - stops[n - 1].at) / pieces(n); };
  // half the length of the edge centred between two stretches; at an end of a rod one is missing
  const auto half = [&](std::size_t before, std::size_t after) {
    const bool begins = before == 0 && !ring, ends = after > last && !ring;
    const double h = piece(begins        ? after
                           : before == 0 ? last
                                         : before),
                 g = piece(ends           ? before
                           : after > last ? 1
                                          : after);
    return h * g / (h + g);
  };
  const Stop &from = stops[k - 1], &to = stops[k];
  const int edges = pieces(k);
  std::vector<double> cuts;
  const auto at = [&](double fraction) { return from.at + (to.at - from.at) * fraction / edges; };
  if (from.centred || to.centred)
    for (int e = 0; e < edges; ++e) cuts.push_back(at(e + 0.5));
  else
    for (int e = 1; e < edges; ++e) cuts.push_back(at(e));
  if (from.centred) cuts.front() = from.at + half(k - 1, k);
  if (to.centred) cuts.back() = to.at - half(k, k + 1);
  return cuts;
}

/// Moves the ends of each centred edge so that its joint is in its middle also if the rod has a
/// corner there.
template <class Points>
void centre_edges(const RodMesh& mesh, Points& points) {
  const auto centre = [&](int before, int node, int after) {
    if (!mesh.is_centred(node)) return;
    const auto half = (0.5 * (points.col(after) - points.col(before))).eval();
    points.col(before) = points.col(node) - half;
    points.col(after) = points.col(node) + half;
  };
  for (const std::vector<int>& rod : mesh.rods) {
    for (std::size_t k = 1; k + 1 < rod.size(); ++k) centre(rod[k - 1], rod[k], rod[k + 1]);
    if (rod.front() == rod.back()) centre(rod[rod.size() - 2], rod.front(), rod[1]);
  }
}

void add_ghosts(const Footprint& footprint, int& next, RodMesh& mesh) {
  mesh.ghost_length = footprint.spacing / 4;
  const int first = next;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    std::vector<int>& node = mesh.rods[r];
    std::vector<double>& at = mesh.position[r];
    if (fixes_direction(footprint.rods[r].begin)) {
      node.insert(node.begin(), next++);
      at.insert(at.begin(), at.front() - mesh.ghost_length);
    }
    if (fixes_direction(footprint.rods[r].end)) {
      node.push_back(next++);
      at.push_back(at.back() + mesh.ghost_length);
    }
  }
  mesh.ghosts = next - first;
}

void add_supports(const Footprint& footprint, int& next, RodMesh& mesh) {
  for (const SupportSpring& spring : footprint.springs) {
    const int node = spring.joint >= 0 ? spring.joint : mesh.joints + spring.end;
    mesh.springs.push_back({next++, node, spring.N_per_mm});
  }
}

/// Sets the heights of the nodes of a network that is drawn in space.
void lay_heights(const Footprint& footprint, RodMesh& mesh) {
  mesh.height = Eigen::RowVectorXd::Zero(mesh.nodes());
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    for (std::size_t k = 0; k < mesh.rods[r].size(); ++k)
      mesh.height[mesh.rods[r][k]] = rod.height(mesh.position[r][k]);
    const Eigen::Index begin = mesh.joints + 2 * Eigen::Index(r);
    mesh.height[begin] = rod.height(rod.span.begin);
    mesh.height[begin + 1] = rod.height(rod.span.end);
  }
  for (Eigen::Index k = 0; k < mesh.joints; ++k)
    mesh.height[k] = footprint.joints[std::size_t(k)].height;
  for (const MeshSpring& spring : mesh.springs)
    mesh.height[spring.support] = mesh.height[spring.node];
}

}  // namespace

RodMesh mesh_rods(const Footprint& footprint, int edges_per_segment) {
  RodMesh mesh;
  mesh.edges_per_segment = edges_per_segment;
  mesh.joints = int(footprint.joints.size());
  mesh.edge_points = 2 * int(footprint.rods.size());
  mesh.fixed_joints = footprint.fixed_joints;
  for (const FootprintJoint& joint : footprint.joints) mesh.centred.push_back(joint.centred);
  int next = mesh.joints + mesh.edge_points;
  std::vector<int> first_rod(footprint.joints.size(), -1);

  for (int r = 0; r < int(footprint.rods.size()); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    mesh.ends.insert(mesh.ends.end(), {rod.begin, rod.end});
    const std::vector<Stop> stops = stops_of(footprint, std::size_t(r), first_rod, next, mesh);
    std::vector<int> nodes{stops.front().node};
    std::vector<double> position{stops.front().at};
    for (std::size_t k = 1; k < stops.size(); ++k) {
      for (const double at : cuts_of(stops, k, footprint, mesh)) {
        nodes.push_back(next++);
        position.push_back(at);
      }
      nodes.push_back(stops[k].node);
      position.push_back(stops[k].at);
    }
    mesh.rods.push_back(std::move(nodes));
    mesh.position.push_back(std::move(position));
  }

  add_ghosts(footprint, next, mesh);
  add_supports(footprint, next, mesh);
  mesh.flat.resize(2, next);
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    for (std::size_t k = 0; k < mesh.rods[r].size(); ++k) {
      // joints get their position below
      const int node = mesh.rods[r][k];
      if (node >= mesh.joints) mesh.flat.col(node) = rod.at(mesh.position[r][k]);
    }
    if (rod.begin == RodEnd::joined)
      mesh.flat.col(mesh.joints + 2 * Eigen::Index(r)) = rod.at(rod.span.begin);
    if (rod.end == RodEnd::joined)
      mesh.flat.col(mesh.joints + 2 * Eigen::Index(r) + 1) = rod.at(rod.span.end);
  }
  for (Eigen::Index k = 0; k < mesh.joints; ++k)
    mesh.flat.col(k) << footprint.joints[std::size_t(k)].u, footprint.joints[std::size_t(k)].v;
  for (const MeshSpring& spring : mesh.springs)
    mesh.flat.col(spring.support) = mesh.flat.col(spring.node);
  if (footprint.in_space()) lay_heights(footprint, mesh);
  centre_edges(mesh, mesh.flat);
  if (mesh.height.size() > 0) centre_edges(mesh, mesh.height);
  return mesh;
}

int RodMesh::joint_of(int node) const {
  if (node < joints) return node;
  const auto at = std::ranges::lower_bound(eccentric, node, {}, &EccentricJoint::node);
  return at != eccentric.end() && at->node == node ? at->joint : -1;
}

Eigen::Matrix3Xd drawn_nodes(const RodMesh& mesh, const FlatFrame& flat) {
  Eigen::Matrix3Xd nodes = flat.all(mesh.flat);
  if (mesh.height.size() > 0) nodes.row(2) += mesh.height;
  return nodes;
}

/// Weights of Hermite interpolation in the interval [s_k, s_k+1], with the slopes of a quadratic
/// through three nodes: at an inner node the node and its neighbours, at an end of a rod the three
/// nearest.
MeshTransfer::Stencil MeshTransfer::stencil(const std::vector<int>& node,
                                            const std::vector<double>& s, int k, double at,
                                            int to) {
  const int last = int(node.size()) - 1;
  const double h = s[k + 1] - s[k], t = std::clamp((at - s[k]) / h, 0.0, 1.0);
  const double t2 = t * t, t3 = t2 * t;
  const double value0 = 2 * t3 - 3 * t2 + 1, value1 = 3 * t2 - 2 * t3;
  const double slope0 = (t3 - 2 * t2 + t) * h, slope1 = (t3 - t2) * h;
  Stencil w{to,
            {node[std::max(k - 1, 0)], node[k], node[k + 1], node[std::min(k + 2, last)]},
            {0, value0, value1, 0}};
  const bool has_before = k > 0, has_after = k + 1 < last;
  // slope at a node: mean of the chords (x1 - x0)/length on both sides, each weighted by the length
  // of the other side
  const auto chord_before = [&](double fraction) {
    const double length = s[k] - s[k - 1];
    w.weight[0] -= fraction / length, w.weight[1] += fraction / length;
  };
  const auto chord_here = [&](double fraction) {
    w.weight[1] -= fraction / h, w.weight[2] += fraction / h;
  };
  const auto chord_after = [&](double fraction) {
    const double length = s[k + 2] - s[k + 1];
    w.weight[2] -= fraction / length, w.weight[3] += fraction / length;
  };
  const double before = has_before ? s[k] - s[k - 1] : 0,
               after = has_after ? s[k + 2] - s[k + 1] : 0;
  const auto add_slope0 = [&](double fraction) {
    chord_before(fraction * h / (before + h));
    chord_here(fraction * before / (before + h));
  };
  const auto add_slope1 = [&](double fraction) {
    chord_here(fraction * after / (after + h));
    chord_after(fraction * h / (after + h));
  };
  if (has_before) add_slope0(slope0);
  if (has_after) add_slope1(slope1);
  if (!has_before) chord_here(has_after ? 2 * slope0 : slope0);
  if (!has_before && has_after) add_slope1(-slope0);
  if (!has_after) chord_here(has_before ? 2 * slope1 : slope1);
  if (!has_after && has_before) add_slope0(-slope1);
  return w;
}

MeshTransfer::MeshTransfer(const RodMesh& from, const RodMesh& to) : nodes_to_(to.nodes()) {
  // edge points that are on no rod have the same numbers on both meshes
  for (int end = 0; end < to.edge_points; ++end)
    if (to.end_of(end) == RodEnd::joined)
      stencils_.push_back({to.joints + end, {from.joints + end, 0, 0, 0}, {1, 0, 0, 0}});
  for (std::size_t k = 0; k < to.springs.size(); ++k)
    stencils_.push_back({to.springs[k].support, {from.springs[k].support, 0, 0, 0}, {1, 0, 0, 0}});
  int first_edge = 0;
  for (std::size_t r = 0; r < from.rods.size(); ++r) {
    const std::vector<int>& node = from.rods[r];
    const std::vector<double>& s = from.position[r];
    const int last = int(node.size()) - 1;
    int k = 0;
    for (std::size_t m = 0; m < to.rods[r].size(); ++m) {
      const double at = to.position[r][m];
      while (k + 1 < last && at >= s[k + 1]) ++k;
      stencils_.push_back(stencil(node, s, k, at, to.rods[r][m]));
    }
    k = 0;
    for (std::size_t m = 1; m < to.rods[r].size(); ++m) {
      const double middle = 0.5 * (to.position[r][m - 1] + to.position[r][m]);
      while (k + 1 < last && middle >= s[k + 1]) ++k;
      edge_.push_back(first_edge + k);
    }
    first_edge += last;
  }
}

void MeshTransfer::nodes(const Eigen::Matrix3Xd& from, Eigen::Matrix3Xd& to) const {
  to.resize(3, nodes_to_);
  for (const Stencil& s : stencils_)
    to.col(s.to) = s.weight[0] * from.col(s.node[0]) + s.weight[1] * from.col(s.node[1]) +
                   s.weight[2] * from.col(s.node[2]) + s.weight[3] * from.col(s.node[3]);
}

void MeshTransfer::edges(const Eigen::VectorXd& from, Eigen::VectorXd& to) const {
  to.resize(Eigen::Index(edge_.size()));
  for (std::size_t k = 0; k < edge_.size(); ++k) to[Eigen::Index(k)] = from[edge_[k]];
}

}  // namespace gridshell
