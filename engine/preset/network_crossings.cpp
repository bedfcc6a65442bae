// Rods of a drawing are joined wherever they cross or touch.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/preset/network_draft.h"
#include "engine/preset/network_file.h"

namespace gridshell::preset {
namespace {

constexpr std::size_t most_stretches = 20000;  // each is held against each

Eigen::Vector3d place_of(const std::vector<double>& point) {
  return {point[0], point[1], point[2]};
}

/// Two points of a rod that follow one another.
struct Stretch {
  std::size_t rod, first;  ///< of which rod, and after which of its points
  int from, to;
  Eigen::Vector3d begin, end;

  Eigen::Vector3d way() const { return end - begin; }
  Eigen::Vector3d at(double share) const { return begin + share * way(); }
  double length() const { return way().norm(); }
  double low() const { return std::min(begin.x(), end.x()) - one_point_mm; }
  double high() const { return std::max(begin.x(), end.x()) + one_point_mm; }
};

/// A point to come into a stretch, at a share of its length.
struct Cut {
  std::size_t rod, first;
  double at;
  int point;
};

/// Where two stretches meet, as shares of their lengths; none: nowhere, or they run alike.
std::optional<std::pair<double, double>> meeting(const Stretch& a, const Stretch& b) {
  const Eigen::Vector3d way_a = a.way(), way_b = b.way(), apart = b.begin - a.begin;
  const Eigen::Vector3d normal = way_a.cross(way_b);
  if (!(normal.norm() > 1e-9 * a.length() * b.length())) return std::nullopt;
  // seen along the axis that is nearest to their normal, of a drawing in the plane z
  const auto beyond = [&](int k) { return std::abs(normal[2]) < std::abs(normal[k]); };
  const int view = !beyond(0) && !beyond(1) ? 2 : std::abs(normal[0]) < std::abs(normal[1]) ? 1 : 0;
  const int x = (view + 1) % 3, y = (view + 2) % 3;
  const double s = (apart[x] * way_b[y] - apart[y] * way_b[x]) / normal[view],
               t = (apart[x] * way_a[y] - apart[y] * way_a[x]) / normal[view];
  const double on_a = one_point_mm / a.length(), on_b = one_point_mm / b.length();
  if (s < -on_a || s > 1 + on_a || t < -on_b || t > 1 + on_b) return std::nullopt;
  // one passes over the other
  if ((a.at(s) - b.at(t)).norm() > one_point_mm) return std::nullopt;
  return std::pair(s, t);
}

std::vector<Stretch> stretches_of(const NetworkData& network) {
  std::vector<Stretch> all;
  for (std::size_t r = 0; r < network.rods.size(); ++r)
    for (std::size_t k = 1; k < network.rods[r].size(); ++k) {
      const int from = network.rods[r][k - 1], to = network.rods[r][k];
      all.push_back({r, k - 1, from, to, place_of(network.points[std::size_t(from)]),
                     place_of(network.points[std::size_t(to)])});
    }
  std::ranges::sort(all, {}, &Stretch::low);
  return all;
}

/// Puts the points of cuts into their rods.
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

}  // namespace

Result<void> NetworkDraft::join_crossings(const std::string& name) {
  const std::vector<Stretch> all = stretches_of(network_);
  if (all.size() > most_stretches)
    return fail(Fault::bad_input, fmt::format("{}: holds {} stretches of rods, must be at most {} "
                                              "for their crossings to be found",
                                              name, all.size(), most_stretches));
  std::vector<Cut> cuts;
  for (std::size_t k = 0; k < all.size(); ++k)
    for (std::size_t m = k + 1; m < all.size() && all[m].low() <= all[k].high(); ++m) {
      const Stretch &a = all[k], &b = all[m];
      if (a.from == b.from || a.from == b.to || a.to == b.from || a.to == b.to) continue;
      const auto met = meeting(a, b);
      if (!met) continue;
      const auto [s, t] = *met;
      const Eigen::Vector3d there = a.at(s);
      const auto point = place({there.x(), there.y(), there.z()}, name);
      if (!point) return tl::unexpected(point.error());
      if (*point != a.from && *point != a.to) cuts.push_back({a.rod, a.first, s, *point});
      if (*point != b.from && *point != b.to) cuts.push_back({b.rod, b.first, t, *point});
    }
  put(std::move(cuts), network_.rods);
  return {};
}

}  // namespace gridshell::preset
