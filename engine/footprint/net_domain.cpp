#include "engine/footprint/net_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/root.h"

namespace gridshell {
namespace {

/// {u, v} |-> C(u, v) above a plane, by symmetry seen from u, v >= 0
class Cap final : public Domain {
 public:
  Cap(const SphereNet& net, double cut_height)
      : net_(net),
        height_(cut_height * net.radius()),
        reach_(net.radius() * std::acos(cut_height)) {}

  std::vector<Interval> intervals(Family, double c) const override {
    // both families alike: the net is symmetric in u and v
    if (std::abs(c) >= reach_) return {};
    const double guess = std::sqrt((reach_ - c) * (reach_ + c));
    const double half = crossing(Eigen::Vector2d(0, std::abs(c)), Eigen::Vector2d(1, 0), guess);
    return {{-half, half}};
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    return ring_about_origin(points, [this](const Eigen::Vector2d& direction) {
      return crossing(Eigen::Vector2d::Zero(), direction, reach_);
    });
  }

  double reach() const override { return reach_; }

 private:
  /// distance from `start`, which is above the plane, along `direction` to the plane
  double crossing(const Eigen::Vector2d& start, const Eigen::Vector2d& direction,
                  double guess) const {
    // depth below the plane and its slope; beyond a fold counts as below
    const auto look = [&](double at) -> Eigen::Vector2d {
      const Eigen::Vector2d uv = start + at * direction;
      const auto point = net_.at(uv[0], uv[1]);
      if (!point) return {1, 0};
      const Eigen::Vector3d along =
          direction[0] * point->tangent_u + direction[1] * point->tangent_v;
      return {height_ - point->position.z(), -along.z()};
    };
    double high = guess;
    while (look(high)[0] < 0) high *= 1.05;
    return bracketed_root(look, 0, high, high, 1e-15 * net_.radius());
  }

  SphereNet net_;
  double height_, reach_;
};

/// A rectangle: first <= n.(u, v) <= last for two orthogonal normals n.
class Rectangle final : public Domain {
 public:
  struct Side {
    Eigen::Vector2d normal;
    double first, last;
  };
  explicit Rectangle(const std::array<Side, 2>& sides) : sides_(sides) {}

  std::vector<Interval> intervals(Family family, double c) const override {
    const int along = family == Family::u ? 0 : 1;
    double begin = -INFINITY, end = INFINITY;
    for (const Side& side : sides_) {
      const double slope = side.normal[along], rest = side.normal[1 - along] * c;
      if (slope == 0) {
        if (rest < side.first || rest > side.last) return {};
        continue;
      }
      const double a = (side.first - rest) / slope, b = (side.last - rest) / slope;
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (!(begin < end)) return {};
    return {{begin, end}};
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    // points shared out among the sides by length, each side from its first corner on
    const std::array<Eigen::Vector2d, 4> corners = this->corners();
    std::array<int, 5> first{};
    double perimeter = 0, so_far = 0;
    for (int k = 0; k < 4; ++k) perimeter += (corners[(k + 1) % 4] - corners[k]).norm();
    for (int k = 0; k < 4; ++k) {
      so_far += (corners[(k + 1) % 4] - corners[k]).norm();
      first[k + 1] =
          std::max(first[k] + 1, static_cast<int>(std::lround(points * so_far / perimeter)));
    }
    first[4] = points;
    Eigen::Matrix2Xd ring(2, points);
    for (int k = 0; k < 4; ++k)
      for (int n = first[k]; n < first[k + 1]; ++n)
        ring.col(n) = corners[k] + (corners[(k + 1) % 4] - corners[k]) * (n - first[k]) /
                                       (first[k + 1] - first[k]);
    return ring;
  }

  double reach() const override {
    double reach = 0;
    for (const Eigen::Vector2d& corner : corners())
      reach = std::max(reach, corner.lpNorm<Eigen::Infinity>());
    return reach;
  }

 private:
  std::array<Eigen::Vector2d, 4> corners() const {
    const auto corner = [&](double a, double b) -> Eigen::Vector2d {
      return a * sides_[0].normal / sides_[0].normal.squaredNorm() +
             b * sides_[1].normal / sides_[1].normal.squaredNorm();
    };
    const Side &a = sides_[0], &b = sides_[1];
    return {corner(a.first, b.first), corner(a.last, b.first), corner(a.last, b.last),
            corner(a.first, b.last)};
  }

  std::array<Side, 2> sides_;
};

/// first <= u + v <= last, half a turn around
std::unique_ptr<Domain> half_between(const RevolutionNet& net, double first, double last) {
  const double quarter_turn = M_PI_2 / net.c();
  return std::make_unique<Rectangle>(
      std::array<Rectangle::Side, 2>{{{Eigen::Vector2d(1, 1), first, last},
                                      {Eigen::Vector2d(-1, 1), -quarter_turn, quarter_turn}}});
}

}  // namespace

Result<std::unique_ptr<Domain>> cap_of(const SphereNet& net, double cut_height) {
  if (!(cut_height >= 0 && cut_height < 1))
    return fail(Fault::bad_input,
                fmt::format("the cap's cut height is {:g} of the radius, it must lie in [0, 1)",
                            cut_height));
  return std::make_unique<Cap>(net, cut_height);
}

Result<std::unique_ptr<Domain>> half_of(const RevolutionNet& net, double length) {
  if (!(length > 0))
    return fail(Fault::bad_input,
                fmt::format("the length is {:g} mm, it must be positive", length));
  const auto first = net.x_at_axial(-length / 2), last = net.x_at_axial(length / 2);
  for (const auto* end : {&first, &last})
    if (!*end) return tl::unexpected(end->error());
  return half_between(net, *first, *last);
}

std::unique_ptr<Domain> half_of_all(const RevolutionNet& net) {
  return half_between(net, net.first_x(), net.last_x());
}

std::unique_ptr<Domain> all_of(const TranslationNet& net) {
  return std::make_unique<Rectangle>(
      std::array<Rectangle::Side, 2>{{{Eigen::Vector2d(1, 0), -net.half_u(), net.half_u()},
                                      {Eigen::Vector2d(0, 1), -net.half_v(), net.half_v()}}});
}

}  // namespace gridshell
