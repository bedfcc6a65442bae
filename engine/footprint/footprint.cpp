#include "engine/footprint/footprint.h"

#include <algorithm>
#include <map>

namespace gridshell {
namespace {

// a crossing closer to the boundary than this, over d, is on it: it is no joint, both rods end
// there
constexpr double on_boundary = 1e-6;
constexpr double most_joints = 1e6;

/// Computes the joints of a square grid, and the joints and marks of its rods, from the rods' lines
/// and spans.
void cross(Footprint& net) {
  // the v-rods of each line: a boundary that is not convex may cut a line into several rods
  std::map<int, std::vector<int>> v_rods;
  for (int r = 0; r < int(net.rods.size()); ++r)
    if (net.rods[r].family == Family::v) v_rods[net.rods[r].index].push_back(r);

  const double margin = on_boundary * net.spacing;
  const auto contains = [margin](const Interval& span, double position) {
    return position > span.begin + margin && position < span.end - margin;
  };
  for (FootprintRod& row : net.rods) {
    if (row.family != Family::u) continue;
    for (const auto& [i, candidates] : v_rods) {
      for (int r : candidates) {
        FootprintRod& column = net.rods[r];
        if (!contains(row.span, column.line()) || !contains(column.span, row.line())) continue;
        const int joint = int(net.joints.size());
        net.joints.push_back({i, row.index, column.line(), row.line()});
        row.joints.push_back(joint);
        column.joints.push_back(joint);
      }
    }
  }
  for (FootprintRod& rod : net.rods) {
    const auto along = [&](int joint) {
      return rod.family == Family::u ? net.joints[joint].u : net.joints[joint].v;
    };
    std::ranges::sort(rod.joints, [&](int a, int b) { return along(a) < along(b); });
    for (const int joint : rod.joints) rod.marks.push_back(along(joint));
  }
}

bool crosses_none(const FootprintRod& rod) { return rod.joints.empty(); }

void add_rods(Footprint& net, const Domain& domain, Family family, int index) {
  const double line = line_of(net.placement, index, net.spacing);
  for (const Interval& span : domain.intervals(family, line))
    if (span.end - span.begin > 2 * on_boundary * net.spacing)
      net.rods.push_back(FootprintRod::of_grid(family, index, line, span));
}

/// The smallest or largest of `start` and all legs; `pick` returns the smaller or larger of two.
template <class Pick>
double leg(const Footprint& net, double start, Pick pick) {
  double found = start;
  for (const FootprintRod& rod : net.rods) {
    if (rod.begin != RodEnd::joined) found = pick(found, rod.marks.front() - rod.span.begin);
    if (rod.end != RodEnd::joined) found = pick(found, rod.span.end - rod.marks.back());
  }
  return found;
}

/// Index of the piece of a polyline that contains a position.
std::size_t piece_at(const std::vector<Eigen::Vector4d>& path, double position) {
  const auto after =
      std::upper_bound(path.begin() + 1, path.end() - 1, position,
                       [](double at, const auto& corner) { return at < corner.w(); });
  return std::size_t(after - path.begin()) - 1;
}

}  // namespace

std::vector<Interval> Disk::intervals(Family, double c) const {
  if (std::abs(c) >= radius_) return {};
  const double half = std::sqrt((radius_ - c) * (radius_ + c));
  return {{-half, half}};
}

Eigen::Matrix2Xd Disk::boundary(int points) const {
  return ring_about_origin(points, [this](const Eigen::Vector2d&) { return radius_; });
}

FootprintRod FootprintRod::of_grid(Family family, int index, double line, const Interval& span) {
  FootprintRod rod;
  rod.family = family;
  rod.index = index;
  rod.origin = family == Family::u ? Eigen::Vector2d(0, line) : Eigen::Vector2d(line, 0);
  rod.direction = family == Family::u ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
  rod.span = span;
  return rod;
}

Eigen::Vector2d FootprintRod::at(double position) const {
  if (path.empty()) return origin + position * direction;
  return on_path(position).head<2>();
}

double FootprintRod::height(double position) const {
  return path.empty() ? 0 : on_path(position).z();
}

Eigen::Vector3d FootprintRod::on_path(double position) const {
  const std::size_t piece = piece_at(path, position);
  const Eigen::Vector4d& corner = path[piece];
  const Eigen::Vector3d direction = (path[piece + 1] - corner).head<3>().normalized();
  return corner.head<3>() + (position - corner.w()) * direction;
}

Eigen::Vector2d FootprintRod::tangent(double position) const {
  return tangent_in_space(position).head<2>().normalized();
}

Eigen::Vector3d FootprintRod::tangent_in_space(double position) const {
  if (path.empty()) return {direction.x(), direction.y(), 0};
  const std::size_t piece = piece_at(path, position);
  return (path[piece + 1] - path[piece]).head<3>().normalized();
}

void find_cells(Footprint& net) {
  std::map<std::pair<int, int>, int> joint_at;
  for (int k = 0; k < int(net.joints.size()); ++k) joint_at[{net.joints[k].i, net.joints[k].j}] = k;

  // a cell is complete when its four joints exist and neighbours share a rod
  std::map<std::pair<int, int>, bool> linked;
  for (const FootprintRod& rod : net.rods)
    for (std::size_t k = 1; k < rod.joints.size(); ++k)
      linked[{rod.joints[k - 1], rod.joints[k]}] = true;
  for (int joint = 0; joint < int(net.joints.size()); ++joint) {
    const int i = net.joints[joint].i, j = net.joints[joint].j;
    const auto next_u = joint_at.find({i + 1, j}), opposite = joint_at.find({i + 1, j + 1}),
               next_v = joint_at.find({i, j + 1}), none = joint_at.end();
    if (next_u == none || opposite == none || next_v == none) continue;
    if (linked.contains({joint, next_u->second}) &&
        linked.contains({next_v->second, opposite->second}) &&
        linked.contains({joint, next_v->second}) &&
        linked.contains({next_u->second, opposite->second}))
      net.cells.push_back({i, j, {joint, next_u->second, opposite->second, next_v->second}});
  }
}

bool Footprint::in_space() const {
  return std::ranges::any_of(joints,
                             [](const FootprintJoint& joint) { return joint.height != 0; }) ||
         std::ranges::any_of(rods, [](const FootprintRod& rod) {
           return std::ranges::any_of(rod.path, [](const auto& corner) { return corner.z() != 0; });
         });
}

bool Footprint::is_sprung(int joint) const {
  return std::ranges::find(springs, joint, &SupportSpring::joint) != springs.end();
}

double Footprint::shortest_leg() const {
  return leg(*this, std::numeric_limits<double>::infinity(),
             [](double a, double b) { return std::min(a, b); });
}

double Footprint::longest_leg() const {
  return leg(*this, 0.0, [](double a, double b) { return std::max(a, b); });
}

double line_of(Placement placement, int index, double spacing) {
  return placement == Placement::half ? (index + 0.5) * spacing : index * spacing;
}

Result<Footprint> cut_footprint(const Domain& domain, double spacing, Placement placement) {
  const double lines = domain.reach() / spacing;
  if (!(spacing > 0) || !(lines * lines * 4 < most_joints))
    return invalid(
        "a spacing of {:g} mm in a boundary that reaches {:g} mm gives more than {:g} "
        "joints or none",
        spacing, domain.reach(), most_joints);
  Footprint net{spacing, placement, {}, {}, {}};
  const int last = int(std::ceil(lines)) + 1;
  for (Family family : {Family::u, Family::v})
    for (int index = -last; index <= last; ++index) add_rods(net, domain, family, index);
  if (net.rods.empty())
    return invalid(
        "no grid line of spacing {:g} mm meets the boundary, which reaches {:.3g} mm from its "
        "middle; of a drawing in metres [footprint] file_unit = \"m\" is needed",
        spacing, domain.reach());
  cross(net);
  net.lone_lines = int(std::erase_if(net.rods, crosses_none));
  if (net.rods.empty())
    return invalid(
        "got no two rods that cross within the boundary, expected a boundary larger than {:g} mm, "
        "or the spacing smaller",
        spacing);
  find_cells(net);
  return net;
}

// longest leg, over d, that is left with the radius that the error message proposes
constexpr double short_leg = 1e-3;

Result<Footprint> circular_footprint(double radius, int rods, double spacing, Placement placement) {
  if (rods < 2) return invalid("rods: got {} per direction, expected at least 2", rods);
  if (rods > 1000) return invalid("rods: got {} per direction, expected at most 1000", rods);
  const bool even = rods % 2 == 0;
  if (even != (placement == Placement::half))
    return invalid(
        "{} rods per direction do not fit placement \"{}\": rods at (i + 1/2) d (\"half\") "
        "are an even number, rods at i d (\"on_axis\") an odd one",
        rods, placement == Placement::half ? "half" : "on_axis");
  // the outermost rod crosses the one nearest to the middle inside the boundary
  const double middle = even ? 0.5 : 0, least = std::hypot(0.5 * (rods - 1), middle),
               size = radius / spacing;
  if (!(size - least > on_boundary)) {
    const double most = std::sqrt(std::max(std::pow(size - short_leg, 2) - middle * middle, 0.0));
    const int fitting = size > short_leg ? 2 * int(most + middle) + (even ? 0 : 1) : 0;
    return invalid(
        "{} rods per direction at d = {:g} mm do not fit the boundary: the outermost crossing lies "
        "at {:.7g} mm; take R_o >= {:.7g} mm{}",
        rods, spacing, least * spacing, std::ceil(1e4 * (least + short_leg) * spacing) / 1e4,
        fitting > 1 ? fmt::format(" or n <= {}", fitting) : "");
  }
  Footprint net{spacing, placement, {}, {}, {}};
  const int first = even ? -rods / 2 : -(rods - 1) / 2;
  const Disk disk(radius);
  for (Family family : {Family::u, Family::v})
    for (int k = 0; k < rods; ++k) add_rods(net, disk, family, first + k);
  cross(net);
  const auto alone = std::ranges::find_if(net.rods, crosses_none);
  if (alone != net.rods.end())
    return invalid(
        "the {}-rod at {} = {:g} mm crosses no other rod: it would be fixed only at its two "
        "ends; move the boundary or the spacing",
        name_of(alone->family), alone->family == Family::u ? "v" : "u", alone->line());
  find_cells(net);
  return net;
}

}  // namespace gridshell
