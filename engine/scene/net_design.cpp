#include "engine/scene/net_design.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "engine/core/try.h"
#include "engine/footprint/domains.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/surface.h"
#include "engine/preset/consistency.h"

namespace gridshell {
namespace {

/// Axes of the flat whose diagonal u + v runs along `diagonal`, of unit length.
Eigen::Matrix<double, 3, 2> axes_about(const Eigen::Vector2d& diagonal) {
  const Eigen::Vector2d left(-diagonal.y(), diagonal.x());
  Eigen::Matrix<double, 3, 2> axes = Eigen::Matrix<double, 3, 2>::Zero();
  axes.col(0).head<2>() = M_SQRT1_2 * (diagonal - left);
  axes.col(1).head<2>() = M_SQRT1_2 * (diagonal + left);
  return axes;
}

/// Where the axis of a surface of revolution, or the row of blocks, runs along u + v and x.
Eigen::Matrix<double, 3, 2> axes_along_x() { return axes_about(Eigen::Vector2d::UnitX()); }

Result<NetDesign> cap(const preset::Net& wanted) {
  NetDesign design;
  auto net = std::make_shared<SphereNet>(wanted.radius_mm);
  TRY(domain, cap_of(*net, wanted.cut_height));
  design.net = net;
  design.domain = std::move(*domain);
  design.flat.origin.z() = wanted.cut_height * wanted.radius_mm;
  design.scale_mm = wanted.radius_mm;
  return design;
}

Result<NetDesign> half_revolution(const preset::Net& wanted, Result<Profile> profile) {
  if (!profile) return tl::unexpected(profile.error());
  // sin(omega/2) = c r; rods at right angles have c = 1/(sqrt(2) r)
  const double middle_r = profile->at(profile->origin).r;
  const double c = std::sin(wanted.crossing_deg / 2 * std::numbers::pi / 180) / middle_r;
  TRY(made, RevolutionNet::make(std::move(*profile), c));
  NetDesign design;
  auto net = std::make_shared<RevolutionNet>(std::move(*made));
  const bool whole = wanted.kind == preset::NetKind::profile && wanted.length_mm == 0;
  TRY(domain, whole ? half_of_all(*net) : half_of(*net, wanted.length_mm));
  design.net = net;
  design.domain = std::move(*domain);
  // the axis runs along u + v, and C_y, y = u - v, towards -y of the world
  design.flat.axes = axes_along_x();
  design.scale_mm = wanted.kind == preset::NetKind::profile ? middle_r : wanted.radius_mm;
  return design;
}

/// Where a rectangle of the plane meets the net, the boundary need not be plane: the flat footprint
/// lies at its mean height, its diagonal along that of the two curves.
Result<NetDesign> translation(const preset::Net& wanted) {
  const Eigen::Matrix3Xd x = preset::matrix_of<3>(wanted.curve_u),
                         y = preset::matrix_of<3>(wanted.curve_v);
  TRY(made, TranslationNet::make(x, y));
  const Eigen::Vector3d along = (x.rightCols<1>() - x.leftCols<1>()).normalized();
  const Eigen::Vector3d across = (y.rightCols<1>() - y.leftCols<1>()).normalized();
  if (!(along.cross(across).z() > 0))
    return invalid(
        "curve_v of the translation net must run to the left of curve_u as seen from "
        "above: swap them, or turn one round");
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

Result<Block> block_of(const preset::Block& wanted, const preset::Footprint& footprint) {
  auto design = net_design(wanted.net, footprint.spacing_mm);
  if (!design)
    return fail(design.error().fault, "block \"{}\": {}", wanted.name, design.error().message);
  Block block;
  block.name = wanted.name;
  block.net = design->net;
  block.domain = std::move(design->domain);
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  block.pose.linear() = axes_along_x() * design->flat.axes.transpose() + up * up.transpose();
  block.pose.translation().z() = -design->flat.origin.z();
  block.spacing = footprint.spacing_mm;
  block.placement = footprint.placement;
  block.cut = {wanted.east, wanted.west, wanted.north, wanted.south};
  return block;
}

Result<BlockSide> block_side(const preset::Preset& preset, const std::string& name) {
  const auto side = preset::side_named(preset, name);
  const auto facing = side ? find_word<Side>(side->side) : std::nullopt;
  if (!facing) return invalid("\"{}\" is no side of a block", name);
  return BlockSide{side->block, *facing};
}

Result<Surface::Function> parsed(const char* key, const std::string& text) {
  const auto expression = Expression::parse(text);
  if (!expression) return invalid("[net] {} = \"{}\": {}", key, text, expression.error().message);
  return [E = *expression](const Eigen::Vector3d& p) { return E.at(p); };
}

/// A surface, and its height where it has one; of a mesh the highest.
struct Wanted {
  Surface surface;
  std::function<std::optional<double>(double x, double y)> height;
};

std::optional<double> if_finite(double value) {
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

Result<Wanted> by_height(const Surface::Function& h, double spacing_mm) {
  return Wanted{Surface([h](const Eigen::Vector3d& p) { return p.z() - h(p); }, spacing_mm),
                [h](double x, double y) { return if_finite(h(Eigen::Vector3d(x, y, 0))); }};
}

Result<Wanted> from_grid(const preset::SurfaceData& file, double spacing_mm) {
  Eigen::MatrixXd z(file.y.size(), file.x.size());
  for (std::size_t j = 0; j < file.y.size(); ++j)
    for (std::size_t i = 0; i < file.x.size(); ++i)
      z(Eigen::Index(j), Eigen::Index(i)) = file.z[j][i];
  TRY(grid, HeightGrid::through(file.x, file.y, std::move(z)));
  const auto shared = std::make_shared<const HeightGrid>(std::move(*grid));
  return by_height([shared](const Eigen::Vector3d& p) { return shared->at(p.x(), p.y()); },
                   spacing_mm);
}

Result<Wanted> from_mesh(const preset::SurfaceData& file, double spacing_mm) {
  TRY(made, TriangleMesh::make(preset::matrix_of<3>(file.vertices), file.triangles));
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(*made));
  TRY(fitted, MeshSurface::fit(*mesh, spacing_mm));
  const auto surface = std::make_shared<const MeshSurface>(std::move(*fitted));
  return Wanted{Surface([surface](const Eigen::Vector3d& p) { return surface->at(p); }, spacing_mm),
                [mesh](double x, double y) { return highest_at(*mesh, x, y); }};
}

Result<Wanted> surface_of(const preset::Net& wanted, double spacing_mm) {
  if (!wanted.file.empty())
    return (wanted.file.is_mesh() ? from_mesh : from_grid)(wanted.file, spacing_mm)
        .map_error([](const Error& error) {
          return Error{error.fault, "[net] file: " + error.message};
        });
  const bool implicit = !wanted.implicit.empty();
  TRY(function, implicit ? parsed("implicit", wanted.implicit) : parsed("height", wanted.height));
  if (!implicit) return by_height(*function, spacing_mm);
  return Wanted{Surface(*function, spacing_mm), {}};
}

/// Below zero inside the boundary.
Result<Surface::Function> outside_of(const preset::Net& wanted) {
  if (!wanted.within.empty()) return parsed("within", wanted.within);
  return [cut = wanted.cut_mm](const Eigen::Vector3d& p) { return cut - p.z(); };
}

/// The apex on the surface. Where its z is left out it is the surface's own.
Result<Eigen::Vector3d> apex_of(const preset::Net& wanted, const Wanted& shape, double spacing_mm) {
  constexpr double on_it = 1e-2;  // of the spacing
  const Surface& surface = shape.surface;
  const auto& given = wanted.apex_mm;
  Eigen::Vector3d apex(given[0], given[1], given.size() > 2 ? given[2] : 0);
  if (given.size() == 2) {
    const auto height = shape.height(apex.x(), apex.y());
    if (!height)
      return invalid(
          "[net] apex_mm: the surface has no point at "
          "({:.6g}, {:.6g}) mm",
          apex.x(), apex.y());
    apex.z() = *height;
  }
  const auto nearest = surface.nearest(apex);
  if (!nearest)
    return invalid("[net] apex_mm lies far off the surface: {}{}", nearest.error().message,
                   shape.height ? "; without its z it is found" : "");
  const double off = (*nearest - apex).norm();
  // flat triangles lie off the smooth surface
  if (given.size() == 3 && off > on_it * spacing_mm)
    return invalid(
        "[net] apex_mm lies {:.3g} mm off the surface, whose nearest point is "
        "({:.6g}, {:.6g}, {:.6g}) mm",
        off, nearest->x(), nearest->y(), nearest->z());
  return *nearest;
}

/// Where the axes leave to, on the surface at its apex.
Result<NetPlace> place_of(const preset::Net& wanted, const Surface& surface,
                          const Eigen::Vector3d& apex) {
  constexpr double steepest = 0.1;
  const Surface::Curvature bent = surface.curvature(apex);
  Eigen::Vector3d up = bent.axes.col(2);
  if (up.z() < 0) up = -up;
  if (!(up.z() > steepest))
    return invalid(
        "[net] apex_mm: the surface is upright there, it must face up where the net begins");
  Eigen::Vector3d along = bent.axes.col(0);
  if (wanted.axis == preset::NetAxis::x || bent.umbilic)
    along = (Eigen::Vector3d::UnitX() - up.x() * up).normalized();
  // of the two opposite directions the one towards +x
  if (along.x() < 0) along = -along;
  const double turned = wanted.axis_deg * std::numbers::pi / 180;
  return NetPlace{apex, Eigen::AngleAxisd(turned, up) * along, up, {}};
}

/// In the plane of the cut, or at the boundary's mean height, below the apex; as far to the right
/// of the rods' diagonal as to its left.
FlatFrame frame_of(const preset::Net& wanted, const NetPlace& place, const Eigen::Matrix3Xd& ring) {
  FlatFrame frame;
  frame.origin = place.apex;
  frame.origin.z() = wanted.within.empty() ? wanted.cut_mm : ring.row(2).mean();
  const Eigen::Vector2d diagonal =
      (place.along_u + place.up.cross(place.along_u)).head<2>().normalized();
  frame.axes = axes_about(diagonal);
  return frame;
}

/// What may be the cause where a file's surface bears no net: its unit, or its axes; or empty.
std::string likely_cause(const preset::SurfaceData& file, double spacing_mm) {
  Eigen::AlignedBox3d box;
  for (const auto& at : file.vertices) box.extend(Eigen::Vector3d(at[0], at[1], at[2]));
  const double width = file.is_mesh() ? box.sizes().maxCoeff()
                       : file.empty() ? NAN
                                      : file.x.back() - file.x.front();
  if (width < 2 * spacing_mm)
    return fmt::format(
        "; the whole surface is {:.3g} mm wide and the rods {:.3g} mm apart: is the file in "
        "metres? "
        "[net] file_unit = \"m\" reads it so",
        width, spacing_mm);
  Eigen::Vector3d faced = Eigen::Vector3d::Zero();
  for (const auto& [a, b, c] : file.triangles) {
    const Eigen::Map<const Eigen::Vector3d> p(file.vertices[std::size_t(a)].data()),
        q(file.vertices[std::size_t(b)].data()), r(file.vertices[std::size_t(c)].data());
    faced += (q - p).cross(r - p).cwiseAbs();
  }
  return faced.y() > 1.5 * faced.z()
             ? "; the surface faces y, not z: is y up in the file? Its y and z "
               "must be exchanged"
             : "";
}

/// F(x, y, z) = 0, z = h(x, y), heights over a grid or a mesh, from an apex where the surface faces
/// up, as far as the boundary; the net's grid is an eighth of the rods' spacing. Errors
/// (bad_input): an expression that does not parse, a mesh that is no smooth sheet, an apex off the
/// surface or outside the boundary, and those of the net and its part. `so_far`, where given, is
/// filled where the net ends too early.
Result<NetDesign> surface_design(const preset::Net& wanted, double spacing_mm,
                                 PartialNet* so_far = nullptr) {
  TRY(shape, surface_of(wanted, spacing_mm));
  const Surface& surface = shape->surface;
  TRY(outside, outside_of(wanted));
  TRY(apex, apex_of(wanted, *shape, spacing_mm));
  if (!((*outside)(*apex) < 0))
    return invalid("[net] {}: the apex ({:.4g}, {:.4g}, {:.4g}) mm lies outside",
                   wanted.within.empty() ? "cut_mm" : "within", apex->x(), apex->y(), apex->z());
  TRY(place, place_of(wanted, surface, *apex));
  place->outside = *outside;
  TRY(made, SurfaceNet::make(surface, *place, spacing_mm / 8, so_far));
  NetDesign design;
  const auto net = std::make_shared<const SurfaceNet>(std::move(*made));
  TRY(part, part_of(net, *outside));
  design.domain = std::move(*part);
  TRY(ring, points_on(*net, design.domain->boundary(256)));
  design.flat = frame_of(wanted, *place, *ring);
  const Eigen::Vector2d middle = ring->topRows<2>().rowwise().mean();
  design.scale_mm = (ring->topRows<2>().colwise() - middle).colwise().norm().maxCoeff();
  design.net = net;
  return design;
}

}  // namespace

Result<NetDesign> net_design(const preset::Net& net, double spacing_mm) {
  switch (net.kind) {
    case preset::NetKind::sphere:
      return cap(net);
    case preset::NetKind::cylinder:
      // longer than asked for, so that the ends lie on it whatever the rounding
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
  return surface_design(net, spacing_mm).map_error([&](Error error) {
    error.message += likely_cause(net.file, spacing_mm);
    return error;
  });
}

Result<NetDesign> block_design(const preset::Preset& preset) {
  std::vector<Block> blocks;
  for (const preset::Block& wanted : preset.block) {
    TRY(block, block_of(wanted, preset.footprint));
    blocks.push_back(std::move(*block));
  }
  std::vector<Join> joins;
  for (const preset::Join& wanted : preset.join) {
    TRY(first, block_side(preset, wanted.first), second = block_side(preset, wanted.second));
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
      preset.net.kind != preset::NetKind::surface)
    return std::nullopt;
  PartialNet so_far;
  if (surface_design(preset.net, preset.footprint.spacing_mm, &so_far)) return std::nullopt;
  if (so_far.lines.empty()) return std::nullopt;
  return so_far;
}

}  // namespace gridshell
