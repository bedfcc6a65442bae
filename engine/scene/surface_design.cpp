#include "engine/scene/surface_design.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "engine/footprint/surface_domain.h"
#include "engine/geometry/expression.h"
#include "engine/geometry/height_grid.h"
#include "engine/geometry/mesh_surface.h"
#include "engine/geometry/surface_net.h"

namespace gridshell {
namespace {

Result<Surface::Function> parsed(const char* key, const std::string& text) {
  const auto expression = Expression::parse(text);
  if (!expression)
    return fail(Fault::bad_input,
                fmt::format("[net] {} = \"{}\": {}", key, text, expression.error().message));
  return [E = *expression](const Eigen::Vector3d& p) { return E.at(p); };
}

/// Points of a preset as columns.
Eigen::Matrix3Xd columns_of(const preset::Points& points) {
  Eigen::Matrix3Xd columns(3, Eigen::Index(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k)
    columns.col(Eigen::Index(k)) = Eigen::Vector3d::Map(points[k].data());
  return columns;
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
  auto grid = HeightGrid::through(file.x, file.y, std::move(z));
  if (!grid) return tl::unexpected<Error>(grid.error());
  const auto shared = std::make_shared<const HeightGrid>(std::move(*grid));
  return by_height([shared](const Eigen::Vector3d& p) { return shared->at(p.x(), p.y()); },
                   spacing_mm);
}

Result<Wanted> from_mesh(const preset::SurfaceData& file, double spacing_mm) {
  auto made = TriangleMesh::make(columns_of(file.vertices), file.triangles);
  if (!made) return tl::unexpected<Error>(made.error());
  const auto mesh = std::make_shared<const TriangleMesh>(std::move(*made));
  auto fitted = MeshSurface::fit(*mesh, spacing_mm);
  if (!fitted) return tl::unexpected<Error>(fitted.error());
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
  const auto function =
      implicit ? parsed("implicit", wanted.implicit) : parsed("height", wanted.height);
  if (!function) return tl::unexpected<Error>(function.error());
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
      return fail(Fault::bad_input, fmt::format("[net] apex_mm: the surface has no point at "
                                                "({:.6g}, {:.6g}) mm",
                                                apex.x(), apex.y()));
    apex.z() = *height;
  }
  const auto nearest = surface.nearest(apex);
  if (!nearest)
    return fail(Fault::bad_input,
                fmt::format("[net] apex_mm lies far off the surface: {}{}", nearest.error().message,
                            shape.height ? "; without its z it is found" : ""));
  const double off = (*nearest - apex).norm();
  // flat triangles lie off the smooth surface
  if (given.size() == 3 && off > on_it * spacing_mm)
    return fail(Fault::bad_input,
                fmt::format("[net] apex_mm lies {:.3g} mm off the surface, whose nearest point is "
                            "({:.6g}, {:.6g}, {:.6g}) mm",
                            off, nearest->x(), nearest->y(), nearest->z()));
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
    return fail(
        Fault::bad_input,
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
  const Eigen::Vector2d left(-diagonal.y(), diagonal.x());
  frame.axes.setZero();
  frame.axes.col(0).head<2>() = M_SQRT1_2 * (diagonal - left);
  frame.axes.col(1).head<2>() = M_SQRT1_2 * (diagonal + left);
  return frame;
}

}  // namespace

Result<NetDesign> surface_design(const preset::Net& wanted, double spacing_mm, NetSoFar* so_far) {
  const auto shape = surface_of(wanted, spacing_mm);
  if (!shape) return tl::unexpected<Error>(shape.error());
  const Surface& surface = shape->surface;
  const auto outside = outside_of(wanted);
  if (!outside) return tl::unexpected<Error>(outside.error());
  const auto apex = apex_of(wanted, *shape, spacing_mm);
  if (!apex) return tl::unexpected<Error>(apex.error());
  if (!((*outside)(*apex) < 0))
    return fail(
        Fault::bad_input,
        fmt::format("[net] {}: the apex ({:.4g}, {:.4g}, {:.4g}) mm lies outside",
                    wanted.within.empty() ? "cut_mm" : "within", apex->x(), apex->y(), apex->z()));
  auto place = place_of(wanted, surface, *apex);
  if (!place) return tl::unexpected<Error>(place.error());
  place->outside = *outside;
  auto made = SurfaceNet::make(surface, *place, spacing_mm / 8, so_far);
  if (!made) return tl::unexpected<Error>(made.error());
  NetDesign design;
  const auto net = std::make_shared<const SurfaceNet>(std::move(*made));
  auto part = part_of(net, *outside);
  if (!part) return tl::unexpected<Error>(part.error());
  design.domain = std::move(*part);
  const auto ring = points_on(*net, design.domain->boundary(256));
  if (!ring) return tl::unexpected<Error>(ring.error());
  design.flat = frame_of(wanted, *place, *ring);
  const Eigen::Vector2d middle = ring->topRows<2>().rowwise().mean();
  design.scale_mm = (ring->topRows<2>().colwise() - middle).colwise().norm().maxCoeff();
  design.net = net;
  return design;
}

}  // namespace gridshell
