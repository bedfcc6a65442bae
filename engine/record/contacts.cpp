#include "engine/record/contacts.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "engine/record/shape_contacts.h"

namespace gridshell::record {

ShapeContacts::ShapeContacts(const ContactSearch& search, const Eigen::Matrix3Xd& nodes)
    : of_(search), nodes_(nodes) {
  const std::size_t points = search.points_.size(), segments = search.segments_.size();
  x_.resize(points);
  along_.resize(points);
  for (std::size_t k = 0; k < points; ++k) x_[k] = nodes.col(search.points_[k]);
  box_.resize(segments);
  chord_.resize(segments);
  tree_at_.assign(segments, no_tree);
  for (std::size_t k = 0; k < segments; ++k) lay_out(k);
  if (search.half_mm_.empty()) return;
  normal_.resize(points, Vector3d::Zero());
  side_.resize(points, Vector3d::Zero());
  for (const Segment& s : search.segments_) lay_sections(s);
}

/// Computes box and chord of a segment, and the positions of its points along the rod.
void ShapeContacts::lay_out(std::size_t k) {
  const std::size_t begin = std::size_t(of_.segments_[k].begin),
                    end = std::size_t(of_.segments_[k].end);
  Chord& chord = chord_[k];
  chord.along = (x_[end] - x_[begin]).stableNormalized();
  chord.node[0] = of_.joint_nodes_[begin];
  chord.node[1] = of_.joint_nodes_[end];
  // least cosine dot / |edge|, as the two squares of the fraction: no division per edge
  double dot2 = 1, edge2 = 1;
  bool back = false;
  Box box(x_[begin]);
  for (std::size_t p = begin; p < end; ++p) {
    const Vector3d edge = x_[p + 1] - x_[p];
    box.extend(x_[p + 1]);
    const double dot = edge.dot(chord.along), square = edge.squaredNorm();
    back = back || !(dot > 0);
    along_[p + 1] = along_[p] + std::sqrt(square);
    if (dot * dot * edge2 < dot2 * square) std::tie(dot2, edge2) = std::pair(dot * dot, square);
  }
  box_[k] = box;
  chord.cosine = back ? -1 : std::sqrt(dot2 / std::max(edge2, 1e-300));
  chord.sine = std::sqrt(std::max(0.0, 1 - chord.cosine * chord.cosine));
}

void ShapeContacts::grow_tree(int k) {
  if (tree_at_[k] != no_tree) return;
  const Segment& s = segment(k);
  tree_at_[k] = int(edge_.size()) - s.begin;
  for (int p = s.begin; p < s.end; ++p) {
    edge_.emplace_back(x_[p]);
    edge_.back().extend(x_[p + 1]);
  }
  tree_.resize(edge_.size());
  grown(k, s.begin, s.end);
}

Eigen::AlignedBox3d ShapeContacts::grown(int k, int begin, int end) {
  if (end - begin == 1) return box_of(k, begin, end);
  const int middle = (begin + end) / 2;
  Box box = grown(k, begin, middle);
  box.extend(grown(k, middle, end));
  return tree_[middle + tree_at_[k]] = box;
}

/// Whether two segments are more than a diameter away from each other, by a bound: the distance of
/// their chords less the largest distances of the segments from their chords.
bool ShapeContacts::apart(int a, int b) const {
  const Segment &one = segment(a), &other = segment(b);
  const auto x = [&](int point) { return x_[point]; };
  const Chord &ca = chord_[a], &cb = chord_[b];
  if (!(std::min(ca.cosine, cb.cosine) > 0)) return false;
  const double reach = 0.5 * (length(one) * ca.sine + length(other) * cb.sine) +
                       2 * (of_.radius_mm_[one.rod] + of_.radius_mm_[other.rod]);
  return nearest_points(x(one.begin), x(one.end), x(other.begin), x(other.end)).distance2 >
         reach * reach;
}

/// Whether two segments that meet at one joint are more than a diameter away from each other
/// outside the joint's cylinder, because the cones around their chords are far enough from each
/// other.
bool ShapeContacts::apart_but_at_joint(int a, int b) const {
  const Chord &ca = chord_[a], &cb = chord_[b];
  int shared = 0;
  double between = 0;  // cosine of the angle between the chords, away from the joint
  for (const int end : {0, 1})
    for (const int other : {0, 1}) {
      if (ca.node[end] != cb.node[other]) continue;
      ++shared;
      between = (end == other ? 1 : -1) * ca.along.dot(cb.along);
    }
  if (shared != 1) return false;
  // sine of the angle between the nearest rays of the two cones
  const double across = std::sqrt(std::max(0.0, 1 - between * between));
  const double cosine = ca.cosine * cb.cosine - ca.sine * cb.sine,
               sine = ca.sine * cb.cosine + ca.cosine * cb.sine;
  const double apart = across * cosine - between * sine;
  if (!(apart > 0)) return false;
  const bool wide = between * cosine + across * sine < 0;
  const double radii = of_.radius_mm_[segment(a).rod] + of_.radius_mm_[segment(b).rod];
  return 0.5 * of_.joint_diameter_mm_ * std::min(ca.cosine, cb.cosine) * (wide ? 1 : apart) >
         2 * radii;
}

/// If the segments of a search meet at these two points, in a joint or as ends at one support, adds
/// the distance from there within which points are not compared (ContactSearch).
void ShapeContacts::add_joint(Search& search, int point_a, int point_b) const {
  const Segment &a = segment(search.a), &b = segment(search.b);
  const auto ends = [](const Segment& s, int point) {
    return (point == s.begin ? s.from : s.to) < 0;
  };
  const auto apart = [&] { return (x_[point_a] - x_[point_b]).norm(); };
  const bool same_point =
      node(point_a) == node(point_b) ||
      (search.a != search.b && ends(a, point_a) && ends(b, point_b) && apart() < search.radii);
  if (!same_point || search.joints == 2) return;
  const auto away = [&](const Segment& s, int point) {
    const int neighbour = point == s.begin ? point + 1 : point - 1;
    return (x_[neighbour] - x_[point]).stableNormalized();
  };
  // twice the sine of half the angle
  const double spread = (away(a, point_a) - away(b, point_b)).norm();
  const double half = 0.5 * std::min(length(a), length(b));
  const double across = half_width(a.rod) + half_width(b.rod);
  const double straight = std::min(half, 2 * across / std::max(spread, 1e-12));
  search.joint[search.joints++] = {along_[point_a], along_[point_b],
                                   std::max(0.5 * of_.joint_diameter_mm_, straight)};
}

ShapeContacts::Search ShapeContacts::between(int a, int b) const {
  Search search;
  search.a = a;
  search.b = b;
  const Segment &one = segment(a), &other = segment(b);
  search.radii = of_.radius_mm_[one.rod] + of_.radius_mm_[other.rod];
  search.gap = half_width(one.rod) + half_width(other.rod);
  search.apart = one.rod == other.rod ? std::numbers::pi * search.radii : -infinity;
  if (const auto [first, last] = of_.ends_[std::size_t(one.rod)]; node(first) == node(last))
    search.round = along_[last] - along_[first];
  if (a == b) {
    add_joint(search, one.begin, one.end);  // a ring with one joint
    return search;
  }
  for (const int point : {one.begin, one.end})
    for (const int end : {other.begin, other.end}) add_joint(search, point, end);
  return search;
}

void ShapeContacts::look_at_edges(Search& search, int edge_a, int edge_b) const {
  const std::size_t a = std::size_t(edge_a), b = std::size_t(edge_b);
  const NearestPoints near = nearest_points(x_[a], x_[a + 1], x_[b], x_[b + 1]);
  double gap = std::sqrt(near.distance2) - search.radii;
  if (!(gap < search.gap)) return;
  if (!of_.half_mm_.empty()) gap = gap_of_laths(search, edge_a, edge_b, near);
  if (!(gap < search.gap)) return;
  const double at_a = along_[a] + near.s * (along_[a + 1] - along_[a]);
  const double at_b = along_[b] + near.t * (along_[b + 1] - along_[b]);
  if (!search.reported(at_a, at_b)) return;
  search.any = true;
  search.gap = gap;
  search.found = {
      ContactKind::rods, segment(search.a).rod, segment(search.b).rod, gap,
      0.5 * (x_[a] + near.s * (x_[a + 1] - x_[a]) + x_[b] + near.t * (x_[b + 1] - x_[b]))};
}

void ShapeContacts::look(Search& search, int begin_a, int end_a, int begin_b, int end_b) const {
  if (!are_near(box_of(search.a, begin_a, end_a), box_of(search.b, begin_b, end_b),
                search.radii + search.gap))
    return;
  const auto along = [&](int point) { return along_[point]; };
  for (int k = 0; k < search.joints; ++k) {
    const Joint& joint = search.joint[k];
    // an edge of a short leg may end exactly there
    const double most = joint.within * (1 + 1e-9);
    const auto within = [&](int begin, int end, double at) {
      return std::max(std::abs(along(begin) - at), std::abs(along(end) - at)) <= most;
    };
    if (within(begin_a, end_a, joint.at_a) && within(begin_b, end_b, joint.at_b)) return;
  }
  const int edges_a = end_a - begin_a, edges_b = end_b - begin_b;
  if (edges_a == 1 && edges_b == 1) return look_at_edges(search, begin_a, begin_b);
  const int middle_a = (begin_a + end_a) / 2, middle_b = (begin_b + end_b) / 2;
  if (edges_b == 1 || edges_a > edges_b) {
    look(search, begin_a, middle_a, begin_b, end_b);
    look(search, middle_a, end_a, begin_b, end_b);
  } else {
    look(search, begin_a, end_a, begin_b, middle_b);
    look(search, begin_a, end_a, middle_b, end_b);
  }
}

/// Compares every two edges of one segment.
void ShapeContacts::look_within(Search& search, int begin, int end) const {
  if (end - begin == 1) return;
  const int middle = (begin + end) / 2;
  look_within(search, begin, middle);
  look_within(search, middle, end);
  look(search, begin, middle, middle, end);
}

void ShapeContacts::take(const Search& search) {
  if (!search.any) return;
  if (!(search.gap >= all_.rod_gap_mm)) all_.rod_gap_mm = search.gap;
  if (search.gap < 0) all_.interpenetrations.push_back(search.found);
}

void ShapeContacts::rods(bool by_all_pairs) {
  const int count = int(of_.segments_.size());
  const auto every_edge = [&](Search search) {
    const Segment &a = segment(search.a), &b = segment(search.b);
    for (int e = a.begin; e < a.end; ++e)
      for (int f = search.a == search.b ? e + 1 : b.begin; f < b.end; ++f)
        look_at_edges(search, e, f);
    take(search);
  };
  if (by_all_pairs) {
    for (int a = 0; a < count; ++a)
      for (int b = a; b < count; ++b) every_edge(between(a, b));
    return;
  }
  double widest = 0;
  for (const double radius : of_.radius_mm_) widest = std::max(widest, radius);
  for (int a = 0; a < count; ++a) {
    // a segment whose edges are all within 50 degrees of its chord cannot touch itself: points at a
    // distance pi S along it are at least 2 S from each other
    if (chord_[a].cosine > 2 / std::numbers::pi) continue;
    Search search = between(a, a);
    grow_tree(a);
    look_within(search, segment(a).begin, segment(a).end);
    take(search);
  }
  each_near_pair(box_, 4 * widest, [&](int a, int b) {
    if (apart_but_at_joint(a, b) || apart(a, b) || side_by_side(a, b)) return;
    grow_tree(a);
    grow_tree(b);
    Search search = between(a, b);
    look(search, segment(a).begin, segment(a).end, segment(b).begin, segment(b).end);
    take(search);
  });
}

void ShapeContacts::joints(bool by_all_pairs) {
  const double diameter = of_.joint_diameter_mm_;
  const std::size_t count = of_.axes_.size();
  std::vector<Vector3d> foot(count), top(count);
  std::vector<Box> boxes(count);
  const auto has_cylinder = [&](int k) { return of_.axes_[std::size_t(k)].neighbours[2] >= 0; };
  for (std::size_t k = 0; k < count; ++k) {
    foot[k] = top[k] = nodes_.col(of_.axes_[k].node);
    top[k] += of_.joint_height_mm_ * normal_of(of_.axes_[k]);
    boxes[k].extend(foot[k]);
    boxes[k].extend(top[k]);
  }
  const auto look = [&](int a, int b) {
    if (!has_cylinder(a) || !has_cylinder(b)) return;
    const std::size_t i = std::size_t(a), j = std::size_t(b);
    const NearestPoints near = nearest_points(foot[i], top[i], foot[j], top[j]);
    const double gap = std::sqrt(near.distance2) - diameter;
    if (gap >= diameter) return;
    if (!(gap >= all_.joint_gap_mm)) all_.joint_gap_mm = gap;
    if (gap < 0)
      all_.interpenetrations.push_back(
          {ContactKind::joints, a, b, gap,
           0.5 * (foot[i] + near.s * (top[i] - foot[i]) + foot[j] + near.t * (top[j] - foot[j]))});
  };
  if (!by_all_pairs) return each_near_pair(boxes, 2 * diameter, look);
  for (int a = 0; a < int(count); ++a)
    for (int b = a + 1; b < int(count); ++b) look(a, b);
}

void ShapeContacts::table() {
  if (std::isnan(of_.table_mm_)) return;
  for (const Segment& s : of_.segments_) {
    const auto lowest =
        std::min_element(x_.begin() + s.begin, x_.begin() + s.end + 1,
                         [](const Vector3d& a, const Vector3d& b) { return a.z() < b.z(); });
    const double gap = lowest->z() - of_.table_mm_ + of_.radius_mm_[s.rod];
    if (gap < 0) all_.interpenetrations.push_back({ContactKind::table, s.rod, -1, gap, *lowest});
  }
}

Contacts ShapeContacts::found(bool by_all_pairs) {
  rods(by_all_pairs);
  if (of_.joint_diameter_mm_ > 0) joints(by_all_pairs);
  table();
  std::ranges::sort(all_.interpenetrations, [](const Contact& a, const Contact& b) {
    return std::tuple(a.kind, a.gap_mm, a.first, a.second) <
           std::tuple(b.kind, b.gap_mm, b.first, b.second);
  });
  return std::move(all_);
}

ContactSearch::ContactSearch(const Layout& layout)
    : joint_diameter_mm_(layout.joint_diameter_mm),
      joint_height_mm_(layout.joint_height_mm),
      table_mm_(layout.table_mm) {
  int nodes = 0;
  for (const auto& rod : layout.rods)
    for (const int node : rod) nodes = std::max(nodes, node + 1);
  for (const Joint& joint : layout.joints) nodes = std::max(nodes, joint.node + 1);
  std::vector<int> axis(std::size_t(nodes), -1);
  for (const Joint& joint : layout.joints) {
    axis[joint.node] = int(axes_.size());
    axes_.push_back({joint.node});
  }
  for (std::size_t k = 0; k < layout.above.size(); ++k) axis[std::size_t(layout.above[k])] = int(k);
  for (std::size_t r = 0; r < layout.rods.size(); ++r) {
    const auto& rod = layout.rods[r];
    radius_mm_.push_back(0.5 * diameter_of(layout, r));
    if (!layout.laths_mm.empty()) {
      half_mm_.push_back({0.5 * layout.laths_mm[2 * r], 0.5 * layout.laths_mm[2 * r + 1]});
      const double corner = std::hypot(half_mm_[r][0], half_mm_[r][1]);
      if (corner > 0) radius_mm_.back() = corner;
    }
    const int first = int(points_.size()), last = int(rod.size()) - 1;
    points_.insert(points_.end(), rod.begin(), rod.end());
    ends_.push_back({first, first + last});
    for (const int node : rod) {
      const int joint = axis[std::size_t(node)];
      joint_nodes_.push_back(joint < 0 ? node : axes_[std::size_t(joint)].node);
    }
    for (int k = 0, begin = 0; k <= last; ++k) {
      const int joint = axis[std::size_t(rod[k])];
      if (k > begin && (joint >= 0 || k == last)) {
        segments_.push_back(
            {int(r), first + begin, first + k, axis[std::size_t(rod[begin])], joint});
        begin = k;
      }
      // a ring ends at the joint at which it starts
      const bool ring = last > 1 && rod.front() == rod.back();
      if (joint < 0 || (ring && k == last)) continue;
      auto& neighbours = axes_[joint].neighbours;
      const std::size_t free = neighbours[0] < 0 ? 0 : 2;
      if (neighbours[free] >= 0) continue;
      neighbours[free] = rod[std::size_t(k > 0 ? k - 1 : ring ? last - 1 : 0)];
      neighbours[free + 1] = rod[std::size_t(std::min(k + 1, last))];
    }
  }
  for (Axis& at : axes_)
    if (at.neighbours[2] < 0) at.neighbours.fill(-1);
}

Contacts ContactSearch::in(const Eigen::Matrix3Xd& nodes) const {
  return ShapeContacts(*this, nodes).found(false);
}
Contacts ContactSearch::by_all_pairs(const Eigen::Matrix3Xd& nodes) const {
  return ShapeContacts(*this, nodes).found(true);
}

const Contact* Contacts::deepest(ContactKind kind) const {
  const auto found = std::ranges::find(interpenetrations, kind, &Contact::kind);
  return found == interpenetrations.end() ? nullptr : &*found;
}

}  // namespace gridshell::record
