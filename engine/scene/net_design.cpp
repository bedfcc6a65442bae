#include "engine/scene/net_design.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/footprint/net_domain.h"
#include "engine/scene/surface_design.h"

namespace gridshell {
namespace {

/// Points of a preset as columns.
template <int coordinates>
Eigen::Matrix<double, coordinates, Eigen::Dynamic> matrix_of(const preset::Points& points) {
  Eigen::Matrix<double, coordinates, Eigen::Dynamic> matrix(coordinates, points.size());
  for (std::size_t k = 0; k < points.size(); ++k)
    for (int axis = 0; axis < coordinates; ++axis)
      matrix(axis, Eigen::Index(k)) = points[k].at(std::size_t(axis));
  return matrix;
}

Result<NetDesign> cap(const preset::Net& wanted) {
  NetDesign design;
  auto net = std::make_shared<SphereNet>(wanted.radius_mm);
  auto domain = cap_of(*net, wanted.cut_height);
  if (!domain) return tl::unexpected(domain.error());
  design.net = net;
  design.domain = std::move(*domain);
  design.flat.origin.z() = wanted.cut_height * wanted.radius_mm;
  design.scale_mm = wanted.radius_mm;
  return design;
}

/// Of the surfaces of revolution.
Result<Profile> profile_of(const preset::Net& wanted) {
  switch (wanted.kind) {
    case preset::NetKind::cylinder:
      // longer than asked for, so that the ends lie on it whatever the rounding
      return cylinder_profile(wanted.radius_mm, wanted.length_mm);
    case preset::NetKind::spool:
      return spool_profile(wanted.radius_mm, wanted.waist);
    case preset::NetKind::beltrami:
      return beltrami_profile(wanted.radius_mm, wanted.waist);
    case preset::NetKind::profile:
      return tabulated_profile(matrix_of<2>(wanted.profile));
    case preset::NetKind::sphere:
    case preset::NetKind::translation:
    case preset::NetKind::surface:
      break;
  }
  return fail(Fault::bad_input,
              fmt::format("[net] kind = \"{}\": no surface of revolution", word_of(wanted.kind)));
}

Result<NetDesign> half_revolution(const preset::Net& wanted) {
  auto profile = profile_of(wanted);
  if (!profile) return tl::unexpected(profile.error());
  // sin(omega/2) = c r; rods at right angles have c = 1/(sqrt(2) r)
  const double middle_r = profile->at(profile->origin).r;
  const double c = std::sin(wanted.crossing_deg / 2 * std::numbers::pi / 180) / middle_r;
  auto made = RevolutionNet::make(std::move(*profile), c);
  if (!made) return tl::unexpected(made.error());
  NetDesign design;
  auto net = std::make_shared<RevolutionNet>(std::move(*made));
  const bool whole = wanted.kind == preset::NetKind::profile && wanted.length_mm == 0;
  auto domain = whole ? half_of_all(*net) : half_of(*net, wanted.length_mm);
  if (!domain) return tl::unexpected(domain.error());
  design.net = net;
  design.domain = std::move(*domain);
  // the axis runs along u + v, and C_y, y = u - v, towards -y of the world
  design.flat.axes << M_SQRT1_2, M_SQRT1_2, -M_SQRT1_2, M_SQRT1_2, 0, 0;
  design.scale_mm = wanted.kind == preset::NetKind::profile ? middle_r : wanted.radius_mm;
  return design;
}

/// Where a rectangle of the plane meets the net, the boundary need not be plane: the flat footprint
/// lies at its mean height, its diagonal along that of the two curves.
Result<NetDesign> translation(const preset::Net& wanted) {
  const Eigen::Matrix3Xd x = matrix_of<3>(wanted.curve_u), y = matrix_of<3>(wanted.curve_v);
  auto made = TranslationNet::make(x, y);
  if (!made) return tl::unexpected(made.error());
  const Eigen::Vector3d along = (x.rightCols<1>() - x.leftCols<1>()).normalized();
  const Eigen::Vector3d across = (y.rightCols<1>() - y.leftCols<1>()).normalized();
  if (!(along.cross(across).z() > 0))
    return fail(Fault::bad_input,
                "curve_v of the translation net must run to the left of curve_u as seen from "
                "above: swap them, or turn one round");
  NetDesign design;
  auto net = std::make_shared<TranslationNet>(std::move(*made));
  design.domain = all_of(*net);
  // u as far to the right of the diagonal as v to its left
  const Eigen::Vector2d diagonal = (along + across).head<2>().normalized();
  const Eigen::Vector2d left(-diagonal.y(), diagonal.x());
  design.flat.axes.col(0).head<2>() = M_SQRT1_2 * (diagonal - left);
  design.flat.axes.col(1).head<2>() = M_SQRT1_2 * (diagonal + left);
  const auto ring = points_on(*net, design.domain->boundary(256));
  if (!ring) return tl::unexpected(ring.error());
  design.flat.origin = ring->rowwise().mean();
  design.scale_mm = Eigen::Vector2d(net->half_u(), net->half_v()).norm();
  design.net = net;
  return design;
}

}  // namespace

Result<NetDesign> net_design(const preset::Net& net, double spacing_mm) {
  switch (net.kind) {
    case preset::NetKind::sphere:
      return cap(net);
    case preset::NetKind::translation:
      return translation(net);
    case preset::NetKind::cylinder:
    case preset::NetKind::spool:
    case preset::NetKind::beltrami:
    case preset::NetKind::profile:
      break;
    case preset::NetKind::surface:
      return surface_design(net, spacing_mm);
  }
  return half_revolution(net);
}

}  // namespace gridshell
