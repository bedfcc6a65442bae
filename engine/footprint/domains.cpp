#include "engine/footprint/domains.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/geometry/calculus.h"

namespace gridshell {

CurveDomain::CurveDomain(ClosedCurve curve) : curve_(std::move(curve)) {
  constexpr int samples = 4096;
  for (int k = 0; k < samples; ++k)
    reach_ =
        std::max(reach_, curve_.at(curve_.last() * k / samples).position.lpNorm<Eigen::Infinity>());
  for (const double t : curve_.breaks())
    reach_ = std::max(reach_, curve_.at(t).position.lpNorm<Eigen::Infinity>());
  // between the samples a smooth curve may reach a little further
  reach_ *= 1 + 1e-5;
}

std::vector<Interval> CurveDomain::intervals(Family family, double c) const {
  const int along = family == Family::u ? 0 : 1;
  std::vector<double> cuts;
  for (const double t : curve_.crossings(1 - along, c))
    cuts.push_back(curve_.at(t).position[along]);
  std::ranges::sort(cuts);
  std::vector<Interval> pieces;
  for (std::size_t k = 0; k + 1 < cuts.size(); k += 2)
    if (cuts[k] < cuts[k + 1]) pieces.push_back({cuts[k], cuts[k + 1]});
  return pieces;
}

Eigen::Matrix2Xd CurveDomain::boundary(int points) const {
  const std::vector<double>& breaks = curve_.breaks();
  const auto pieces = static_cast<int>(breaks.size()) - 1;
  Eigen::Matrix2Xd ring(2, points);
  if (points < pieces) {
    for (int k = 0; k < points; ++k)
      ring.col(k) = curve_.at(curve_.at_arc_length(curve_.length() * k / points)).position;
    return ring;
  }
  // the points are distributed over the pieces by length; each piece has its first corner
  int first = 0;
  for (int k = 0; k < pieces; ++k) {
    const double from = curve_.arc_length(breaks[k]), to = curve_.arc_length(breaks[k + 1]);
    const auto nearest = static_cast<int>(points * to / curve_.length() + 0.5);
    const int end =
        k + 1 == pieces ? points : std::clamp(nearest, first + 1, points - (pieces - k - 1));
    for (int n = first; n < end; ++n)
      ring.col(n) =
          curve_.at(curve_.at_arc_length(from + (to - from) * (n - first) / (end - first)))
              .position;
    first = end;
  }
  return ring;
}

namespace {

/// The part of Chebyshev's net of a sphere above a plane z = const; symmetric in u and v.
class Cap final : public Domain {
 public:
  Cap(const SphereNet& net, double cut_height)
      : net_(net),
        height_(cut_height * net.radius()),
        reach_(net.radius() * std::acos(cut_height)) {}

  std::vector<Interval> intervals(Family, double c) const override {
    // one formula for both families: the net is symmetric in u and v
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
  /// Distance from `start`, which is above the plane, along `direction` to the plane.
  double crossing(const Eigen::Vector2d& start, const Eigen::Vector2d& direction,
                  double guess) const {
    // depth below the plane and its slope; points past a fold count as below
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
      const double slope = side.normal[along], offset = side.normal[1 - along] * c;
      if (slope == 0) {
        if (offset < side.first || offset > side.last) return {};
        continue;
      }
      const double a = (side.first - offset) / slope, b = (side.last - offset) / slope;
      begin = std::max(begin, std::min(a, b));
      end = std::min(end, std::max(a, b));
    }
    if (!(begin < end)) return {};
    return {{begin, end}};
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    // the points are distributed over the sides by length, each side with its first corner
    const std::array<Eigen::Vector2d, 4> corners = this->corners();
    std::array<int, 5> first{};
    double perimeter = 0, so_far = 0;
    for (int k = 0; k < 4; ++k) perimeter += (corners[(k + 1) % 4] - corners[k]).norm();
    for (int k = 0; k < 4; ++k) {
      so_far += (corners[(k + 1) % 4] - corners[k]).norm();
      first[k + 1] = std::clamp(static_cast<int>(std::lround(points * so_far / perimeter)),
                                first[k] + 1, std::max(first[k] + 1, points - 3 + k));
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

/// The rectangle first <= u + v <= last that covers half a turn about the axis.
std::unique_ptr<Domain> half_between(const RevolutionNet& net, double first, double last) {
  const double quarter_turn = M_PI_2 / net.c();
  return std::make_unique<Rectangle>(
      std::array<Rectangle::Side, 2>{{{Eigen::Vector2d(1, 1), first, last},
                                      {Eigen::Vector2d(-1, 1), -quarter_turn, quarter_turn}}});
}

/// The part of a net on a surface, around its apex, where a function of space is below zero.
class Part final : public Domain {
 public:
  Part(std::shared_ptr<const SurfaceNet> net, Surface::Function outside)
      : net_(std::move(net)), outside_(std::move(outside)) {
    for (int j = net_->first_v(); j <= net_->last_v(); ++j)
      for (int i = net_->first_u(); i <= net_->last_u(); ++i)
        if (net_->inside(i, j)) reach_ = std::max({reach_, std::abs(i), std::abs(j)});
  }

  std::vector<Interval> intervals(Family family, double c) const override {
    const bool along_u = family == Family::u;
    const Line line{along_u ? Eigen::Vector2d(0, c) : Eigen::Vector2d(c, 0),
                    along_u ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1)};
    std::vector<Interval> pieces;
    bool was_inside = false;
    // points up to one step past the last node that is inside may be inside
    for (int k = -reach_ - 2; k <= reach_ + 2; ++k) {
      const bool inside = contains(line.at(k * step()));
      if (inside && !was_inside) pieces.push_back({crossing(line, k, -1), 0});
      if (was_inside && !inside) pieces.back().end = crossing(line, k - 1, 1);
      was_inside = inside;
    }
    return pieces;
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    Eigen::Matrix2Xd ring(2, points);
    for (int k = 0; k < points; ++k) {
      const Line ray = ray_at(2 * M_PI * k / points);
      int last = 0;
      while (contains(ray.at((last + 1) * step()))) ++last;
      ring.col(k) = ray.at(crossing(ray, last, 1));
    }
    return ring;
  }

  double reach() const override { return (reach_ + 1) * step(); }

  /// How often the ray in this direction leaves the part.
  int exits(double angle) const {
    const Line ray = ray_at(angle);
    int found = 0;
    bool was_inside = true;
    // twice as far as along an axis: a ray may run along the diagonal
    for (int k = 1; k <= 2 * reach_ + 2; ++k) {
      const bool inside = contains(ray.at(k * step()));
      found += int(was_inside && !inside);
      was_inside = inside;
    }
    return found;
  }

 private:
  struct Line {
    Eigen::Vector2d begin, direction;
    Eigen::Vector2d at(double s) const { return begin + s * direction; }
  };
  static Line ray_at(double angle) {
    return {Eigen::Vector2d::Zero(), Eigen::Vector2d(std::cos(angle), std::sin(angle))};
  }
  double step() const { return net_->chord(); }

  /// Value of the function that is above zero outside; 1 if the net does not reach the point.
  double outside(const Eigen::Vector2d& uv) const {
    const auto point = net_->at(uv.x(), uv.y());
    const double value = point ? outside_(point->position) : 1;
    return std::isnan(value) ? 1 : value;
  }

  /// Whether a point is inside: the function is below zero, and a neighbouring node is inside.
  bool contains(const Eigen::Vector2d& uv) const {
    const int i = int(std::lround(uv.x() / step())), j = int(std::lround(uv.y() / step()));
    bool near_inside = false;
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a) near_inside = near_inside || net_->inside(i + a, j + b);
    return near_inside && outside(uv) < 0;
  }

  /// Position at which a line leaves the part, between its sample k, which is inside, and the
  /// sample k + side.
  double crossing(const Line& line, int k, int side) const {
    const double from = k * step(), h = 1e-4 * step();
    const auto look = [&](double s) -> Eigen::Vector2d {
      const auto value = [&](double t) { return outside(line.at(from + side * t)); };
      return {value(s), (value(s + h) - value(s - h)) / (2 * h)};
    };
    return from + side * bracketed_root(look, 0, step(), step() / 2, 1e-14 * reach());
  }

  std::shared_ptr<const SurfaceNet> net_;
  Surface::Function outside_;
  int reach_ = 0;  // largest |i| or |j| of a node inside
};

}  // namespace

Result<std::unique_ptr<Domain>> cap_of(const SphereNet& net, double cut_height) {
  if (!(cut_height >= 0 && cut_height < 1))
    return invalid("the cap's cut height: got {:g} of the radius, expected 0 to below 1",
                   cut_height);
  return std::make_unique<Cap>(net, cut_height);
}

Result<std::unique_ptr<Domain>> half_of(const RevolutionNet& net, double length) {
  if (!(length > 0)) return invalid("length: got {:g} mm, expected above 0", length);
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

Result<std::unique_ptr<Domain>> part_of(std::shared_ptr<const SurfaceNet> net,
                                        Surface::Function outside) {
  constexpr int rays = 360;
  auto part = std::make_unique<Part>(std::move(net), std::move(outside));
  for (int k = 0; k < rays; ++k)
    if (const int exits = part->exits(2 * M_PI * k / rays); exits != 1)
      return invalid(
          "the boundary: got {} crossings of the ray from the apex at {} degrees from the first "
          "rod, expected one: all of the boundary is visible from the apex",
          exits, k);
  return part;
}

}  // namespace gridshell
