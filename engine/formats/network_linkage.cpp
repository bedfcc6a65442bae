// Linkages: joins lines that are segments to rods, by their directions at each joint.

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/formats/network_file.h"

namespace gridshell::preset {
namespace {

/// An end of a segment at a joint.
struct SegmentEnd {
  int number = 0;         ///< 2 r for the start, 2 r + 1 for the end of line r
  int to = 0;             ///< the point at the other end
  Eigen::Vector3d out{};  ///< unit vector away from the joint
};
using SegmentEnds = std::vector<std::vector<SegmentEnd>>;  // ends at each point

SegmentEnds segment_ends(const NetworkData& network) {
  SegmentEnds ends(network.points.size());
  for (std::size_t r = 0; r < network.rods.size(); ++r) {
    const int a = network.rods[r].front(), b = network.rods[r].back();
    const Eigen::Vector3d direction =
        (position_of(network, b) - position_of(network, a)).normalized();
    ends[std::size_t(a)].push_back({int(2 * r), b, direction});
    ends[std::size_t(b)].push_back({int(2 * r) + 1, a, -direction});
  }
  return ends;
}

/// Whether two segments of a joint, joined to one rod, would close a triangle with two other rods:
/// their far points then have another common neighbour than the joint.
bool make_triangle(const SegmentEnds& ends, const SegmentEnd& a, const SegmentEnd& b) {
  std::set<int> neighbours;
  for (const SegmentEnd& one : ends[std::size_t(a.to)]) neighbours.insert(one.to);
  return std::ranges::count_if(ends[std::size_t(b.to)], [&](const SegmentEnd& one) {
           return neighbours.contains(one.to);
         }) > 1;
}

/// Indices of the two of three segments that are straightest and make no triangle; or empty.
std::vector<std::array<std::size_t, 2>> straightest(const SegmentEnds& all,
                                                    const std::vector<SegmentEnd>& ends) {
  std::vector<std::array<std::size_t, 2>> best;
  double least = 2;
  for (const auto& pair : {std::array<std::size_t, 2>{0, 1}, {0, 2}, {1, 2}}) {
    const double cosine = ends[pair[0]].out.dot(ends[pair[1]].out);
    if (!(cosine < least) || make_triangle(all, ends[pair[0]], ends[pair[1]])) continue;
    least = cosine;
    best = {pair};
  }
  return best;
}

/// Indices of the two pairs of four segments that are opposite each other about the joint's normal.
std::vector<std::array<std::size_t, 2>> opposite(const std::vector<SegmentEnd>& ends) {
  Eigen::Vector3d normal(0, 0, 0);
  for (const SegmentEnd& one : ends) {
    const Eigen::Vector3d across = one.out.cross(ends[0].out);
    if (across.squaredNorm() > normal.squaredNorm()) normal = across;
  }
  normal.normalize();
  std::array<std::pair<double, std::size_t>, 3> turned;
  for (std::size_t k = 1; k < 4; ++k) {
    const double angle = std::atan2(
        normal.dot(ends[0].out.cross(ends[k].out)),
        ends[0].out.dot(ends[k].out) - normal.dot(ends[0].out) * normal.dot(ends[k].out));
    turned[k - 1] = {angle < 0 ? angle + 2 * M_PI : angle, k};
  }
  std::ranges::sort(turned);
  return {{0, turned[1].second}, {turned[0].second, turned[2].second}};
}

/// A joint of two rods.
struct RodCrossing {
  int point = 0;
  std::array<int, 2> rods{};
  Eigen::Vector3d across{};  ///< tangent of the first rod x tangent of the second
  double angle = 0;          ///< angle between the tangents, rad
};

std::vector<RodCrossing> crossings_of(const NetworkData& network) {
  std::map<int, std::vector<std::pair<int, Eigen::Vector3d>>> at;
  for (std::size_t r = 0; r < network.rods.size(); ++r) {
    const std::vector<int>& rod = network.rods[r];
    const bool ring = rod.front() == rod.back();
    const std::size_t last = rod.size() - 1;
    for (std::size_t k = ring ? 1 : 0; k <= last; ++k) {
      const int before = k > 0 ? rod[k - 1] : rod[0], after = k < last ? rod[k + 1]
                                                              : ring   ? rod[1]
                                                                       : rod[last];
      at[rod[k]].emplace_back(
          int(r), (position_of(network, after) - position_of(network, before)).normalized());
    }
  }
  std::vector<RodCrossing> all;
  for (const auto& [point, rods] : at)
    if (rods.size() == 2 && rods[0].first != rods[1].first) {
      const Eigen::Vector3d across = rods[0].second.cross(rods[1].second);
      all.push_back({point,
                     {rods[0].first, rods[1].first},
                     across,
                     std::atan2(across.norm(), rods[0].second.dot(rods[1].second))});
    }
  return all;
}

/// Indices of the crossings on each rod, in order along it.
std::vector<std::vector<std::size_t>> crossings_along(const NetworkData& network,
                                                      const std::vector<RodCrossing>& crossings) {
  std::map<int, std::size_t> at;
  for (std::size_t k = 0; k < crossings.size(); ++k) at[crossings[k].point] = k;
  std::vector<std::vector<std::size_t>> along(network.rods.size());
  for (std::size_t r = 0; r < network.rods.size(); ++r)
    for (const int point : network.rods[r])
      if (const auto found = at.find(point); found != at.end()) along[r].push_back(found->second);
  return along;
}

}  // namespace

OpeningSense opening_sense(const NetworkData& network) {
  OpeningSense sense;
  const std::vector<RodCrossing> crossings = crossings_of(network);
  const auto along = crossings_along(network, crossings);
  std::vector<Eigen::Vector3d> normals;
  for (const RodCrossing& one : crossings) normals.push_back(one.across);
  turn_to_one_side(along, normals);
  sense.family.assign(network.rods.size(), -1);
  sense.reversed.assign(network.rods.size(), 0);
  for (std::size_t first = 0; first < network.rods.size(); ++first) {
    if (sense.family[first] >= 0) continue;
    std::vector<std::size_t> piece{first};
    std::set<std::size_t> joints;
    sense.family[first] = 0;
    const auto opens = [&](std::size_t k) {  // side on which the angle between the families grows
      const int side = crossings[k].across.dot(normals[k]) < 0 ? -1 : 1;
      return sense.family[std::size_t(crossings[k].rods[0])] == 0 ? side : -side;
    };
    for (std::size_t k = 0; k < piece.size(); ++k)
      for (const std::size_t joint : along[piece[k]]) {
        joints.insert(joint);
        const auto& rods = crossings[joint].rods;
        const auto other = std::size_t(rods[rods[0] == int(piece[k]) ? 1 : 0]);
        if (sense.family[other] == sense.family[piece[k]]) return {};
        if (sense.family[other] >= 0) continue;
        sense.family[other] = 1 - sense.family[piece[k]];
        sense.reversed[other] = sense.reversed[piece[k]] != (opens(joint) < 0);
        piece.push_back(other);
      }
    const auto against =
        std::size_t(std::ranges::count_if(joints, [&](std::size_t k) { return opens(k) < 0; }));
    const int fewer = 2 * against > joints.size() ? 1 : -1;
    for (const std::size_t k : joints)
      if (opens(k) == fewer) sense.against.push_back(crossings[k].point);
  }
  return sense;
}

double mean_angle(const NetworkData& network) {
  const std::vector<RodCrossing> crossings = crossings_of(network);
  double sum = 0;
  for (const RodCrossing& one : crossings) sum += one.angle / double(crossings.size());
  return sum;
}

Result<std::vector<int>> NetworkBuilder::continued_by_direction() const {
  std::vector<int> partner(2 * network_.rods.size(), -1);
  for (std::size_t r = 0; r < network_.rods.size(); ++r)
    if (network_.rods[r].size() != 2)
      return invalid("{}: a line through {} points, expected 2: a linkage has a line per segment",
                     locations_[r], network_.rods[r].size());
  const SegmentEnds all = segment_ends(network_);
  for (const std::vector<SegmentEnd>& ends : all) {
    if (ends.size() > 4)
      return invalid("{}: {} segments meet at one point, expected at most 4 in a linkage",
                     locations_[std::size_t(ends.back().number / 2)], ends.size());
    const auto pairs = ends.size() == 4   ? opposite(ends)
                       : ends.size() == 3 ? straightest(all, ends)
                                          : std::vector<std::array<std::size_t, 2>>();
    for (const auto& [a, b] : pairs) {
      partner[std::size_t(ends[a].number)] = ends[b].number;
      partner[std::size_t(ends[b].number)] = ends[a].number;
    }
  }
  return partner;
}

/// Puts three joints on springs that only prevent rigid motions: the joint nearest to the middle in
/// all directions, the one farthest from it in two, the one farthest from the line through both in
/// one.
void NetworkBuilder::support_on_springs() {
  const std::vector<RodCrossing> joints = crossings_of(network_);
  if (joints.size() < 3) return;
  Eigen::Vector3d middle(0, 0, 0);
  for (const RodCrossing& one : joints)
    middle += position_of(network_, one.point) / double(joints.size());
  const auto farthest = [&](const auto& distance) {
    return std::ranges::max_element(
               joints, {},
               [&](const RodCrossing& one) { return distance(position_of(network_, one.point)); })
        ->point;
  };
  const int a = farthest([&](const Eigen::Vector3d& at) { return -(at - middle).norm(); });
  const Eigen::Vector3d from = position_of(network_, a);
  const int b = farthest([&](const Eigen::Vector3d& at) { return (at - from).norm(); });
  const Eigen::Vector3d axis = position_of(network_, b) - from;
  const int c = farthest([&](const Eigen::Vector3d& at) { return axis.cross(at - from).norm(); });
  if (a == b || b == c || a == c) return;
  const auto support = [&](int point, const Eigen::Vector3d& k) {
    add_support({double(point)});
    add_spring(point, {k.x(), k.y(), k.z()});
  };
  Eigen::Index along = 0, turned = 0;
  axis.cwiseAbs().maxCoeff(&along);
  axis.cross(position_of(network_, c) - from).cwiseAbs().maxCoeff(&turned);
  support(a, Eigen::Vector3d::Ones());
  support(b, Eigen::Vector3d::Ones() - Eigen::Vector3d::Unit(along));
  support(c, Eigen::Vector3d::Unit(turned));
}

Result<void> NetworkBuilder::join_segments(FileReport& report) {
  const std::size_t segments = network_.rods.size();
  TRY(partner, continued_by_direction());
  chain(*partner);
  OpeningSense sense = opening_sense(network_);
  const auto reverse = [&](const auto& whether) {
    for (std::size_t r = 0; r < network_.rods.size() && !sense.family.empty(); ++r)
      if (whether(r)) std::ranges::reverse(network_.rods[r]);
  };
  reverse([&](std::size_t r) { return sense.reversed[r] != 0; });
  sense = opening_sense(network_);
  // the angles of joints become acute on average
  if (mean_angle(network_) > 0.5 * M_PI)
    reverse([&](std::size_t r) { return sense.family[r] == 1; });
  support_on_springs();
  std::set<int> supported;
  for (const auto& row : network_.supports) supported.insert(int(row[0]));
  const std::vector<PointUse> uses = uses_of(points(), network_.rods);
  std::size_t crossed = 0, met = 0, alone = 0;
  for (std::size_t k = 0; k < points(); ++k) {
    const auto [passes, ends] = uses[k];
    crossed += passes > 1;
    met += ends > 0 && passes + ends > 1;
    alone += passes == 0 && ends == 1;
    if (passes == 0 && ends > 0 && !supported.contains(int(k))) add_free(int(k));
  }
  add_law({every_joint, 0, -1});
  report.text += fmt::format(
      "a linkage of {} segments: rods by direction cross at {} joints and end at {} more ({} free "
      "ends), hinges all of them; springs at three joints prevent rigid motions; the "
      "sections are those of [rod]; joints open from {:.4g} degrees on average; ",
      segments, crossed, met, alone, mean_angle(network_) * 180 / M_PI);
  if (sense.family.empty())
    report.notes.push_back("the rods are no two families that cross: joints do not open together");
  return {};
}

}  // namespace gridshell::preset
