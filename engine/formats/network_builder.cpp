// Joints that a file lists: points of several rods at different positions become one.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "engine/core/try.h"
#include "engine/formats/network_file.h"

namespace gridshell::preset {
namespace {

constexpr double farthest = 0.25;  // largest displacement, over the shortest segment at a joint

using Coordinates = std::vector<double>;

double distance(const Coordinates& a, const Coordinates& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Coordinates mean_of(const std::vector<int>& points, const Points& positions) {
  Coordinates mean(3, 0);
  for (const int point : points)
    for (std::size_t k = 0; k < 3; ++k)
      mean[k] += positions[std::size_t(point)][k] / double(points.size());
  return mean;
}

/// For every joint the length of the shortest segment of a rod at one of its points.
std::vector<double> shortest_at_joints(const NetworkData& network, const std::vector<int>& joint_of,
                                       std::size_t joints) {
  std::vector<double> shortest(joints, std::numeric_limits<double>::infinity());
  for (const std::vector<int>& rod : network.rods)
    for (std::size_t k = 1; k < rod.size(); ++k) {
      const auto a = std::size_t(rod[k - 1]), b = std::size_t(rod[k]);
      const double length = distance(network.points[a], network.points[b]);
      for (const std::size_t end : {a, b})
        if (joint_of[end] >= 0) {
          double& known = shortest[std::size_t(joint_of[end])];
          known = std::min(known, length);
        }
    }
  return shortest;
}

/// Points at which rods end and none continues.
std::set<int> ends_alone(const std::vector<std::vector<int>>& rods) {
  std::set<int> ends, passed;
  for (const std::vector<int>& rod : rods) {
    const bool ring = rod.front() == rod.back();
    passed.insert(rod.begin() + (ring ? 0 : 1), rod.end() - 1);
    if (!ring) ends.insert({rod.front(), rod.back()});
  }
  std::erase_if(ends, [&](int point) { return passed.contains(point); });
  return ends;
}

}  // namespace

Result<void> NetworkBuilder::add_joint(std::vector<int> points, const std::string& at) {
  // points at equal positions were merged before
  std::set<int> once;
  std::erase_if(points, [&](int point) { return !once.insert(point).second; });
  for (const int point : points)
    if (!listed_.insert(point).second)
      return invalid(
          "{}: point {} is of another joint too, expected one joint: list all points of a joint "
          "together",
          at, point);
  joints_.push_back({std::move(points), at});
  return {};
}

/// Checks that every point is on a rod and that no rod has two points of a joint, except to close a
/// ring.
Result<void> NetworkBuilder::check_rods(const std::vector<int>& joint_of) const {
  std::set<int> on_rods;
  for (std::size_t r = 0; r < network_.rods.size(); ++r) {
    const std::vector<int>& rod = network_.rods[r];
    on_rods.insert(rod.begin(), rod.end());
    std::map<int, std::size_t> first;
    for (std::size_t k = 0; k < rod.size(); ++k) {
      const int joint = joint_of[std::size_t(rod[k])];
      if (joint < 0) continue;
      const auto [there, is_new] = first.try_emplace(joint, k);
      const bool closes = there->second == 0 && k + 1 == rod.size() && k > 2;
      if (!is_new && !closes && rod[there->second] != rod[k])
        return invalid(
            "{}: rods[{}] has both point {} and point {}, expected points of a joint of different "
            "rods, or the two ends of a ring",
            joints_[std::size_t(joint)].at, r, rod[there->second], rod[k]);
    }
  }
  for (const Joint& joint : joints_)
    for (const int point : joint.points)
      if (!on_rods.contains(point))
        return invalid("{}: got point {}, which no rod has, expected a point of a rod", joint.at,
                       point);
  return {};
}

/// Checks that no point is moved further than a fraction of the rods' segments at its joint.
Result<void> NetworkBuilder::check_reach(const std::vector<int>& joint_of) const {
  const auto shortest = shortest_at_joints(network_, joint_of, joints_.size());
  for (std::size_t j = 0; j < joints_.size(); ++j) {
    const Coordinates mean = mean_of(joints_[j].points, network_.points);
    for (const int point : joints_[j].points) {
      const double offset = distance(network_.points[std::size_t(point)], mean);
      if (!(offset <= farthest * shortest[j]))
        return invalid(
            "{}: got point {} at {:.4g} mm from the middle of the joint's points, expected at most "
            "{:.4g} mm, a quarter of the shortest segment of rod next to them",
            joints_[j].at, point, offset, farthest * shortest[j]);
    }
  }
  return {};
}

/// Replaces the points of each joint by its first one.
void NetworkBuilder::rename(const std::vector<int>& joint_of) {
  const auto name = [&](int point) {
    const int joint = joint_of[std::size_t(point)];
    return joint < 0 ? point : joints_[std::size_t(joint)].points.front();
  };
  for (std::vector<int>& rod : network_.rods)
    for (int& point : rod) point = name(point);
  for (Points* rows : {&network_.supports, &network_.springs, &network_.joint_laws})
    for (std::vector<double>& row : *rows) row[0] = name(int(row[0]));
  std::set<int> free, supported;
  for (const std::vector<double>& row : network_.supports) supported.insert(int(row[0]));
  for (const int point : network_.free) free.insert(name(point));
  // rods that only end at a joint are joined to each other there, not fixed
  const std::set<int> ends = ends_alone(network_.rods);
  for (const Joint& joint : joints_) {
    const int point = joint.points.front();
    if (ends.contains(point) && !supported.contains(point)) free.insert(point);
  }
  network_.free.assign(free.begin(), free.end());
}

Result<void> NetworkBuilder::join_listed() {
  if (joints_.empty()) return {};
  std::vector<int> joint_of(points(), -1);
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (const int point : joints_[j].points) joint_of[std::size_t(point)] = int(j);
  if (auto fine = check_rods(joint_of); !fine) return fine;
  if (auto fine = check_reach(joint_of); !fine) return fine;
  for (const Joint& joint : joints_)
    network_.points[std::size_t(joint.points.front())] = mean_of(joint.points, network_.points);
  rename(joint_of);
  return {};
}

}  // namespace gridshell::preset
