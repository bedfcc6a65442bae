// Contacts of laths: rectangular sections that follow the normals of their joints.
#include <algorithm>
#include <cmath>

#include "engine/record/shape_contacts.h"

namespace gridshell::record {

Eigen::Vector3d ShapeContacts::normal_of(const ContactSearch::Axis& at) const {
  const auto& neighbours = at.neighbours;
  if (neighbours[0] < 0) return Vector3d::Zero();
  return (nodes_.col(neighbours[1]) - nodes_.col(neighbours[0]))
      .cross(nodes_.col(neighbours[3]) - nodes_.col(neighbours[2]))
      .stableNormalized();
}

/// Computes the axes of a segment's sections: normals are linear between those of its two joints.
void ShapeContacts::lay_sections(const Segment& s) {
  const auto of = [&](int joint) {
    return joint < 0 ? Vector3d(0, 0, 0) : normal_of(of_.axes_[std::size_t(joint)]);
  };
  Vector3d first = of(s.from), last = of(s.to);
  if (first.isZero(0)) first = last;
  if (last.isZero(0)) last = first;
  if (first.dot(last) < 0) last *= -1;
  for (int k = s.begin; k < s.end; ++k) {
    const std::size_t p = std::size_t(k);
    const double fraction = (along_[p] - along_[std::size_t(s.begin)]) / length(s);
    normal_[p] = ((1 - fraction) * first + fraction * last).stableNormalized();
    side_[p] = (x_[p + 1] - x_[p]).cross(normal_[p]).stableNormalized();
  }
}

/// Half the extent of a rod across the normal: half the width of a lath, else the radius.
double ShapeContacts::half_width(int rod) const {
  const bool lath = !of_.half_mm_.empty() && of_.half_mm_[std::size_t(rod)][0] > 0;
  return lath ? of_.half_mm_[std::size_t(rod)][0] : of_.radius_mm_[std::size_t(rod)];
}

/// Whether all rectangles of two segments of laths are separate in the direction of the first's
/// width.
bool ShapeContacts::side_by_side(int a, int b) const {
  if (of_.half_mm_.empty()) return false;
  const Segment* of[2] = {&segment(a), &segment(b)};
  const Vector3d& view = side_[std::size_t((of[0]->begin + of[0]->end) / 2)];
  double low[2], high[2];
  for (const int k : {0, 1}) {
    const auto& [width, thickness] = of_.half_mm_[std::size_t(of[k]->rod)];
    low[k] = infinity, high[k] = -infinity;
    for (int point = of[k]->begin; point <= of[k]->end; ++point) {
      const std::size_t p = std::size_t(point), edge = std::size_t(std::min(point, of[k]->end - 1));
      const double at = view.dot(x_[p]),
                   reach = width > 0 ? width * std::abs(view.dot(side_[edge])) +
                                           thickness * std::abs(view.dot(normal_[edge]))
                                     : of_.radius_mm_[std::size_t(of[k]->rod)];
      low[k] = std::min(low[k], at - reach), high[k] = std::max(high[k], at + reach);
    }
  }
  return std::max(low[0] - high[1], low[1] - high[0]) >
         half_width(of[0]->rod) + half_width(of[1]->rod);
}

double ShapeContacts::gap_of_laths(const Search& search, int edge_a, int edge_b,
                                   const NearestPoints& near) const {
  const std::size_t p[2] = {std::size_t(edge_a), std::size_t(edge_b)};
  const Vector3d apart =
      x_[p[1]] + near.t * (x_[p[1] + 1] - x_[p[1]]) - x_[p[0]] - near.s * (x_[p[0] + 1] - x_[p[0]]);
  const double same = normal_[p[0]].dot(normal_[p[1]]) < 0 ? -1 : 1;
  const Vector3d n = (normal_[p[0]] + same * normal_[p[1]]).normalized();
  if (n.isZero(0)) return apart.norm() - search.radii;
  double along = std::abs(apart.dot(n)), across = (apart - apart.dot(n) * n).norm();
  const double whole = std::max(across, 1e-300);
  for (const int k : {0, 1}) {
    const auto rod = std::size_t(segment(k == 0 ? search.a : search.b).rod);
    const auto& [width, thickness] = of_.half_mm_[rod];
    along -= width > 0 ? thickness : of_.radius_mm_[rod];
    across -= width > 0 ? width * std::abs(apart.dot(side_[p[k]])) / whole : of_.radius_mm_[rod];
  }
  return std::max(along, across);
}

}  // namespace gridshell::record
