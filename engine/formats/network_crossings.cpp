// Joins the rods of a drawing wherever they cross or touch.

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "engine/core/algorithms.h"
#include "engine/core/proximity.h"
#include "engine/core/try.h"
#include "engine/formats/network_file.h"

namespace gridshell::preset {
namespace {

constexpr std::size_t most_stretches = 40000;  // every two may be compared

/// The straight segment between two neighbouring points of a rod.
struct Stretch {
  std::size_t rod, first;  ///< the rod, and the position of the first point in it
  int from, to;
  Eigen::Vector3d begin, end;

  Eigen::Vector3d vector() const { return end - begin; }
  Eigen::Vector3d at(double fraction) const { return begin + fraction * vector(); }
  double length() const { return vector().norm(); }
  double low() const { return std::min(begin.x(), end.x()) - one_point_mm; }
  /// Whether the two overlap along axis k, within a distance `by`.
  bool near(const Stretch& other, int k, double by) const {
    return std::min(begin[k], end[k]) <= std::max(other.begin[k], other.end[k]) + by &&
           std::min(other.begin[k], other.end[k]) <= std::max(begin[k], end[k]) + by;
  }
  double high() const { return std::max(begin.x(), end.x()) + one_point_mm; }
};

/// A point that is inserted into a segment, at a fraction of its length.
struct Cut {
  std::size_t rod, first;
  double at;
  int point;
};

/// The point where two segments meet, as fractions of their lengths; empty: they do not, or are
/// parallel.
std::optional<std::pair<double, double>> meeting(const Stretch& a, const Stretch& b, double near) {
  const Eigen::Vector3d vector_a = a.vector(), vector_b = b.vector(), apart = b.begin - a.begin;
  const Eigen::Vector3d normal = vector_a.cross(vector_b);
  if (!(normal.norm() > 1e-9 * a.length() * b.length())) return std::nullopt;
  // solved in the plane of the two axes across the one nearest to their normal: z for flat drawings
  const auto larger = [&](int k) { return std::abs(normal[2]) < std::abs(normal[k]); };
  const int view = !larger(0) && !larger(1) ? 2 : std::abs(normal[0]) < std::abs(normal[1]) ? 1 : 0;
  const int x = (view + 1) % 3, y = (view + 2) % 3;
  const double s = (apart[x] * vector_b[y] - apart[y] * vector_b[x]) / normal[view],
               t = (apart[x] * vector_a[y] - apart[y] * vector_a[x]) / normal[view];
  const double on_a = one_point_mm / a.length(), on_b = one_point_mm / b.length();
  if (s < -on_a || s > 1 + on_a || t < -on_b || t > 1 + on_b) return std::nullopt;
  // one passes over the other
  if ((a.at(s) - b.at(t)).norm() > near) return std::nullopt;
  return std::pair(s, t);
}

std::vector<Stretch> stretches_of(const NetworkData& network) {
  std::vector<Stretch> all;
  for (std::size_t r = 0; r < network.rods.size(); ++r)
    for (std::size_t k = 1; k < network.rods[r].size(); ++k) {
      const int from = network.rods[r][k - 1], to = network.rods[r][k];
      all.push_back({r, k - 1, from, to, position_of(network, from), position_of(network, to)});
    }
  std::ranges::sort(all, {}, &Stretch::low);
  return all;
}

/// Inserts the points of cuts into their rods.
void put(std::vector<Cut> cuts, std::vector<std::vector<int>>& rods) {
  std::ranges::sort(cuts, {}, [](const Cut& c) { return std::tuple(c.rod, c.first, c.at); });
  auto next = cuts.begin();
  for (std::size_t r = 0; r < rods.size(); ++r) {
    std::vector<int> points;
    for (std::size_t k = 0; k < rods[r].size(); ++k) {
      points.push_back(rods[r][k]);
      for (; next != cuts.end() && next->rod == r && next->first == k; ++next)
        points.push_back(next->point);
    }
    points.erase(std::unique(points.begin(), points.end()), points.end());
    rods[r] = std::move(points);
  }
}

/// Length over which two segments lie on one another; at most 0: they do not.
double overlap(const Stretch& a, const Stretch& b) {
  constexpr double alike = 1e-6;
  const Eigen::Vector3d along = a.vector().normalized();
  if (along.cross(b.vector()).norm() > alike * b.length()) return 0;
  const Eigen::Vector3d apart = b.begin - a.begin;
  if (along.cross(apart).norm() > one_point_mm) return 0;
  const double from = along.dot(apart), to = along.dot(b.end - a.begin);
  return std::min(a.length(), std::max(from, to)) - std::max(0.0, std::min(from, to));
}

}  // namespace

Result<void> NetworkBuilder::join_ends(const std::string& name) {
  constexpr std::size_t most_looked_at = 1000000000;
  if (!joins_near()) return {};
  const std::vector<PointUse> uses = uses_of(points(), network_.rods);
  const std::vector<Stretch> all = stretches_of(network_);
  if (2 * network_.rods.size() * all.size() > most_looked_at)
    return invalid("{}: got too many rods for their ends to be joined, expected join_mm = 0", name);
  std::vector<Cut> cuts;
  for (std::size_t r = 0; r < network_.rods.size(); ++r)
    for (const int end : {network_.rods[r].front(), network_.rods[r].back()}) {
      const auto [passes, ends] = uses[std::size_t(end)];
      if (passes + ends != 1) continue;
      std::vector<double>& coordinates = network_.points[std::size_t(end)];
      const Eigen::Vector3d at = position_of(network_, end);
      const Stretch* nearest = nullptr;
      double least = near_mm_;
      for (const Stretch& one : all) {
        if (one.low() - near_mm_ > at.x()) break;
        const double away = distance_to_segment(at, one.begin, one.end);
        if (one.rod != r && away < least) least = away, nearest = &one;
      }
      if (!nearest) continue;
      const double fraction = nearest_fraction(at, nearest->begin, nearest->end);
      const Eigen::Vector3d foot = nearest->at(fraction);
      coordinates = {foot.x(), foot.y(), foot.z()};
      cuts.push_back({nearest->rod, nearest->first, fraction, end});
    }
  put(std::move(cuts), network_.rods);
  return {};
}

Result<void> NetworkBuilder::join_crossings(const std::string& name) {
  const std::vector<Stretch> all = stretches_of(network_);
  if (all.size() > most_stretches)
    return invalid(
        "{}: got {} segments of rods, expected at most {} for their crossings to be found", name,
        all.size(), most_stretches);
  std::vector<Cut> cuts;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t m = k + 1; m < all.size() && all[m].low() <= all[k].high() + near_mm_; ++m) {
      const Stretch &a = all[k], &b = all[m];
      if (!a.near(b, 1, near_mm_) || !a.near(b, 2, near_mm_)) continue;
      if (const double length = overlap(a, b); length > near_mm_)
        return invalid("{}: got a rod on the rod at {}, over {:.4g} mm, expected one of them",
                       locations_[std::max(a.rod, b.rod)], locations_[std::min(a.rod, b.rod)],
                       length);
      if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) continue;
      const auto met = meeting(a, b, near_mm_);
      if (!met) continue;
      const auto [s, t] = *met;
      const Eigen::Vector3d there = a.at(s);
      TRY(point, find_or_add_point({there.x(), there.y(), there.z()}, name));
      if (*point != a.from && *point != a.to) cuts.push_back({a.rod, a.first, s, *point});
      if (*point != b.from && *point != b.to) cuts.push_back({b.rod, b.first, t, *point});
    }
  put(std::move(cuts), network_.rods);
  return {};
}

}  // namespace gridshell::preset
