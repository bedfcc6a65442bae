#include "engine/scene/rod_ends.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "engine/core/try.h"
#include "engine/scene/net_design.h"

namespace gridshell {
namespace {

bool is_begin(Eigen::Index end) { return end % 2 == 0; }

const FootprintRod& rod_of(const Scene& scene, Eigen::Index end) {
  return scene.footprint.rods[std::size_t(end / 2)];
}

RodEnd constraint_of(const Scene& scene, Eigen::Index end) {
  return is_begin(end) ? rod_of(scene, end).begin : rod_of(scene, end).end;
}

/// Position along its rod of the joint next to an end, mm.
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

constexpr double difference_step = 0.01;  // mm; far below any radius, far above round-off

Result<Eigen::Vector3d> tangent_at(const ChebyshevNet& net, Family family,
                                   const Eigen::Vector2d& uv) {
  TRY(point, net.at(uv.x(), uv.y()));
  return family == Family::u ? point->tangent_u : point->tangent_v;
}

/// Changes the ends of a scene. Legs of other lengths start from other edge points of the flat; far
/// ends of tails move with their edge points.
void apply_ends(const ShellEnds& ends, Scene& scene) {
  const ShellEnds before = ends_of(scene);
  if (scene.motion.end_far.size() > 0) scene.motion.end_far += ends.at - before.at;
  scene.motion.end = ends.at;
  for (Eigen::Index k = 0; k < ends.at.cols(); ++k) {
    if (fixes_direction(constraint_of(scene, k)))
      scene.motion.end_tangent.col(k) = ends.direction.col(k);
    if (ends.leg[k] != before.leg[k]) put_leg(ends.leg[k], k, scene);
  }
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
    if (fixes_direction(constraint_of(scene, k)))
      ends.direction.col(k) = scene.motion.end_tangent.col(k);
  }
  ends.diameter =
      Eigen::Map<const Eigen::VectorXd>(scene.diameters_mm.data(), scene.diameters_mm.size());
  return ends;
}

preset::Points table_of(const Scene& scene, const ShellEnds& ends) {
  preset::Points table;
  for (Eigen::Index k = 0; k < ends.at.cols(); ++k) {
    if (!is_fixed(constraint_of(scene, k))) continue;
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

Result<void> apply_ends_table(const preset::Points& table, Scene& scene) {
  using Name = std::tuple<int, int, int>;
  std::map<Name, std::vector<Eigen::Index>> named;
  for (Eigen::Index k = 0; k < scene.motion.end.cols(); ++k)
    if (is_fixed(constraint_of(scene, k)))
      named[{rod_of(scene, k).family == Family::u ? 0 : 1, rod_of(scene, k).index, int(k % 2)}]
          .push_back(k);
  ShellEnds ends = ends_of(scene);
  std::map<Name, std::size_t> seen;
  for (const auto& row : table) {
    const Name name{int(row[0]), int(row[1]), int(row[2])};
    const auto wrong = [&](const char* what) {
      return invalid("[ends] table: {} of {}-rod {}: {}", row[2] == 0 ? "begin" : "end",
                     row[0] == 0 ? "u" : "v", row[1], what);
    };
    const auto found = named.find(name);
    if (found == named.end() || double(int(row[1])) != row[1])
      return wrong("got no end of the footprint that is fixed");
    if (seen[name] == found->second.size())
      return wrong("got more rows than the footprint has of it");
    const Eigen::Index k = found->second[seen[name]++];
    if (!(row[6] > 0)) return wrong("got a leg without length, expected above 0 mm");
    ends.at.col(k) << row[3], row[4], row[5];
    ends.leg[k] = row[6];
    if (!fixes_direction(constraint_of(scene, k))) continue;
    const Eigen::Vector3d along(row[7], row[8], row[9]);
    if (!(along.norm() > 1e-6))
      return wrong("tx, ty, tz: got no direction, expected that of the prescribed end");
    ends.direction.col(k) = along.normalized();
  }
  apply_ends(ends, scene);
  return {};
}

Eigen::Vector3d far_end(const Eigen::Vector3d& end, const Eigen::Vector3d& outwards,
                        const Eigen::Vector3d& curvature, double length) {
  const double turned2 = curvature.squaredNorm() * length * length;
  return end + length * (1 - turned2 / 15) * outwards + length * length / 3 * curvature;
}

Result<Eigen::Vector3d> rod_curvature(const ChebyshevNet& net, Family family,
                                      const Eigen::Vector2d& uv, double inwards) {
  const double h = inwards * difference_step;
  const Eigen::Vector2d along = family == Family::u ? Eigen::Vector2d(h, 0) : Eigen::Vector2d(0, h);
  TRY(here, tangent_at(net, family, uv));
  TRY(in, tangent_at(net, family, uv + along));
  if (const auto out = tangent_at(net, family, uv - along)) return (*in - *out) / (2 * h);
  TRY(further, tangent_at(net, family, uv + 2 * along));
  return (4 * *in - 3 * *here - *further) / (2 * h);
}

Result<void> add_second_ring(double length_mm, Scene& scene) {
  const Eigen::Index ends = 2 * Eigen::Index(scene.footprint.rods.size());
  scene.motion.begin_far = scene.motion.end_far = Eigen::Matrix3Xd::Zero(3, ends);
  for (Eigen::Index k = 0; k < ends; ++k) {
    FootprintRod& rod = scene.footprint.rods[std::size_t(k / 2)];
    const bool first = k % 2 == 0;
    if (!is_fixed(first ? rod.begin : rod.end)) continue;
    (first ? rod.tail_begin : rod.tail_end) = length_mm;
    const double side = first ? -1 : 1, at = first ? rod.span.begin : rod.span.end;
    const Eigen::Vector2d uv = rod.at(at);
    TRY(tangent, tangent_at(*scene.net, rod.family, uv));
    TRY(curvature, rod_curvature(*scene.net, rod.family, uv, -side));
    scene.motion.begin_far.col(k) =
        scene.motion.begin.col(k) + side * length_mm * scene.flat.axes * rod.direction;
    scene.motion.end_far.col(k) =
        far_end(scene.motion.end.col(k), side * *tangent, *curvature, length_mm);
  }
  return {};
}

Eigen::Matrix2Xd within_boundary(const Footprint& footprint, const RodMesh& mesh) {
  Eigen::Matrix2Xd flat = mesh.flat.leftCols(mesh.rod_nodes());
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    const Eigen::Index along = rod.family == Family::u ? 0 : 1;
    const double first = mesh.flat(along, rod.joints.front()),
                 last = mesh.flat(along, rod.joints.back());
    for (const int node : mesh.rods[r]) {
      if (mesh.is_ghost(node)) continue;
      double& at = flat(along, node);
      at = std::clamp(at, rod.span.begin, rod.span.end);
      // a leg of another length covers the same piece of the net
      if (at < first) at += rod.longer_begin * (first - at) / (first - rod.span.begin);
      if (at > last) at -= rod.longer_end * (at - last) / (rod.span.end - last);
    }
  }
  return flat;
}

void set_tails(const Scene& scene, const RodMesh& mesh, Eigen::Matrix3Xd& positions) {
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const FootprintRod& rod = scene.footprint.rods[r];
    for (std::size_t k = 0; rod.has_tails() && k < mesh.rods[r].size(); ++k) {
      const double at = mesh.position[r][k];
      const bool before = at < rod.span.begin;
      if (!before && at <= rod.span.end) continue;
      const double fraction =
          before ? (rod.span.begin - at) / rod.tail_begin : (at - rod.span.end) / rod.tail_end;
      const Eigen::Index end = 2 * Eigen::Index(r) + (before ? 0 : 1);
      positions.col(mesh.rods[r][k]) =
          (1 - fraction) * scene.motion.end.col(end) + fraction * scene.motion.end_far.col(end);
    }
  }
}

Result<Eigen::Matrix3Xd> positions_on_net(const Scene& scene, const RodMesh& mesh) {
  auto positions = points_on(*scene.net, within_boundary(scene.footprint, mesh));
  if (positions) set_tails(scene, mesh, *positions);
  return positions;
}

}  // namespace gridshell
