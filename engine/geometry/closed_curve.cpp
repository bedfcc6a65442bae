#include "engine/geometry/closed_curve.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "engine/core/try.h"
#include "engine/geometry/spline.h"

namespace gridshell {
namespace {

using Eigen::Vector2d;

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// Root in [low, high] of g = {value, slope}, which has opposite signs at the two ends.
double root(const std::function<Vector2d(double)>& g, double low, double high) {
  const double sign = g(low)[0] < 0 ? 1 : -1;
  const auto rising = [&](double t) -> Vector2d { return sign * g(t); };
  return bracketed_root(rising, low, high, (low + high) / 2, 1e-16 * (high - low));
}

/// The points without a repeated first one, counter-clockwise; at least three, all of them finite.
Result<Eigen::Matrix2Xd> cleaned(const Eigen::Matrix2Xd& given) {
  Eigen::Matrix2Xd points = given;
  if (points.cols() > 1 && points.col(0) == points.col(points.cols() - 1))
    points.conservativeResize(2, points.cols() - 1);
  const Eigen::Index n = points.cols();
  if (n < 3) return invalid("a closed curve: got {} points, expected at least 3", n);
  double area = 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    if (!points.col(k).allFinite())
      return invalid("point {} of the closed curve is not finite", k + 1);
    const Vector2d next = points.col((k + 1) % n);
    if (points.col(k) == next)
      return invalid("points {} and {} of the closed curve are the same", k + 1, (k + 1) % n + 1);
    area += cross(points.col(k), next) / 2;
  }
  if (area < 0) points.rightCols(n - 1).rowwise().reverseInPlace();
  return points;
}

bool segments_meet(const Vector2d& a, const Vector2d& b, const Vector2d& c, const Vector2d& d) {
  const auto side = [](const Vector2d& p, const Vector2d& q, const Vector2d& r) {
    return cross(q - p, r - p) > 0;
  };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

/// Index of the first segment of a closed polyline that meets another one, which is no neighbour;
/// the number of points if there is none.
std::size_t first_crossing(const std::vector<Vector2d>& p) {
  const std::size_t n = p.size() - 1;
  const auto low = [&](std::size_t k) { return std::min(p[k].x(), p[k + 1].x()); };
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, low);
  std::size_t first = p.size();
  for (std::size_t a = 0; a < n; ++a) {
    const double high = std::max(p[order[a]].x(), p[order[a] + 1].x());
    for (std::size_t b = a + 1; b < n && low(order[b]) <= high; ++b) {
      const auto [i, j] = std::minmax(order[a], order[b]);
      if (j >= i + 2 && j < n + i - 1 && i < first && segments_meet(p[i], p[i + 1], p[j], p[j + 1]))
        first = i;
    }
  }
  return first;
}

/// All t at which the ray from the origin at `angle` meets the curve.
std::vector<double> on_ray(const ClosedCurve& curve, double angle) {
  // axes along and across the ray
  const Vector2d along(std::cos(angle), std::sin(angle)), across(-along.y(), along.x());
  std::vector<double> found;
  std::vector<double> t;
  const int samples = std::max(512, 8 * static_cast<int>(curve.breaks().size()));
  for (int k = 0; k < samples; ++k) t.push_back(curve.last() * k / samples);
  t.insert(t.end(), curve.breaks().begin(), curve.breaks().end());
  std::ranges::sort(t);
  const auto g = [&](double at) {
    const ClosedCurve::Point p = curve.at(at);
    return Vector2d(across.dot(p.position), across.dot(p.first));
  };
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    const double end = k + 2 == t.size() ? t[0] : t[k + 1];
    if ((g(t[k])[0] >= 0) == (g(end)[0] >= 0)) continue;
    const double at = root(g, t[k], t[k + 1]);
    if (along.dot(curve.at(at).position) > 0) found.push_back(at);
  }
  return found;
}

Result<void> check_star(const ClosedCurve& curve, const char* name, Correspondence how) {
  const std::size_t on_axis = on_ray(curve, 0).size();
  if (on_axis % 2 == 0) return invalid("the origin is not inside the {} boundary", name);
  if (how == Correspondence::arc_length && on_axis > 1)
    return invalid(
        "the positive x-axis meets the {} boundary more than once: arc lengths need one "
        "position to start",
        name);
  // each ray meets the curve once if its polar angle always grows
  constexpr int samples = 2048;
  for (int k = 0; how == Correspondence::angle && k < samples; ++k) {
    const ClosedCurve::Point p = curve.at(curve.last() * (k + 0.5) / samples);
    if (cross(p.position, p.first) > 0) continue;
    return invalid(
        "the ray from the origin at {:.4g} degrees meets the {} boundary more than once: "
        "use correspondence \"arc_length\"",
        std::atan2(p.position.y(), p.position.x()) * 180 / M_PI, name);
  }
  return {};
}

}  // namespace

Result<ClosedCurve> ClosedCurve::make(std::function<Point(double)> at, std::vector<double> breaks) {
  ClosedCurve curve;
  curve.at_ = std::move(at);
  curve.breaks_ = std::move(breaks);
  std::vector<Vector2d> p;
  for (const double t : curve.samples()) p.push_back(curve.at_(t).position);
  if (const auto at = first_crossing(p); at < p.size())
    return invalid("the closed curve crosses itself near ({:.6g}, {:.6g}) mm", p[at].x(),
                   p[at].y());
  const auto speed = [at = curve.at_](double s) { return at(s).first.norm(); };
  curve.length_ = std::make_shared<const Antiderivative>(speed, curve.breaks_, 0);
  return curve;
}

Result<ClosedCurve> ClosedCurve::ellipse(double a, double b) { return superellipse(a, b, 2); }

Result<ClosedCurve> ClosedCurve::superellipse(double a, double b, double exponent) {
  if (!(a > 0 && b > 0 && std::isfinite(a) && std::isfinite(b)))
    return invalid("half axes: got {:g} and {:g} mm, expected above 0", a, b);
  if (!(exponent >= 1 && exponent <= 100))
    return invalid("the superellipse's exponent: got {:g}, expected 1 to 100", exponent);
  // powers of half axes that are far from 1 mm are not numbers
  constexpr double largest_power = 100;
  const double power = exponent * std::max(std::abs(std::log10(a)), std::abs(std::log10(b)));
  const auto at = [a, b, n = exponent, scaled = power > largest_power](double t) {
    const double cosine = std::cos(t), sine = std::sin(t);
    const double u = std::abs(cosine / a), v = std::abs(sine / b);
    const double size = scaled ? std::max(u, v) : 1;
    const double p = std::pow(u / size, n), q = std::pow(v / size, n);
    // r = (p + q)^(-1/n) / size, and dp/dt = -n p tan t, dq/dt = n q cot t
    const double r = std::pow(p + q, -1 / n) / size;
    const double dp = p == 0 ? 0 : -p * sine / cosine, dq = q == 0 ? 0 : q * cosine / sine;
    const double dr = -r * (dp + dq) / (p + q);
    return Point{Vector2d(r * cosine, r * sine),
                 Vector2d(dr * cosine - r * sine, dr * sine + r * cosine)};
  };
  return make(at, {0, M_PI_2, M_PI, 3 * M_PI_2, 2 * M_PI});
}

Result<ClosedCurve> ClosedCurve::polygon(const Eigen::Matrix2Xd& given) {
  TRY(points, cleaned(given));
  const Eigen::Index n = points->cols();
  const auto at = [points = *points, n](double t) {
    const Eigen::Index k = std::clamp<Eigen::Index>(static_cast<Eigen::Index>(t), 0, n - 1);
    const Vector2d a = points.col(k), edge = points.col((k + 1) % n) - a;
    return Point{a + (t - static_cast<double>(k)) * edge, edge};
  };
  std::vector<double> breaks;
  for (Eigen::Index k = 0; k <= n; ++k) breaks.push_back(static_cast<double>(k));
  return make(at, breaks);
}

Result<ClosedCurve> ClosedCurve::spline(const Eigen::Matrix2Xd& given) {
  TRY(points, cleaned(given));
  // the influence of a spline's end falls by a factor 0.27 per knot: 40 knots away the spline
  // through the points repeated around is periodic to round-off
  constexpr Eigen::Index around = 40;
  const Eigen::Index n = points->cols();
  Eigen::Matrix2Xd wound(2, n + 2 * around + 1);
  for (Eigen::Index k = 0; k < wound.cols(); ++k)
    wound.col(k) = points->col((k - around % n + n) % n);
  TRY(spline, SplineCurve::through(wound));
  const auto curve = std::make_shared<const SplineCurve>(*spline);
  const double start = curve->knots()[around];
  const auto at = [curve, start](double t) {
    const SplineCurve::Point p = curve->at(start + t);
    return Point{p.position, p.first};
  };
  std::vector<double> breaks;
  for (Eigen::Index k = 0; k <= n; ++k) breaks.push_back(curve->knots()[around + k] - start);
  return make(at, breaks);
}

std::vector<double> ClosedCurve::samples() const {
  const std::size_t pieces = breaks_.size() - 1,
                    each = std::clamp<std::size_t>(256 / pieces, 4, 64);
  std::vector<double> t;
  for (std::size_t k = 0; k < pieces; ++k)
    for (std::size_t n = 0; n < each; ++n)
      t.push_back(breaks_[k] + (breaks_[k + 1] - breaks_[k]) * static_cast<double>(n) / each);
  t.push_back(last());
  return t;
}

double ClosedCurve::at_arc_length(double s) const {
  const double around = std::fmod(s, length());
  return length_->inverse(around < 0 ? around + length() : around);
}

std::vector<double> ClosedCurve::crossings(int axis, double c) const {
  const auto g = [&](double t) {
    const Point p = at_(t);
    return Vector2d(p.position[axis] - c, p.first[axis]);
  };
  const auto above = [&](double t) { return g(t)[0] >= 0; };
  const std::vector<double> t = samples();
  std::vector<double> found;
  for (std::size_t k = 0; k + 1 < t.size(); ++k) {
    // the last piece ends exactly at the start of the first
    const bool first = above(t[k]), last = above(k + 2 == t.size() ? t[0] : t[k + 1]);
    double low = t[k], high = t[k + 1];
    if (first != last) {
      found.push_back(root(g, low, high));
      continue;
    }
    if (!(g(low)[1] * g(high)[1] < 0)) continue;
    // the slope changes sign in between: the curve may cross the line twice
    const bool falling = g(low)[1] < 0;
    for (int halving = 0; halving < 60; ++halving) {
      const double middle = (low + high) / 2;
      ((g(middle)[1] < 0) == falling ? low : high) = middle;
    }
    if (above(low) == first) continue;
    found.push_back(root(g, t[k], low));
    found.push_back(root(g, low, t[k + 1]));
  }
  return found;
}

double ClosedCurve::nearest(const Vector2d& point) const {
  const std::vector<double> t = samples();
  const auto distance = [&](double at) { return (at_(at).position - point).squaredNorm(); };
  std::size_t best = 0;
  for (std::size_t k = 1; k + 1 < t.size(); ++k)
    if (distance(t[k]) < distance(t[best])) best = k;
  // golden-section search on either side of the nearest sample, corners being samples
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  double found = t[best];
  const std::size_t before = best == 0 ? t.size() - 2 : best - 1;
  for (const auto& [from, to] :
       {std::pair(t[before], best == 0 ? last() : t[best]), std::pair(t[best], t[best + 1])}) {
    double low = from, high = to;
    for (int step = 0; step < 90; ++step) {
      const double a = high - ratio * (high - low), b = low + ratio * (high - low);
      (distance(a) < distance(b) ? high : low) = distance(a) < distance(b) ? b : a;
    }
    // squared distances are flat at their minimum: one Newton step on their slope
    double at = (low + high) / 2;
    const Point p = at_(at);
    at = std::clamp(at - (p.position - point).dot(p.first) / p.first.squaredNorm(), from, to);
    if (distance(at) <= distance(found)) found = at;
  }
  return found;
}

Result<BoundaryMap> BoundaryMap::make(ClosedCurve original, ClosedCurve actuated,
                                      Correspondence how) {
  TRY_DO(check_star(original, "original", how));
  TRY_DO(check_star(actuated, "actuated", how));
  BoundaryMap map;
  map.start_original_ = original.arc_length(on_ray(original, 0).front());
  map.start_actuated_ = actuated.arc_length(on_ray(actuated, 0).front());
  map.original_ = std::move(original);
  map.actuated_ = std::move(actuated);
  map.how_ = how;
  return map;
}

Vector2d BoundaryMap::operator()(const Vector2d& on_original) const {
  if (how_ == Correspondence::angle) {
    const auto t = on_ray(actuated_, std::atan2(on_original.y(), on_original.x()));
    return actuated_.at(t.front()).position;
  }
  const double s = original_.arc_length(original_.nearest(on_original)) - start_original_;
  const double t =
      actuated_.at_arc_length(start_actuated_ + s * actuated_.length() / original_.length());
  return actuated_.at(t).position;
}

std::vector<int> hull_of(const Eigen::Matrix2Xd& points) {
  std::vector<int> order(std::size_t(points.cols()));
  std::iota(order.begin(), order.end(), 0);
  const auto coordinates = [&](int k) { return std::pair(points(0, k), points(1, k)); };
  std::ranges::sort(order, {}, coordinates);
  // the lower side from left to right, then the upper one back [Andrew 1979]
  std::vector<int> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const int k : order) {
      while (hull.size() >= first + 2 &&
             cross(points.col(hull.back()) - points.col(hull[hull.size() - 2]),
                   points.col(k) - points.col(hull.back())) <= 0)
        hull.pop_back();
      hull.push_back(k);
    }
    hull.pop_back();
    std::ranges::reverse(order);
  }
  return hull;
}

std::vector<int> rim_of(const Eigen::Matrix2Xd& points) {
  constexpr double on_an_edge = 1e-6;  // distance from an edge, over its length
  const std::vector<int> corners = hull_of(points);
  std::vector<int> rim;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d first = points.col(corners[k]),
                          edge = points.col(corners[(k + 1) % corners.size()]) - first;
    std::map<double, int> on_edge;  // points by their position along the edge
    for (int point = 0; point < int(points.cols()); ++point) {
      const Eigen::Vector2d at = points.col(point) - first;
      const double along = at.dot(edge) / edge.squaredNorm();
      const bool on_it = std::abs(cross(edge, at)) < on_an_edge * edge.squaredNorm();
      if (on_it && along > on_an_edge && along < 1 - on_an_edge) on_edge.try_emplace(along, point);
    }
    rim.push_back(corners[k]);
    double last = 0;
    for (const auto& [along, point] : on_edge)
      if (along - std::exchange(last, along) > on_an_edge) rim.push_back(point);
  }
  return rim;
}

}  // namespace gridshell
