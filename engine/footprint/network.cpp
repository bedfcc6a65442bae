#include "engine/footprint/network.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <tuple>
#include <utility>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/try.h"

namespace gridshell {
namespace {

// largest distance of a straight rod's points from its chord, over the chord
constexpr double straight = 1e-9;
// largest distance from a line at which points count as on it, over their extent
constexpr double on_a_line = 1e-6;

/// The area that two vectors span.
double area(const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.cross(b).norm(); }

bool is_ring(const std::vector<int>& rod) { return rod.front() == rod.back(); }

bool is_straight(const Eigen::Matrix3Xd& points, const std::vector<int>& rod) {
  if (is_ring(rod)) return false;
  const Eigen::Vector3d first = points.col(rod.front()), chord = points.col(rod.back()) - first;
  double reached = -1;
  return std::ranges::all_of(rod, [&](int point) {
    const Eigen::Vector3d offset = points.col(point) - first;
    const bool advances = offset.dot(chord) > std::exchange(reached, offset.dot(chord));
    return (advances || point == rod.front()) &&
           area(chord, offset) < straight * chord.squaredNorm();
  });
}

Result<void> check_rod(const RodNetwork& network, std::size_t r,
                       std::map<std::pair<int, int>, std::size_t>& stretches) {
  const std::vector<int>& rod = network.rods[r];
  const auto wrong = [&](const std::string& what) { return invalid("rods[{}]: {}", r, what); };
  const std::set<int> points(rod.begin(), rod.end());
  if (points.size() < 2) return wrong("got one point, expected at least two, at a distance");
  if (is_ring(rod) && points.size() < 3)
    return wrong("a ring: got two points, expected at least three");
  for (std::size_t k = 1; k < rod.size(); ++k) {
    const auto ends = std::minmax(rod[k - 1], rod[k]);
    if (ends.first == ends.second)
      return wrong(fmt::format("got point {} twice in turn, expected another point", rod[k]));
    if (const auto [other, is_new] = stretches.try_emplace(ends, r); !is_new)
      return wrong(fmt::format("got a rod from point {} to {}, as rods[{}] is, expected one rod",
                               ends.first, ends.second, other->second));
  }
  if (points.size() + (is_ring(rod) ? 1 : 0) < rod.size())
    return wrong(
        "got a rod that passes a point twice, expected several rods, or a ring that ends where it "
        "begins");
  return {};
}

/// The role of each point of a network: joint, support, end.
class Roles {
 public:
  explicit Roles(const RodNetwork& network)
      : network_(network), uses_(uses_of(std::size_t(network.points.cols()), network.rods)) {
    for (const std::vector<int>& rod : network.rods) {
      // a single rod has all its inner points as joints
      if (network.rods.size() > 1 && is_straight(network.points, rod)) continue;
      corners_.insert(rod.begin() + 1, rod.end() - 1);
      if (is_ring(rod)) corners_.insert(rod.front());
    }
  }

  bool is_joint(int point) const {
    const auto [passes, ends] = uses_[point];
    if (passes == 0)
      return ends > 1 &&
             (network_.free[point] != 0 || is_sprung(point) || network_.joined.contains(point));
    return passes + ends > 1 || is_supported(point) || corners_.contains(point);
  }
  bool is_supported(int point) const { return network_.supported[point] != 0; }
  bool is_sprung(int point) const { return network_.springs.contains(point); }
  RodEnd end_at(int point) const {
    if (is_joint(point)) return RodEnd::joined;
    if (is_sprung(point)) return RodEnd::sprung;
    return network_.free[point] != 0 ? RodEnd::free : RodEnd::pinned;
  }
  /// Whether the boundary fixes the joint, or the rod ends, at this point.
  bool is_fixed(int point) const {
    return is_joint(point) ? is_supported(point) : gridshell::is_fixed(end_at(point));
  }
  const PointUse& at(int point) const { return uses_[point]; }

 private:
  const RodNetwork& network_;
  std::vector<PointUse> uses_;
  std::set<int> corners_;  // inner points of rods that are not straight
};

Result<void> check_points(const RodNetwork& network, const Roles& roles) {
  for (int point = 0; point < int(network.points.cols()); ++point) {
    const auto [passes, ends] = roles.at(point);
    const bool free = network.free[point] != 0;
    if ((free || roles.is_supported(point)) && passes + ends == 0)
      return invalid("point {} is {}, and no rod has it", point, free ? "free" : "a support");
    if (free && passes > 0)
      return invalid("point {} is free, and inside a rod: only ends of rods can be free", point);
    if (free && roles.is_supported(point)) return invalid("point {} is a support and free", point);
  }
  return {};
}

/// Sets the path of a rod, or its origin and direction if it is straight and in the plane.
void lay(const Eigen::Matrix3Xd& points, const std::vector<int>& numbers, FootprintRod& rod) {
  rod.origin = points.col(numbers.front()).head<2>();
  const bool in_plane = points(2, numbers).isZero(0);
  if (in_plane && is_straight(points, numbers)) {
    rod.direction = (points.col(numbers.back()).head<2>() - rod.origin).normalized();
    return;
  }
  double position = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    const Eigen::Vector3d at = points.col(numbers[k]);
    if (k > 0) position += (at - rod.path.back().head<3>()).norm();
    rod.path.emplace_back(at.x(), at.y(), at.z(), position);
  }
}

/// The constraint of an end; rod r starts at 2 r and ends at 2 r + 1.
Result<RodEnd> constraint_of(const RodNetwork& network, const Roles& roles, int end) {
  const std::vector<int>& rod = network.rods[std::size_t(end / 2)];
  const RodEnd kind = roles.end_at(end % 2 == 0 ? rod.front() : rod.back());
  const auto own = network.end_constraints.find(end);
  if (own == network.end_constraints.end())
    return kind == RodEnd::pinned ? network.end_constraint : kind;
  if (kind == RodEnd::pinned) return own->second;
  return invalid("rods[{}]: its {} {}, a constraint is given only of an end at a support", end / 2,
                 end % 2 == 0 ? "begin" : "end",
                 kind == RodEnd::joined   ? "is joined there"
                 : kind == RodEnd::sprung ? "is on a spring"
                                          : "is free");
}

Result<FootprintRod> rod_of(const RodNetwork& network, std::size_t r, const Roles& roles,
                            const std::map<int, int>& joint_at) {
  const std::vector<int>& numbers = network.rods[r];
  FootprintRod rod;
  rod.family = Family::other;
  rod.index = rod.number = int(r);
  lay(network.points, numbers, rod);
  double position = 0;
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (k > 0)
      position += (network.points.col(numbers[k]) - network.points.col(numbers[k - 1])).norm();
    const auto joint = joint_at.find(numbers[k]);
    if (joint == joint_at.end()) continue;
    rod.joints.push_back(joint->second);
    rod.marks.push_back(position);
  }
  rod.span = {0, position};
  if (rod.joints.empty()) {
    const auto shared_end =
        std::ranges::find_if(numbers, [&](int point) { return roles.at(point).ends > 1; });
    if (shared_end != numbers.end())
      return invalid(
          "rods[{}]: is joined to no other rod: where rods only end, as at point {}, each is fixed "
          "by itself; {{\"point\": {}, \"to_mm\": \"free\"}} among the supports joins them by a "
          "hinge, a law among the joints as it says",
          r, *shared_end, *shared_end);
    return invalid(
        "rods[{}]: got a rod without a joint, expected a point shared with another rod, or one rod "
        "alone with points inside",
        r);
  }
  TRY(begin, constraint_of(network, roles, int(2 * r)));
  TRY(end, constraint_of(network, roles, int(2 * r) + 1));
  rod.begin = *begin;
  rod.end = *end;
  return rod;
}

/// A support of a piece: a position, and the directions in which it is fixed.
struct FixedPoint {
  Eigen::Vector3d at;
  Eigen::Vector3d along;  ///< for x, y and z: 1 if it is fixed in that direction, else 0
};

/// The directions in which a support fixes its point: all, or those in which its spring has a
/// stiffness.
Eigen::Vector3d fixed_along(const RodNetwork& network, int point) {
  const auto spring = network.springs.find(point);
  if (spring == network.springs.end()) return Eigen::Vector3d::Ones();
  return (spring->second.array() > 0).cast<double>();
}

/// Whether the supports are not all on one line.
bool off_a_line(const std::vector<FixedPoint>& supports) {
  if (supports.empty()) return false;
  const Eigen::Vector3d first = supports.front().at;
  Eigen::Vector3d far = first;
  for (const FixedPoint& support : supports)
    if ((support.at - first).norm() > (far - first).norm()) far = support.at;
  const Eigen::Vector3d chord = far - first;
  return std::ranges::any_of(supports, [&](const FixedPoint& support) {
    return area(chord, support.at - first) > on_a_line * chord.squaredNorm();
  });
}

/// Whether supports fix a piece against every small displacement and rotation: the six columns of
/// (e, p x e/L) over all positions p and fixed directions e are independent.
bool is_fixed_by(const std::vector<FixedPoint>& supports) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (const FixedPoint& support : supports) middle += support.at / double(supports.size());
  double reach = 0;
  for (const FixedPoint& support : supports) reach = std::max(reach, (support.at - middle).norm());
  Eigen::MatrixXd motions = Eigen::MatrixXd::Zero(3 * Eigen::Index(supports.size()), 6);
  for (std::size_t k = 0; k < supports.size(); ++k) {
    const Eigen::Vector3d arm = (supports[k].at - middle) / reach;
    for (int axis = 0; axis < 3; ++axis) {
      const Eigen::Vector3d direction = supports[k].along[axis] * Eigen::Vector3d::Unit(axis);
      motions.row(3 * Eigen::Index(k) + axis) << direction.transpose(),
          arm.cross(direction).transpose();
    }
  }
  return rank_of(motions, on_a_line) == 6;
}

/// Adds the directions that a rod's ends prescribe, as fixed positions: a second one along the rod
/// and, if the twist angle is prescribed too, a third one at its side.
void add_directions(const RodNetwork& network, std::size_t r, const FootprintRod& rod,
                    std::vector<FixedPoint>& supports) {
  const std::vector<int>& points = network.rods[r];
  const std::size_t last = points.size() - 1;
  const std::tuple<RodEnd, int, int> ends[] = {{rod.begin, points[0], points[1]},
                                               {rod.end, points[last], points[last - 1]}};
  for (const auto& [kind, from, to] : ends) {
    if (!fixes_direction(kind)) continue;
    const Eigen::Vector3d at = network.points.col(from), chord = network.points.col(to) - at;
    supports.push_back({at + chord, Eigen::Vector3d::Ones()});
    if (kind == RodEnd::clamped)
      supports.push_back({at + chord.norm() * chord.unitOrthogonal(), Eigen::Vector3d::Ones()});
  }
}

/// Whether a piece is fixed in all directions at two points at least. A single rod may then turn
/// about the line through them, which does not change its shape.
bool fixed_twice(const std::vector<FixedPoint>& supports) {
  const auto fixes = [](const FixedPoint& support) {
    return support.along == Eigen::Vector3d::Ones();
  };
  return std::ranges::all_of(supports, fixes) &&
         std::ranges::any_of(supports,
                             [&](const auto& other) { return other.at != supports[0].at; });
}

/// Checks that every connected piece has supports against translation and rotation.
Result<void> check_supports(const RodNetwork& network, const Roles& roles,
                            const Footprint& footprint) {
  UnionFind pieces(footprint.joints.size());
  for (const FootprintRod& rod : footprint.rods)
    for (const int joint : rod.joints) pieces.join(joint, rod.joints.front());
  std::map<int, std::vector<FixedPoint>> supports;
  std::map<int, std::size_t> first_rod, rods_of;
  for (std::size_t r = 0; r < footprint.rods.size(); ++r) {
    const int piece = pieces.find(footprint.rods[r].joints.front());
    first_rod.try_emplace(piece, r);
    ++rods_of[piece];
    for (const int point : network.rods[r])
      if (roles.is_fixed(point) && (roles.is_joint(point) || roles.at(point).ends > 0))
        supports[piece].push_back({network.points.col(point), fixed_along(network, point)});
    add_directions(network, r, footprint.rods[r], supports[piece]);
  }
  for (const auto& [piece, rod] : first_rod) {
    if (rods_of[piece] == 1 && fixed_twice(supports[piece])) continue;
    if (!off_a_line(supports[piece]))
      return invalid(
          "rods[{}] and what is joined to it: fixed at fewer than three points, or at points on "
          "one line, and would turn freely about it; add a support off that line, or draw it with "
          "a little sag and a weak spring across it at one of its points: "
          "{{\"point\": {}, \"spring_N_per_mm\": [0, 0.001, 0]}} among the supports",
          rod, network.rods[rod][network.rods[rod].size() / 2]);
    if (!is_fixed_by(supports[piece]))
      return invalid(
          "rods[{}] and what is joined to it: supported by springs along too few directions, and "
          "would move or turn freely",
          rod);
  }
  return {};
}

/// The median length between neighbouring joints or, if no rod has two joints, of half the rods.
double spacing_of(const Footprint& footprint) {
  std::vector<double> segments;
  for (const FootprintRod& rod : footprint.rods)
    for (std::size_t k = 1; k < rod.marks.size(); ++k)
      segments.push_back(rod.marks[k] - rod.marks[k - 1]);
  if (segments.empty())
    for (const FootprintRod& rod : footprint.rods) segments.push_back(rod.span.end / 2);
  const auto middle = segments.begin() + std::ptrdiff_t(segments.size() / 2);
  std::nth_element(segments.begin(), middle, segments.end());
  return *middle;
}

/// Fills the footprint's springs, at its ends and fixed joints, from those of the network's points.
void put_springs(const RodNetwork& network, NetworkFootprint& made) {
  Footprint& footprint = made.footprint;
  for (std::size_t end = 0; end < made.ends.size(); ++end) {
    const FootprintRod& rod = footprint.rods[end / 2];
    if ((end % 2 == 0 ? rod.begin : rod.end) == RodEnd::sprung)
      footprint.springs.push_back({int(end), -1, network.springs.at(made.ends[end])});
  }
  for (std::size_t k = 0; k < made.joints.size(); ++k)
    if (const auto spring = network.springs.find(made.joints[k]); spring != network.springs.end())
      footprint.springs.push_back({-1, footprint.fixed_joints[k], spring->second});
}

}  // namespace

Result<NetworkFootprint> network_footprint(const RodNetwork& network) {
  std::map<std::pair<int, int>, std::size_t> stretches;
  for (std::size_t r = 0; r < network.rods.size(); ++r) TRY_DO(check_rod(network, r, stretches));
  const Roles roles(network);
  TRY_DO(check_points(network, roles));

  NetworkFootprint made;
  Footprint& footprint = made.footprint;
  std::map<int, int> joint_at;
  for (int point = 0; point < int(network.points.cols()); ++point) {
    if (!roles.is_joint(point)) continue;
    joint_at[point] = int(footprint.joints.size());
    if (roles.is_supported(point)) {
      footprint.fixed_joints.push_back(joint_at[point]);
      made.joints.push_back(point);
    }
    const Eigen::Vector3d at = network.points.col(point);
    footprint.joints.push_back({point, 0, at.x(), at.y(), at.z()});
  }
  for (std::size_t r = 0; r < network.rods.size(); ++r) {
    TRY(rod, rod_of(network, r, roles, joint_at));
    footprint.rods.push_back(std::move(*rod));
    made.ends.insert(made.ends.end(), {network.rods[r].front(), network.rods[r].back()});
  }
  TRY_DO(check_supports(network, roles, footprint));
  footprint.spacing = spacing_of(footprint);
  for (const Placement placement : {Placement::half, Placement::on_axis})
    if (footprint.cells.empty() && !footprint.in_space()) name_as_grid(made, placement);
  put_springs(network, made);
  footprint.end_points = made.ends;
  return made;
}

}  // namespace gridshell
