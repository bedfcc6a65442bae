// The region of the flat (u, v) plane that an original boundary encloses, seen along grid lines.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <vector>

namespace gridshell {

/// Which of the two sets of parallel rods: a u-rod runs along u (v = const), a v-rod along v; or of
/// neither, in a network that is no square grid.
enum class Family { u, v, other };
/// "u", "v", or "rod ".
inline const char* name_of(Family family) {
  switch (family) {
    case Family::u:
      return "u";
    case Family::v:
      return "v";
    case Family::other:
      break;
  }
  return "rod ";
}

/// A piece of a grid line that lies inside the boundary: along the line, begin < end, mm.
struct Interval {
  double begin = 0, end = 0;
};

/// The inside of an original boundary. Grid lines are cut exactly where they meet it.
class Domain {
 public:
  virtual ~Domain() = default;
  /// Pieces of the line v = c (Family::u) or u = c (Family::v) inside the boundary, in order.
  virtual std::vector<Interval> intervals(Family family, double c) const = 0;
  /// The boundary as a closed polyline of `points` points (the last joins the first), 2 x points.
  virtual Eigen::Matrix2Xd boundary(int points) const = 0;
  /// Largest |u| or |v| reached, mm: grid lines beyond it need not be asked.
  virtual double reach() const = 0;
};

/// The points at radius_at(direction) along `points` directions, the first along +u.
template <class Radius>
Eigen::Matrix2Xd ring_about_origin(int points, Radius radius_at) {
  Eigen::Matrix2Xd ring(2, points);
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * M_PI * k / points;
    const Eigen::Vector2d direction(std::cos(angle), std::sin(angle));
    ring.col(k) = radius_at(direction) * direction;
  }
  return ring;
}

/// A disk of radius R_o about the origin.
class Disk final : public Domain {
 public:
  explicit Disk(double radius_mm) : radius_(radius_mm) {}
  std::vector<Interval> intervals(Family, double c) const override {
    if (std::abs(c) >= radius_) return {};
    const double half = std::sqrt((radius_ - c) * (radius_ + c));
    return {{-half, half}};
  }
  Eigen::Matrix2Xd boundary(int points) const override {
    return ring_about_origin(points, [this](const Eigen::Vector2d&) { return radius_; });
  }
  double reach() const override { return radius_; }

 private:
  double radius_;
};

}  // namespace gridshell
