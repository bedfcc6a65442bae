#include "engine/scene/scene.h"

#include <cmath>
#include <utility>

#include "engine/preset/rung.h"
#include "engine/scene/block_design.h"
#include "engine/scene/curve_design.h"
#include "engine/scene/net_design.h"
#include "engine/scene/network_design.h"
#include "engine/scene/scene_rods.h"
#include "engine/scene/second_ring.h"
#include "engine/scene/shell_ends.h"

namespace gridshell {
namespace {

constexpr int boundary_points = 256;

/// (u, v) of the edge points: begin and end of rod r at columns 2r and 2r + 1.
Eigen::Matrix2Xd edge_points(const Footprint& footprint) {
  Eigen::Matrix2Xd points(2, 2 * footprint.rods.size());
  for (Eigen::Index r = 0; r < Eigen::Index(footprint.rods.size()); ++r) {
    const FootprintRod& rod = footprint.rods[r];
    points.col(2 * r) = rod.at(rod.span.begin);
    points.col(2 * r + 1) = rod.at(rod.span.end);
  }
  return points;
}

Result<void> build_circle(const preset::Preset& preset, Scene& scene) {
  auto footprint = circular_footprint(preset.original_radius_mm(), preset.footprint.rods,
                                      preset.footprint.spacing_mm,
                                      same_word<Placement>(preset.footprint.placement));
  if (!footprint) return tl::unexpected<Error>(footprint.error());
  scene.footprint = std::move(*footprint);
  scene.radius_begin_mm = scene.length_scale_mm = preset.original_radius_mm();
  scene.radius_end_mm = preset.actuated_radius_mm();
  const double ratio = scene.radius_end_mm / scene.radius_begin_mm;
  scene.original_boundary = scene.flat.all(Disk(scene.radius_begin_mm).boundary(boundary_points));
  scene.actuated_boundary = ratio * scene.original_boundary;
  scene.motion.begin = scene.flat.all(edge_points(scene.footprint));
  scene.motion.end = ratio * scene.motion.begin;
  return {};
}

Result<void> cut_from(const Domain& domain, const preset::Preset& preset, Scene& scene) {
  auto footprint = cut_footprint(domain, preset.footprint.spacing_mm,
                                 same_word<Placement>(preset.footprint.placement));
  if (!footprint) return tl::unexpected<Error>(footprint.error());
  scene.footprint = std::move(*footprint);
  return {};
}

Result<void> build_curve(const preset::Preset& preset, Scene& scene) {
  auto design = curve_design(preset);
  if (!design) return tl::unexpected<Error>(design.error());
  if (auto cut = cut_from(*design->domain, preset, scene); !cut) return cut;
  scene.length_scale_mm = design->scale_mm;
  const Eigen::Matrix2Xd ring = design->domain->boundary(boundary_points);
  const Eigen::Matrix2Xd ends = edge_points(scene.footprint);
  scene.original_boundary = scene.flat.all(ring);
  scene.actuated_boundary = scene.flat.all(design->actuated(ring));
  scene.motion.begin = scene.flat.all(ends);
  scene.motion.end = scene.flat.all(design->actuated(ends));
  return {};
}

/// Lets go of the ends on the end rings of a surface of revolution, but for those on its long
/// edges.
void free_rings(Scene& scene) {
  const double ring = scene.actuated_boundary.row(0).cwiseAbs().maxCoeff();
  const double near = 1e-9 * scene.length_scale_mm;
  for (std::size_t r = 0; r < scene.footprint.rods.size(); ++r) {
    const auto on_ring = [&](Eigen::Index end) {
      const Eigen::Vector3d at = scene.motion.end.col(end);
      return std::abs(at.x()) > ring - near && at.z() > near;
    };
    FootprintRod& rod = scene.footprint.rods[r];
    if (on_ring(2 * Eigen::Index(r))) rod.begin = RodEnd::free;
    if (on_ring(2 * Eigen::Index(r) + 1)) rod.end = RodEnd::free;
  }
}

/// Holds the directions of all ends that are held at all, and with `clamped` their spin: from the
/// flat to the net's tangents, or where there is no net as they are in the flat.
Result<void> hold_directions(const Eigen::Matrix2Xd& ends, RodEnd hold, Scene& scene) {
  scene.motion.begin_tangent = scene.motion.end_tangent = Eigen::Matrix3Xd::Zero(3, ends.cols());
  for (Eigen::Index k = 0; k < ends.cols(); ++k) {
    FootprintRod& rod = scene.footprint.rods[std::size_t(k / 2)];
    RodEnd& held = k % 2 == 0 ? rod.begin : rod.end;
    // a spring holds no direction
    if (!is_held(held) || held == RodEnd::sprung) continue;
    held = hold;
    scene.motion.begin_tangent.col(k) =
        scene.flat.axes * rod.tangent(k % 2 == 0 ? rod.span.begin : rod.span.end);
    scene.motion.end_tangent.col(k) = scene.motion.begin_tangent.col(k);
    if (!scene.net) continue;
    const auto point = scene.net->at(ends(0, k), ends(1, k));
    if (!point) return tl::unexpected<Error>(point.error());
    scene.motion.end_tangent.col(k) = rod.family == Family::u ? point->tangent_u : point->tangent_v;
  }
  return {};
}

Result<void> build_net(const preset::Preset& preset, Scene& scene) {
  auto design = preset.footprint.kind == preset::FootprintKind::blocks
                    ? block_design(preset)
                    : net_design(preset.net, preset.footprint.spacing_mm);
  if (!design) return tl::unexpected<Error>(design.error());
  if (auto cut = cut_from(*design->domain, preset, scene); !cut) return cut;
  scene.net = design->net;
  scene.blocks = design->blocks;
  scene.flat = design->flat;
  scene.from_net = preset.actuation.start == preset::Start::net;
  scene.length_scale_mm = design->scale_mm;
  const Eigen::Matrix2Xd ring = design->domain->boundary(boundary_points);
  const Eigen::Matrix2Xd ends = edge_points(scene.footprint);
  // C maps the original boundary to the actuated one, the edge points too
  const auto actuated = points_on(*scene.net, ring), held = points_on(*scene.net, ends);
  for (const auto* sampled : {&actuated, &held})
    if (!*sampled) return tl::unexpected<Error>(sampled->error());
  scene.original_boundary = scene.flat.all(ring);
  scene.actuated_boundary = *actuated;
  scene.motion.begin = scene.flat.all(ends);
  scene.motion.end = *held;
  if (preset.ends.rings == preset::Rings::free) free_rings(scene);
  return {};
}

/// Footprint, boundary and motion, as the kind has them.
Result<void> build(const preset::Preset& preset, Scene& scene) {
  switch (preset.footprint.kind) {
    case preset::FootprintKind::circle:
      return build_circle(preset, scene);
    case preset::FootprintKind::curve:
      return build_curve(preset, scene);
    case preset::FootprintKind::network:
      return build_network(preset, scene);
    case preset::FootprintKind::net:
    case preset::FootprintKind::blocks:
      break;
  }
  return build_net(preset, scene);
}

/// What rods have at rest besides their length is known in the plane alone.
Result<void> check_in_space(const preset::Preset& preset, const Scene& scene) {
  if (!scene.drawn_in_space) return {};
  const std::string reason = "of a network that is drawn in space, ";
  if (scene.rung == preset::Rung::twist)
    return fail(Fault::bad_input, reason +
                                      "how rods spin and meet at rest is not known: the bend "
                                      "rung alone takes it; " +
                                      preset::model_reason(preset));
  if (preset.ends.kind != preset::EndKind::pinned)
    return fail(Fault::bad_input,
                "[ends] kind: " + reason + "ends are pinned: where they point is not known");
  return {};
}

}  // namespace

Result<Scene> scene_of(const preset::Preset& preset) {
  Scene scene;
  if (const auto built = build(preset, scene); !built) return tl::unexpected<Error>(built.error());
  if (preset.ends.kind != preset::EndKind::pinned) {
    const bool clamped = preset.ends.kind == preset::EndKind::clamped;
    const auto held = hold_directions(edge_points(scene.footprint),
                                      clamped ? RodEnd::clamped : RodEnd::tangent, scene);
    if (!held) return tl::unexpected<Error>(held.error());
  }
  if (preset.ends.second_ring_mm > 0)
    if (const auto added = add_second_ring(preset.ends.second_ring_mm, scene); !added)
      return tl::unexpected<Error>(added.error());
  if (const auto put = put_table(preset.ends.table, scene); !put)
    return tl::unexpected<Error>(put.error());
  auto rods = scene_rods(preset, scene.footprint);
  if (!rods) return tl::unexpected<Error>(rods.error());
  scene.rods = std::move(rods->shell);
  scene.mass_t_per_mm = std::move(rods->mass_t_per_mm);
  scene.rod_diameter_mm = rods->drawn_diameter_mm;
  scene.drawn_diameters_mm = rods->drawn_diameters_mm;
  scene.diameters_mm = std::move(rods->diameters_mm);
  scene.rung = preset::rung_of(preset);
  if (auto fits = check_in_space(preset, scene); !fits) return tl::unexpected<Error>(fits.error());
  scene.seed.up = preset.actuation.seed == preset::Seed::up ? 1 : -1;
  scene.seed.diagonal = preset.actuation.seed_diagonal == preset::SeedDiagonal::y_eq_x ? 1 : -1;
  scene.imperfection = {preset.imperfection.size * scene.footprint.spacing,
                        preset.imperfection.seed,
                        preset.imperfection.form == preset::ImperfectionForm::soft_mode};
  scene.edges_per_segment = preset.accuracy.edges_per_segment;
  scene.leader_asked = preset.accuracy.leading_edges > 0;
  if (scene.leader_asked) scene.leading_edges = preset.accuracy.leading_edges;
  scene.tolerance = preset.accuracy.tolerance;
  scene.memory_GB = preset.accuracy.memory_GB;
  scene.max_strain = preset.limits.max_strain;
  scene.snap = {preset.dynamics.snap, preset.dynamics.step_s, preset.dynamics.damping_per_s};
  return scene;
}

Result<std::shared_ptr<const Scene>> shared_scene_of(const preset::Preset& preset) {
  return scene_of(preset).map(
      [](Scene&& scene) { return std::make_shared<const Scene>(std::move(scene)); });
}

}  // namespace gridshell
