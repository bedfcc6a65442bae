// Report on a network that was read, with notes on probable mistakes.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "engine/core/algorithms.h"
#include "engine/core/proximity.h"
#include "engine/core/text.h"
#include "engine/formats/network_file.h"

namespace gridshell::preset {
namespace {

/// Distances of neighbouring joints and ends along the rods, mm.
std::vector<double> segments_of(const NetworkData& network, const std::vector<PointUse>& uses) {
  std::vector<double> segments;
  for (const std::vector<int>& rod : network.rods) {
    double length = 0;
    for (std::size_t k = 1; k < rod.size(); ++k) {
      length += (position_of(network, rod[k]) - position_of(network, rod[k - 1])).norm();
      const PointUse& use = uses[std::size_t(rod[k])];
      if (use.passes + use.ends < 2 && k + 1 < rod.size()) continue;
      segments.push_back(length);
      length = 0;
    }
  }
  return segments;
}

/// Two points of different rods that are near to each other, or an end of a rod that is near to
/// another rod, and not joined.
struct NearPair {
  Eigen::Vector3d first;
  double apart_mm = 0;
};

/// Finds pairs of points nearer to each other than `near` that are not joined, by a grid of cells
/// of that size.
class NearPoints {
 public:
  NearPoints(const NetworkData& network, double near) : network_(network), near_(near) {
    rods_.resize(network.points.size());
    neighbours_.resize(network.points.size());
    for (const std::vector<int>& rod : network.rods)
      for (std::size_t k = 1; k < rod.size(); ++k) {
        neighbours_[std::size_t(rod[k])].push_back(rod[k - 1]);
        neighbours_[std::size_t(rod[k - 1])].push_back(rod[k]);
      }
    for (std::size_t r = 0; r < network.rods.size(); ++r)
      for (const int point : network.rods[r]) {
        auto& rods = rods_[std::size_t(point)];
        if (rods.empty()) cells_[cell_of(position_of(network, point))].push_back(point);
        if (rods.empty() || rods.back() != int(r)) rods.push_back(int(r));
      }
  }

  std::vector<NearPair> find() const {
    constexpr std::size_t most = 20000000;  // pairs looked at
    std::size_t looked_at = 0;
    std::vector<NearPair> pairs;
    std::set<int> found;
    for (const auto& [cell, points] : cells_)
      for (const int a : points)
        for (int n = 0; n < 27; ++n) {
          const auto near =
              cells_.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
          if (near == cells_.end()) continue;
          for (const int b : near->second) {
            if (++looked_at > most) return pairs;
            const double apart = (position_of(network_, a) - position_of(network_, b)).norm();
            if (b <= a || !(apart < near_) || share_a_rod(a, b) || pass(a, b)) continue;
            pairs.push_back({position_of(network_, a), apart});
            found.insert({a, b});
          }
        }
    add_short_ends(found, pairs);
    return pairs;
  }

 private:
  using Cell = std::array<long, 3>;
  Cell cell_of(const Eigen::Vector3d& at) const {
    Cell cell{};
    for (int k = 0; k < 3; ++k) cell[std::size_t(k)] = long(std::floor(at[k] / near_));
    return cell;
  }

  bool share_a_rod(int a, int b) const {
    const auto &of_a = rods_[std::size_t(a)], &of_b = rods_[std::size_t(b)];
    return std::ranges::any_of(of_a, [&](int rod) { return std::ranges::count(of_b, rod) > 0; });
  }

  /// Whether all rods at two points are parallel neighbours, as laths in a bundle are.
  bool pass(int a, int b) const {
    // ends that the file declares free are not a mistake
    if (std::ranges::count(network_.free, a) + std::ranges::count(network_.free, b) > 0)
      return true;
    constexpr double alike = 0.25;  // sine of the angle between parallel rods, at most
    const Eigen::Vector3d apart = position_of(network_, b) - position_of(network_, a);
    for (const int next : neighbours_[std::size_t(a)])
      for (const int other : neighbours_[std::size_t(b)]) {
        const Eigen::Vector3d
            u = (position_of(network_, next) - position_of(network_, a)).normalized(),
            v = (position_of(network_, other) - position_of(network_, b)).normalized();
        // they cross, or one continues the other
        if (u.cross(v).norm() > alike || u.cross(apart).norm() < 0.5 * apart.norm()) return false;
      }
    return true;
  }

  /// Adds ends without a joint that are near to a rod.
  void add_short_ends(const std::set<int>& found, std::vector<NearPair>& pairs) const {
    constexpr std::size_t most = 20000000;  // pairs looked at
    std::vector<std::pair<int, int>> ends;  // the point and its rod
    std::size_t stretches = 0;
    for (std::size_t r = 0; r < network_.rods.size(); ++r) {
      const std::vector<int>& rod = network_.rods[r];
      stretches += rod.size() - 1;
      for (const int end : {rod.front(), rod.back()})
        if (rods_[std::size_t(end)].size() == 1 && rod.front() != rod.back() &&
            !found.contains(end))
          ends.emplace_back(end, int(r));
    }
    if (ends.size() * stretches > most) return;
    for (const auto& [end, own] : ends) {
      const std::vector<int>& rod = network_.rods[std::size_t(own)];
      // rods that are joined at the next point are near for a reason: the end reaches past them
      const int next = end == rod.front() ? rod[1] : rod[rod.size() - 2];
      const Eigen::Vector3d at = position_of(network_, end);
      double least = near_;
      for (std::size_t r = 0; r < network_.rods.size(); ++r)
        for (std::size_t k = 1; k < network_.rods[r].size() && int(r) != own; ++k)
          if (std::ranges::count(rods_[std::size_t(next)], int(r)) == 0 &&
              !pass(end, network_.rods[r][k]))
            least = std::min(least,
                             distance_to_segment(at, position_of(network_, network_.rods[r][k - 1]),
                                                 position_of(network_, network_.rods[r][k])));
      if (least < near_) pairs.push_back({at, least});
    }
  }

  const NetworkData& network_;
  double near_;
  std::map<Cell, std::vector<int>> cells_;
  std::vector<std::vector<int>> rods_,
      neighbours_;  // rods through each point; its neighbours on them
};

}  // namespace

double spacing_of(const NetworkData& network) {
  std::vector<double> segments = segments_of(network, uses_of(network.points.size(), network.rods));
  if (segments.empty()) return 0;
  const auto middle = segments.begin() + std::ptrdiff_t(segments.size() / 2);
  std::nth_element(segments.begin(), middle, segments.end());
  return *middle;
}

void report_network(const NetworkData& network, const NetworkOptions& options, FileReport& report) {
  const std::vector<PointUse> uses = uses_of(network.points.size(), network.rods);
  std::set<int> free(network.free.begin(), network.free.end()), named, laws, sprung;
  for (const auto& row : network.springs) sprung.insert(int(row[0]));
  for (const auto& row : network.supports) named.insert(int(row[0]));
  for (const auto& row : network.joint_laws) laws.insert(int(row[0]));
  std::size_t joints = 0, supports = 0, free_ends = 0, together = 0;
  Eigen::AlignedBox3d box;
  for (int point = 0; point < int(uses.size()); ++point) {
    const auto [passes, ends] = uses[std::size_t(point)];
    if (passes + ends == 0) continue;
    box.extend(position_of(network, point));
    const bool hinged = free.contains(point) || sprung.contains(point) ||
                        (laws.contains(point) && !named.contains(point));
    if (passes + ends > 1 && (passes > 0 || hinged)) ++joints;
    if (named.contains(point) || (passes == 0 && !hinged)) ++supports;
    if (passes == 0 && ends == 1 && free.contains(point)) ++free_ends;
    if (passes == 0 && ends > 1 && !hinged && !named.contains(point)) ++together;
  }
  const Eigen::Vector3d size = box.sizes();
  report.text += fmt::format("{}, {}, {}, {}, {:.6g} x {:.6g}{} mm",
                             counted(network.rods.size(), "rod"), counted(joints, "joint"),
                             counted(supports, "support"), counted(free_ends, "free end"), size.x(),
                             size.y(), size.z() > 0 ? fmt::format(" x {:.6g}", size.z()) : "");
  if (together > 0)
    report.text +=
        fmt::format("; at {} rods end together and are fixed", counted(together, "support"));
  if (size.y() < 1e-6 * size.x() && size.z() > 1e-3 * size.x())
    report.notes.push_back(
        fmt::format("all rods lie upright in the plane y = {}: is y up in this drawing? Then "
                    "exchange y and z",
                    box.min().y()));
  const double near = 0.1 * spacing_of(network);
  if (!(near > 0) || options.linkage) return;
  const auto pairs = NearPoints(network, near).find();
  if (pairs.empty()) return;
  const auto widest = std::ranges::max_element(pairs, {}, &NearPair::apart_mm);
  report.notes.push_back(fmt::format(
      "{} nearer than a tenth of the spacing ({:.3g} mm) and not joined, the first at ({:.6g}, "
      "{:.6g}, {:.6g}): [footprint] join_mm = {:.2g} joins them",
      pairs.size() == 1 ? "a pair of points lies"
                        : fmt::format("{} pairs of points lie", pairs.size()),
      near, pairs[0].first.x(), pairs[0].first.y(), pairs[0].first.z(), 1.1 * widest->apart_mm));
}

}  // namespace gridshell::preset
