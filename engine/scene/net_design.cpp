#include "engine/scene/net_design.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/core/try.h"
#include "engine/footprint/domains.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/surface.h"
#include "engine/preset/consistency.h"
#include "engine/scene/surface_pose.h"

namespace gridshell {
namespace {

/// Axes with u + v along x, the axis of a surface of revolution or of a row of blocks.
Eigen::Matrix<double, 3, 2> axes_along_x() { return axes_about(Eigen::Vector2d::UnitX()); }

Result<NetDesign> cap(const preset::Net& requested) {
  NetDesign design;
  auto net = std::make_shared<SphereNet>(requested.radius_mm);
  TRY(domain, cap_of(*net, requested.cut_height));
  design.net = net;
  design.domain = std::move(*domain);
  design.flat.origin.z() = requested.cut_height * requested.radius_mm;
  design.scale_mm = requested.radius_mm;
  return design;
}

Result<NetDesign> half_revolution(const preset::Net& requested, Result<Profile> profile) {
  if (!profile) return tl::unexpected(profile.error());
  // sin(omega/2) = c r; rods at right angles have c = 1/(sqrt(2) r)
  const double middle_r = profile->at(profile->origin).r;
  const double c = std::sin(requested.crossing_deg / 2 * std::numbers::pi / 180) / middle_r;
  TRY(made, RevolutionNet::make(std::move(*profile), c));
  NetDesign design;
  auto net = std::make_shared<RevolutionNet>(std::move(*made));
  const bool whole = requested.kind == preset::NetKind::profile && requested.length_mm == 0;
  TRY(domain, whole ? half_of_all(*net) : half_of(*net, requested.length_mm));
  design.net = net;
  design.domain = std::move(*domain);
  // the axis is along u + v; the net's y = u - v is towards -y of the world
  design.flat.axes = axes_along_x();
  design.scale_mm = requested.kind == preset::NetKind::profile ? middle_r : requested.radius_mm;
  return design;
}

/// A net of translation. The image of its rectangle need not be plane at the boundary: the flat
/// footprint is at the boundary's mean height, with its diagonal along that of the two curves.
Result<NetDesign> translation(const preset::Net& requested) {
  const Eigen::Matrix3Xd x = preset::matrix_of<3>(requested.curve_u),
                         y = preset::matrix_of<3>(requested.curve_v);
  TRY(made, TranslationNet::make(x, y));
  const Eigen::Vector3d along = (x.rightCols<1>() - x.leftCols<1>()).normalized();
  const Eigen::Vector3d across = (y.rightCols<1>() - y.leftCols<1>()).normalized();
  if (!(along.cross(across).z() > 0))
    return invalid(
        "curve_v of the translation net: got a curve to the right, expected one to the left of "
        "curve_u as seen from above: swap them, or turn one round");
  NetDesign design;
  auto net = std::make_shared<TranslationNet>(std::move(*made));
  design.domain = all_of(*net);
  const Eigen::Vector2d diagonal = (along + across).head<2>().normalized();
  design.flat.axes = axes_about(diagonal);
  TRY(ring, points_on(*net, design.domain->boundary(256)));
  design.flat.origin = ring->rowwise().mean();
  design.scale_mm = Eigen::Vector2d(net->half_u(), net->half_v()).norm();
  design.net = net;
  return design;
}

Result<Block> block_of(const preset::Block& requested, const preset::Footprint& footprint) {
  auto design = net_design(requested.net, footprint.spacing_mm);
  if (!design)
    return fail(design.error().fault, "block \"{}\": {}", requested.name, design.error().message);
  Block block;
  block.name = requested.name;
  block.net = design->net;
  block.domain = std::move(design->domain);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  block.pose.linear() = axes_along_x() * design->flat.axes.transpose() + up * up.transpose();
  block.pose.translation().z() = -design->flat.origin.z();
  block.spacing = footprint.spacing_mm;
  block.placement = footprint.placement;
  block.cut = {requested.east, requested.west, requested.north, requested.south};
  return block;
}

Result<BlockSide> block_side(const preset::Preset& preset, const std::string& name) {
  const auto side = preset::side_named(preset, name);
  const auto facing = side ? find_word<Side>(side->side) : std::nullopt;
  if (!facing) return invalid("got \"{}\", expected a side of a block", name);
  return BlockSide{side->block, *facing};
}

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Result<ShapedSurface> by_height(const Surface::Function& h, double spacing_mm) {
  return ShapedSurface{Surface([h](const Eigen::Vector3d& p) { return p.z() - h(p); }, spacing_mm),
                       [h](double x, double y) { return if_finite(h(Eigen::Vector3d(x, y, 0))); }};
}

Result<ShapedSurface> from_grid(const preset::SurfaceData& file, double spacing_mm) {
  Eigen::MatrixXd z(file.y.size(), file.x.size());
  for (std::size_t j = 0; j < file.y.size(); ++j)
    for (std::size_t i = 0; i < file.x.size(); ++i)
      z(Eigen::Index(j), Eigen::Index(i)) = file.z[j][i];
  TRY(grid, HeightGrid::through(file.x, file.y, std::move(z)));
  const auto shared = std::make_shared<const HeightGrid>(std::move(*grid));
  return by_height([shared](const Eigen::Vector3d& p) { return shared->at(p.x(), p.y()); },
                   spacing_mm);
}

Result<ShapedSurface> surface_of(const preset::Net& requested, double spacing_mm) {
  if (!requested.file.empty())
    return from_grid(requested.file, spacing_mm).map_error([](const Error& error) {
      return Error{error.fault, "[net] file: " + error.message};
    });
  const bool implicit = !requested.implicit.empty();
  TRY(function,
      implicit ? parsed("implicit", requested.implicit) : parsed("height", requested.height));
  if (!implicit) return by_height(*function, spacing_mm);
  return ShapedSurface{Surface(*function, spacing_mm), {}};
}

/// A text on the likely cause if there is no net on a file's heights: their unit; empty: none is
/// known.
std::string likely_cause(const preset::SurfaceData& file, double spacing_mm) {
  const double width = file.empty() || file.is_mesh() ? NAN : file.x.back() - file.x.front();
  if (!(width < 2 * spacing_mm)) return "";
  return fmt::format(
      "; the whole surface is {:.3g} mm wide and the distance of the rods {:.3g} mm: is the file "
      "in metres? "
      "[net] file_unit = \"m\" reads it so",
      width, spacing_mm);
}

/// The net on F(x, y, z) = 0, z = h(x, y) or heights over a grid, from an apex where the surface
/// faces up to the boundary; the net's grid is an eighth of the rods' spacing. If the net ends too
/// early, `so_far` (may be null) is filled with its computed part. Errors (bad_input): an
/// expression that does not parse, an apex that is not on the surface or outside the boundary, and
/// those of the net and its part.
Result<NetDesign> surface_design(const preset::Net& requested, double spacing_mm,
                                 PartialNet* so_far = nullptr) {
  TRY(shape, surface_of(requested, spacing_mm));
  const Surface& surface = shape->surface;
  TRY(outside, outside_of(requested));
  TRY(pose, given_pose(requested, *shape, *outside, 0.01 * spacing_mm));
  TRY(made, SurfaceNet::make(surface, *pose, spacing_mm / 8, so_far));
  NetDesign design;
  const auto net = std::make_shared<const SurfaceNet>(std::move(*made));
  TRY(part, part_of(net, *outside));
  design.domain = std::move(*part);
  design.net = net;
  TRY_DO(lay_flat(requested, *pose, design));
  return design;
}

}  // namespace

Result<NetDesign> net_design(const preset::Net& net, double spacing_mm) {
  switch (net.kind) {
    case preset::NetKind::sphere:
      return cap(net);
    case preset::NetKind::cylinder:
      // longer than requested, so that the ends are on it in spite of rounding
      return half_revolution(net, cylinder_profile(net.radius_mm, net.length_mm));
    case preset::NetKind::spool:
      return half_revolution(net, spool_profile(net.radius_mm, net.waist));
    case preset::NetKind::beltrami:
      return half_revolution(net, beltrami_profile(net.radius_mm, net.waist));
    case preset::NetKind::profile:
      return half_revolution(net, tabulated_profile(preset::matrix_of<2>(net.profile)));
    case preset::NetKind::translation:
      return translation(net);
    case preset::NetKind::surface:
      break;
  }
  if (net.file.is_mesh()) return mesh_design(net, spacing_mm);
  return surface_design(net, spacing_mm).map_error([&](Error error) {
    error.message += likely_cause(net.file, spacing_mm);
    return error;
  });
}

Result<NetDesign> block_design(const preset::Preset& preset) {
  std::vector<Block> blocks;
  for (const preset::Block& requested : preset.block) {
    TRY(block, block_of(requested, preset.footprint));
    blocks.push_back(std::move(*block));
  }
  std::vector<Join> joins;
  for (const preset::Join& requested : preset.join) {
    TRY(first, block_side(preset, requested.first), second = block_side(preset, requested.second));
    if (!second) return tl::unexpected(second.error());
    joins.push_back({*first, *second});
  }
  TRY(whole, Assemblage::make(std::move(blocks), joins, preset.blocks.max_gap_mm));
  NetDesign design;
  design.net = whole->net();
  design.domain = whole->domain();
  design.flat.axes = axes_along_x();
  const Eigen::Matrix2Xd ring = design.domain->boundary(256);
  design.scale_mm = 0.5 * (ring.rowwise().maxCoeff() - ring.rowwise().minCoeff()).norm();
  design.blocks = std::make_shared<const Assemblage>(std::move(*whole));
  return design;
}

std::optional<PartialNet> refused_net(const preset::Preset& preset) {
  if (preset.footprint.kind != preset::FootprintKind::net ||
      preset.net.kind != preset::NetKind::surface || preset.net.file.is_mesh())
    return std::nullopt;
  PartialNet so_far;
  if (surface_design(preset.net, preset.footprint.spacing_mm, &so_far)) return std::nullopt;
  if (so_far.lines.empty()) return std::nullopt;
  return so_far;
}

}  // namespace gridshell
