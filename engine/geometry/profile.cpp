#include "engine/geometry/profile.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "engine/geometry/spline_curve.h"

namespace gridshell {
namespace {

tl::unexpected<Error> not_positive(const char* what, double value) {
  return fail(Fault::bad_input, fmt::format("{} is {:g}, it must be positive", what, value));
}

}  // namespace

double ProfilePoint::speed() const { return std::hypot(dr, dz); }

double ProfilePoint::K() const {
  const double square = dr * dr + dz * dz;
  return dz * (ddz * dr - ddr * dz) / (r * square * square);
}

Result<Profile> cylinder_profile(double radius, double half_length) {
  if (!(radius > 0)) return not_positive("the cylinder's radius", radius);
  if (!(half_length > 0)) return not_positive("the cylinder's length", 2 * half_length);
  return Profile{fmt::format("cylinder of radius {:g} mm", radius),
                 [radius](double) { return ProfilePoint{.r = radius, .dz = 1}; },
                 {-half_length, half_length}};
}

Result<Profile> spool_profile(double radius, double waist) {
  if (!(radius > 0)) return not_positive("the spool's radius", radius);
  if (!(waist > 0)) return not_positive("the spool's waist", waist);
  const auto at = [radius, waist](double t) {
    const double sine = std::sin(t), cosine = std::cos(t);
    const double r = std::sqrt(waist * waist + sine * sine);
    // r r' = sin cos, z' = cos^2 / r
    const double dr = sine * cosine / r;
    const double ddr = (cosine * cosine - sine * sine - dr * dr) / r;
    const double dz = cosine * cosine / r;
    const double ddz = (-2 * sine * cosine - dz * dr) / r;
    return ProfilePoint{radius * r, radius * dr, radius * ddr, radius * dz, radius * ddz};
  };
  // at the rim itself the profile stands still
  const double rim = M_PI_2 - 1e-6;
  return Profile{
      fmt::format("spool of radius {:g} mm and waist {:g}", radius, waist), at, {-rim, rim}};
}

Result<Profile> beltrami_profile(double radius, double waist) {
  if (!(radius > 0)) return not_positive("the pseudosphere's radius", radius);
  if (!(waist > 0 && waist < 1))
    return fail(
        Fault::bad_input,
        fmt::format("the pseudosphere's waist is {:g}, it must lie between 0 and 1", waist));
  const auto at = [radius](double t) {
    const double sech = 1 / std::cosh(t), tanh = std::tanh(t);
    return ProfilePoint{radius * sech, -radius * sech * tanh,
                        radius * sech * (tanh * tanh - sech * sech), radius * tanh * tanh,
                        radius * 2 * tanh * sech * sech};
  };
  const double origin = std::acosh(1 / waist);
  return Profile{
      fmt::format("pseudosphere of radius {:g} mm", radius), at, {1e-6, origin + 12}, origin};
}

Result<Profile> tabulated_profile(const Eigen::Matrix2Xd& r_z) {
  const auto spline = SplineCurve::through(r_z);
  if (!spline) return tl::unexpected(spline.error());
  const auto curve = std::make_shared<const SplineCurve>(*spline);
  const std::vector<double>& knots = curve->knots();
  for (std::size_t k = 0; k < knots.size(); ++k)
    if (!(r_z(0, k) > 0))
      return fail(Fault::bad_input,
                  fmt::format("point {} of the profile has radius {:g} mm, it must be positive",
                              k + 1, r_z(0, k)));
  const auto at = [curve](double t) {
    const SplineCurve::Point p = curve->at(t);
    return ProfilePoint{p.position[0], p.first[0], p.second[0], p.first[1], p.second[1]};
  };
  const auto speed = [at](double t) { return at(t).speed(); };
  const Antiderivative length(speed, knots, knots.front());
  const double middle = length.inverse(length(knots.back()) / 2);
  return Profile{fmt::format("profile of {} points", knots.size()), at, knots, middle,
                 curve->at(middle).position[1]};
}

}  // namespace gridshell
