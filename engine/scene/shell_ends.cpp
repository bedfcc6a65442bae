#include "engine/scene/shell_ends.h"

#include <fmt/format.h>

#include <map>
#include <tuple>

namespace gridshell {
namespace {

bool is_begin(Eigen::Index end) { return end % 2 == 0; }

const FootprintRod& rod_of(const Scene& scene, Eigen::Index end) {
  return scene.footprint.rods[std::size_t(end / 2)];
}

RodEnd hold_of(const Scene& scene, Eigen::Index end) {
  return is_begin(end) ? rod_of(scene, end).begin : rod_of(scene, end).end;
}

/// Where along its rod the joint next to an end is.
double next_joint(const Scene& scene, Eigen::Index end) {
  const FootprintRod& rod = rod_of(scene, end);
  return is_begin(end) ? rod.marks.front() : rod.marks.back();
}

/// A point on the line of a rod of the flat footprint.
Eigen::Vector3d flat_point(const Scene& scene, Eigen::Index end, double along) {
  return scene.flat.at(rod_of(scene, end).at(along));
}

void put_leg(double leg, Eigen::Index end, Scene& scene) {
  FootprintRod& rod = scene.footprint.rods[std::size_t(end / 2)];
  const double joint = next_joint(scene, end);
  double& at = is_begin(end) ? rod.span.begin : rod.span.end;
  const double before = at;
  at = is_begin(end) ? joint - leg : joint + leg;
  (is_begin(end) ? rod.longer_begin : rod.longer_end) += is_begin(end) ? before - at : at - before;
  const Eigen::Vector3d moved = flat_point(scene, end, at) - flat_point(scene, end, before);
  scene.motion.begin.col(end) += moved;
  if (scene.motion.begin_far.size() > 0) scene.motion.begin_far.col(end) += moved;
}

}  // namespace

ShellEnds ends_of(const Scene& scene) {
  ShellEnds ends;
  ends.at = scene.motion.end;
  ends.direction = Eigen::Matrix3Xd::Zero(3, ends.at.cols());
  ends.leg.resize(ends.at.cols());
  for (Eigen::Index k = 0; k < ends.at.cols(); ++k) {
    const Interval& span = rod_of(scene, k).span;
    const double joint = next_joint(scene, k);
    ends.leg[k] = is_begin(k) ? joint - span.begin : span.end - joint;
    if (holds_direction(hold_of(scene, k))) ends.direction.col(k) = scene.motion.end_tangent.col(k);
  }
  ends.diameter =
      Eigen::Map<const Eigen::VectorXd>(scene.diameters_mm.data(), scene.diameters_mm.size());
  return ends;
}

void put_ends(const ShellEnds& ends, Scene& scene) {
  const ShellEnds before = ends_of(scene);
  if (scene.motion.end_far.size() > 0) scene.motion.end_far += ends.at - before.at;
  scene.motion.end = ends.at;
  for (Eigen::Index k = 0; k < ends.at.cols(); ++k) {
    if (holds_direction(hold_of(scene, k))) scene.motion.end_tangent.col(k) = ends.direction.col(k);
    if (ends.leg[k] != before.leg[k]) put_leg(ends.leg[k], k, scene);
  }
}

preset::Points table_of(const Scene& scene, const ShellEnds& ends) {
  preset::Points table;
  for (Eigen::Index k = 0; k < ends.at.cols(); ++k) {
    if (!is_held(hold_of(scene, k))) continue;
    const FootprintRod& rod = rod_of(scene, k);
    const auto at = ends.at.col(k), along = ends.direction.col(k);
    table.push_back({rod.family == Family::u ? 0.0 : 1.0, double(rod.index), double(k % 2), at.x(),
                     at.y(), at.z(), ends.leg[k], along.x(), along.y(), along.z()});
  }
  return table;
}

preset::Points rod_table_of(const Scene& scene, const ShellEnds& ends) {
  preset::Points table;
  for (std::size_t r = 0; r < scene.footprint.rods.size(); ++r) {
    const FootprintRod& rod = scene.footprint.rods[r];
    table.push_back(
        {rod.family == Family::u ? 0.0 : 1.0, double(rod.index), ends.diameter[Eigen::Index(r)]});
  }
  return table;
}

Result<void> put_table(const preset::Points& table, Scene& scene) {
  using Name = std::tuple<int, int, int>;
  std::map<Name, std::vector<Eigen::Index>> named;
  for (Eigen::Index k = 0; k < scene.motion.end.cols(); ++k)
    if (is_held(hold_of(scene, k)))
      named[{rod_of(scene, k).family == Family::u ? 0 : 1, rod_of(scene, k).index, int(k % 2)}]
          .push_back(k);
  ShellEnds ends = ends_of(scene);
  std::map<Name, std::size_t> seen;
  for (const auto& row : table) {
    const Name name{int(row[0]), int(row[1]), int(row[2])};
    const auto wrong = [&](const char* what) {
      return fail(Fault::bad_input,
                  fmt::format("[ends] table: {} of {}-rod {}: {}", row[2] == 0 ? "begin" : "end",
                              row[0] == 0 ? "u" : "v", row[1], what));
    };
    const auto found = named.find(name);
    if (found == named.end() || double(int(row[1])) != row[1])
      return wrong("the footprint has no such end that is held");
    if (seen[name] == found->second.size()) return wrong("named more often than it is there");
    const Eigen::Index k = found->second[seen[name]++];
    if (!(row[6] > 0)) return wrong("the leg must be longer than 0 mm");
    ends.at.col(k) << row[3], row[4], row[5];
    ends.leg[k] = row[6];
    if (!holds_direction(hold_of(scene, k))) continue;
    const Eigen::Vector3d along(row[7], row[8], row[9]);
    if (!(along.norm() > 1e-6)) return wrong("tx, ty, tz must be a direction, as it is held");
    ends.direction.col(k) = along.normalized();
  }
  put_ends(ends, scene);
  return {};
}

}  // namespace gridshell
