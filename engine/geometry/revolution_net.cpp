#include "engine/geometry/revolution_net.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "engine/core/try.h"
#include "engine/geometry/spline.h"

namespace gridshell {
namespace {

tl::unexpected<Error> not_positive(const char* what, double value) {
  return invalid("{}: got {:g}, expected above 0", what, value);
}

// smallest allowed 1 - (c r)^2 and c r; at 0 the net folds, with rods around the axis or along it
constexpr double least_regular = 1e-6;
// round-off of sums of lengths, relative to the net's extent
constexpr double round_off = 1e-12;

bool exists(const Profile& profile, double c, double t) {
  const double cr = c * profile.at(t).r;
  return cr > least_regular && (1 - cr) * (1 + cr) > least_regular;
}

/// The range of t around the profile's middle in which the net exists, with the breaks inside.
std::vector<double> unfolded(const Profile& profile, double c) {
  // samples between two breaks to find the first fold
  const int samples = std::clamp(256 / static_cast<int>(profile.breaks.size()), 4, 64);
  std::vector<double> range{profile.origin};
  const auto walk = [&](std::vector<double> breaks) {
    double good = profile.origin;
    for (const double to : breaks) {
      const double from = good;
      for (int k = 1; k <= samples; ++k) {
        double bad = k == samples ? to : from + (to - from) * k / samples;
        if (exists(profile, c, bad)) {
          good = bad;
          continue;
        }
        for (int halving = 0; halving < 100 && good != bad; ++halving) {
          const double middle = (good + bad) / 2;
          if (middle == good || middle == bad) break;
          (exists(profile, c, middle) ? good : bad) = middle;
        }
        range.push_back(good);
        return;
      }
      range.push_back(to);
    }
  };
  std::vector<double> before, after;
  for (const double t : profile.breaks) (t < profile.origin ? before : after).push_back(t);
  std::ranges::reverse(before);
  walk(before);
  walk(after);
  std::ranges::sort(range);
  return range;
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
  // at the rim itself the speed ds/dt is 0
  const double rim = M_PI_2 - 1e-6;
  return Profile{
      fmt::format("spool of radius {:g} mm and waist {:g}", radius, waist), at, {-rim, rim}};
}

Result<Profile> beltrami_profile(double radius, double waist) {
  if (!(radius > 0)) return not_positive("the pseudosphere's radius", radius);
  if (!(waist > 0 && waist < 1))
    return invalid("the pseudosphere's waist: got {:g}, expected between 0 and 1", waist);
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
  TRY(spline, SplineCurve::through(r_z));
  // the net's coordinates grow along the axis
  if (r_z(1, r_z.cols() - 1) < r_z(1, 0)) *spline = *SplineCurve::through(r_z.rowwise().reverse());
  const auto curve = std::make_shared<const SplineCurve>(*spline);
  const std::vector<double>& knots = curve->knots();
  for (std::size_t k = 0; k < knots.size(); ++k)
    if (!(r_z(0, k) > 0))
      return invalid("radius of point {} of the profile: got {:g} mm, expected above 0", k + 1,
                     r_z(0, k));
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

Result<RevolutionNet> RevolutionNet::make(Profile profile, double c) {
  const double cr = c * profile.at(profile.origin).r;
  if (!(c > 0))
    return invalid("c of the net on the {}: got {:g} / mm, expected above 0", profile.name, c);
  if (!exists(profile, c, profile.origin))
    return invalid(
        "no net exists on the {} with c = {:g} / mm: in its middle sin(omega/2) = c r is "
        "{:g}, expected between 0 and 1",
        profile.name, c, cr);
  RevolutionNet net;
  net.profile_ = std::move(profile);
  net.c_ = c;
  const std::vector<double> range = unfolded(net.profile_, c);
  const auto dx = [at = net.profile_.at, c](double t) {
    const ProfilePoint p = at(t);
    return p.speed() / std::sqrt((1 - c * p.r) * (1 + c * p.r));
  };
  const auto dz = [at = net.profile_.at](double t) { return at(t).dz; };
  net.x_ = std::make_shared<const Antiderivative>(dx, range, net.profile_.origin);
  net.z_ = std::make_shared<const Antiderivative>(dz, range, net.profile_.origin);
  return net;
}

std::string RevolutionNet::why_it_ends(bool last) const {
  const double t = last ? x_->end() : x_->begin();
  const double cr = c_ * profile_.at(t).r;
  const char* angle = cr > 0.5 ? "180 degrees" : "0";
  const bool folds = t != profile_.breaks.front() && t != profile_.breaks.back();
  return fmt::format(
      "{} where u + v = {:.7g} mm, {:.7g} mm along the axis",
      folds ? fmt::format("the net on the {} folds (shear angle {})", profile_.name, angle)
            : fmt::format("the {} ends", profile_.name),
      (*x_)(t), profile_.axial_origin + (*z_)(t));
}

Result<NetPoint> RevolutionNet::at(double u, double v) const {
  const double first = first_x(), last = last_x(), slack = round_off * (last - first);
  double x = u + v;
  const double phi = c_ * (u - v);
  if (!(x >= first - slack && x <= last + slack))
    return invalid("{}; (u, v) = ({:g}, {:g}) mm is past its end", why_it_ends(!(x < 0)), u, v);
  x = std::clamp(x, first, last);
  const double t = x_->inverse(x);
  const ProfilePoint p = profile_.at(t);
  const double sine = c_ * p.r, cosine = std::sqrt((1 - sine) * (1 + sine));
  // unit vectors away from the axis and around it
  const Eigen::Vector3d radial(0, -std::sin(phi), std::cos(phi));
  const Eigen::Vector3d around(0, -std::cos(phi), -std::sin(phi));
  const double speed = p.speed();
  const Eigen::Vector3d along = Eigen::Vector3d(p.dz / speed, 0, 0) + p.dr / speed * radial;
  NetPoint point;
  point.position = p.r * radial;
  point.position.x() = profile_.axial_origin + (*z_)(t);
  point.tangent_u = cosine * along + sine * around;
  point.tangent_v = cosine * along - sine * around;
  point.omega = 2 * std::atan2(sine, cosine);
  point.K = p.K();
  return point;
}

Result<double> RevolutionNet::x_at_axial(double z) const {
  const double first = (*z_)(z_->begin()), last = (*z_)(z_->end());
  const double slack = round_off * (last - first);
  if (!(z >= first - slack && z <= last + slack))
    return invalid("{}; {:g} mm is past its end", why_it_ends(!(z < 0)), profile_.axial_origin + z);
  double low = z_->begin(), high = z_->end();
  // bisection, since dz/dt may be 0
  for (int halving = 0; halving < 200; ++halving) {
    const double middle = (low + high) / 2;
    if (middle == low || middle == high) break;
    ((*z_)(middle) < z ? low : high) = middle;
  }
  return (*x_)((low + high) / 2);
}

}  // namespace gridshell
