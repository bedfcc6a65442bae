#include "engine/scene/second_ring.h"

#include <algorithm>

#include "engine/scene/net_design.h"

namespace gridshell {
namespace {

constexpr double difference_step = 0.01;  // mm; far below any radius, far above round-off

Result<Eigen::Vector3d> tangent_at(const ChebyshevNet& net, Family family,
                                   const Eigen::Vector2d& uv) {
  const auto point = net.at(uv.x(), uv.y());
  if (!point) return tl::unexpected<Error>(point.error());
  return family == Family::u ? point->tangent_u : point->tangent_v;
}

}  // namespace

Eigen::Vector3d far_end(const Eigen::Vector3d& end, const Eigen::Vector3d& outwards,
                        const Eigen::Vector3d& curvature, double length) {
  const double turned2 = curvature.squaredNorm() * length * length;
  return end + length * (1 - turned2 / 15) * outwards + length * length / 3 * curvature;
}

Result<Eigen::Vector3d> rod_curvature(const ChebyshevNet& net, Family family,
                                      const Eigen::Vector2d& uv, double inwards) {
  const double h = inwards * difference_step;
  const Eigen::Vector2d along = family == Family::u ? Eigen::Vector2d(h, 0) : Eigen::Vector2d(0, h);
  const auto here = tangent_at(net, family, uv), in = tangent_at(net, family, uv + along);
  for (const auto* tangent : {&here, &in})
    if (!*tangent) return tl::unexpected<Error>(tangent->error());
  if (const auto out = tangent_at(net, family, uv - along)) return (*in - *out) / (2 * h);
  const auto further = tangent_at(net, family, uv + 2 * along);
  if (!further) return tl::unexpected<Error>(further.error());
  return (4 * *in - 3 * *here - *further) / (2 * h);
}

Result<void> add_second_ring(double length_mm, Scene& scene) {
  const Eigen::Index ends = 2 * Eigen::Index(scene.footprint.rods.size());
  scene.motion.begin_far = scene.motion.end_far = Eigen::Matrix3Xd::Zero(3, ends);
  for (Eigen::Index k = 0; k < ends; ++k) {
    FootprintRod& rod = scene.footprint.rods[std::size_t(k / 2)];
    const bool first = k % 2 == 0;
    if (!is_held(first ? rod.begin : rod.end)) continue;
    (first ? rod.tail_begin : rod.tail_end) = length_mm;
    const double side = first ? -1 : 1, at = first ? rod.span.begin : rod.span.end;
    const Eigen::Vector2d uv = rod.at(at);
    const auto tangent = tangent_at(*scene.net, rod.family, uv);
    const auto curvature = rod_curvature(*scene.net, rod.family, uv, -side);
    for (const auto* vector : {&tangent, &curvature})
      if (!*vector) return tl::unexpected<Error>(vector->error());
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

void lay_tails(const Scene& scene, const RodMesh& mesh, Eigen::Matrix3Xd& places) {
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const FootprintRod& rod = scene.footprint.rods[r];
    for (std::size_t k = 0; rod.has_tails() && k < mesh.rods[r].size(); ++k) {
      const double at = mesh.position[r][k];
      const bool before = at < rod.span.begin;
      if (!before && at <= rod.span.end) continue;
      const double share =
          before ? (rod.span.begin - at) / rod.tail_begin : (at - rod.span.end) / rod.tail_end;
      const Eigen::Index end = 2 * Eigen::Index(r) + (before ? 0 : 1);
      places.col(mesh.rods[r][k]) =
          (1 - share) * scene.motion.end.col(end) + share * scene.motion.end_far.col(end);
    }
  }
}

Result<Eigen::Matrix3Xd> places_on_net(const Scene& scene, const RodMesh& mesh) {
  auto places = points_on(*scene.net, within_boundary(scene.footprint, mesh));
  if (places) lay_tails(scene, mesh, *places);
  return places;
}

}  // namespace gridshell
