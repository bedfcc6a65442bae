#include "engine/geometry/translation_net.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridshell {
namespace {

// tangents this near to parallel (rad) count as a fold
constexpr double least_sine = 1e-6;

tl::unexpected<Error> beyond(const char* curve, char name, double at, double half) {
  return fail(Fault::bad_input,
              fmt::format("curve_{} of the translation net ends at {} = {:.7g} mm; {} = {:g} mm "
                          "lies beyond",
                          curve, name, at < 0 ? -half : half, name, at));
}

tl::unexpected<Error> folds(double u, double v, double cosine) {
  return fail(Fault::bad_input,
              fmt::format("the translation net folds (shear angle {}) near (u, v) = ({:g}, {:g}) "
                          "mm, where its curves are parallel",
                          cosine > 0 ? "0" : "180 degrees", u, v));
}

}  // namespace

Result<TranslationNet> TranslationNet::make(const Eigen::Matrix3Xd& x, const Eigen::Matrix3Xd& y) {
  auto curve_u = SplineCurve::through(x), curve_v = SplineCurve::through(y);
  if (!curve_u) return fail(Fault::bad_input, "curve_u: " + curve_u.error().message);
  if (!curve_v) return fail(Fault::bad_input, "curve_v: " + curve_v.error().message);
  TranslationNet net(UnitSpeedCurve(std::move(*curve_u)), UnitSpeedCurve(std::move(*curve_v)));
  if (auto open = net.check_open(); !open) return tl::unexpected(open.error());
  return net;
}

Result<void> TranslationNet::check_open() const {
  // the normal turns over where tangents pass through parallel
  constexpr int samples = 128;
  Eigen::Matrix3Xd along_u(3, samples + 1), along_v(3, samples + 1);
  const auto place = [](double half, int k) { return half * (2.0 * k / samples - 1); };
  for (int k = 0; k <= samples; ++k) {
    along_u.col(k) = x_.at(place(half_u(), k)).first;
    along_v.col(k) = y_.at(place(half_v(), k)).first;
  }
  for (int i = 0; i <= samples; ++i) {
    for (int j = 0; j <= samples; ++j) {
      const Eigen::Vector3d normal = along_u.col(i).cross(along_v.col(j));
      const Eigen::Vector3d before_u = along_u.col(std::max(i - 1, 0)).cross(along_v.col(j));
      const Eigen::Vector3d before_v = along_u.col(i).cross(along_v.col(std::max(j - 1, 0)));
      if (normal.norm() > least_sine && normal.dot(before_u) > 0 && normal.dot(before_v) > 0)
        continue;
      return folds(place(half_u(), i), place(half_v(), j), along_u.col(i).dot(along_v.col(j)));
    }
  }
  return {};
}

Result<NetPoint> TranslationNet::at(double u, double v) const {
  if (!(std::abs(u) <= half_u())) return beyond("u", 'u', u, half_u());
  if (!(std::abs(v) <= half_v())) return beyond("v", 'v', v, half_v());
  const SplineCurve::Point x = x_.at(u), y = y_.at(v);
  NetPoint point;
  point.position = x.position + y.position;
  point.tangent_u = x.first;
  point.tangent_v = y.first;
  const double sine = point.tangent_u.cross(point.tangent_v).norm();
  const double cosine = point.tangent_u.dot(point.tangent_v);
  point.omega = std::atan2(sine, cosine);
  if (!(sine > least_sine)) return folds(u, v, cosine);
  // second form (C_uu . n, 0, C_vv . n), first form of determinant sin^2 omega
  const Eigen::Vector3d normal = point.normal();
  const double bend_u = normal.dot(x.second.head<3>()), bend_v = normal.dot(y.second.head<3>());
  point.K = bend_u * bend_v / (sine * sine);
  return point;
}

}  // namespace gridshell
