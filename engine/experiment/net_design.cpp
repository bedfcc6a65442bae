#include "engine/experiment/net_design.h"

#include <cmath>

#include "engine/footprint/net_domain.h"

namespace gridshell::experiment {
namespace {

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

Result<Profile> profile_of(const preset::Net& wanted) {
  switch (wanted.kind) {
    case preset::NetKind::spool:
      return spool_profile(wanted.radius_mm, wanted.waist);
    case preset::NetKind::beltrami:
      return beltrami_profile(wanted.radius_mm, wanted.waist);
    default:
      // longer than asked for, so that the ends lie on it whatever the rounding
      return cylinder_profile(wanted.radius_mm, wanted.length_mm);
  }
}

Result<NetDesign> half_revolution(const preset::Net& wanted) {
  auto profile = profile_of(wanted);
  if (!profile) return tl::unexpected(profile.error());
  const double c = RevolutionNet::right_angled(*profile);
  auto made = RevolutionNet::make(std::move(*profile), c);
  if (!made) return tl::unexpected(made.error());
  NetDesign design;
  auto net = std::make_shared<RevolutionNet>(std::move(*made));
  auto domain = half_of(*net, wanted.length_mm);
  if (!domain) return tl::unexpected(domain.error());
  design.net = net;
  design.domain = std::move(*domain);
  // the axis runs along u + v, and C_y, y = u - v, towards -y of the world
  design.flat.axes << M_SQRT1_2, M_SQRT1_2, -M_SQRT1_2, M_SQRT1_2, 0, 0;
  design.scale_mm = wanted.radius_mm;
  return design;
}

}  // namespace

Result<NetDesign> net_design(const preset::Net& net) {
  if (net.kind == preset::NetKind::sphere) return cap(net);
  return half_revolution(net);
}

Result<Eigen::Matrix3Xd> sample(const ChebyshevNet& net, const Eigen::Matrix2Xd& uv) {
  Eigen::Matrix3Xd points(3, uv.cols());
  for (Eigen::Index k = 0; k < uv.cols(); ++k) {
    const auto point = net.at(uv(0, k), uv(1, k));
    if (!point) return tl::unexpected(point.error());
    points.col(k) = point->position;
  }
  return points;
}

}  // namespace gridshell::experiment
