#include "engine/footprint/surface_domain.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "engine/geometry/root.h"

namespace gridshell {
namespace {

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
    bool before = false;
    for (int k = -reach_ - 1; k <= reach_ + 1; ++k) {
      const bool here = holds(line.at(k * step()));
      if (here && !before) pieces.push_back({crossing(line, k, -1), 0});
      if (before && !here) pieces.back().end = crossing(line, k - 1, 1);
      before = here;
    }
    return pieces;
  }

  Eigen::Matrix2Xd boundary(int points) const override {
    Eigen::Matrix2Xd ring(2, points);
    for (int k = 0; k < points; ++k) {
      const Line ray = ray_at(2 * M_PI * k / points);
      int last = 0;
      while (holds(ray.at((last + 1) * step()))) ++last;
      ring.col(k) = ray.at(crossing(ray, last, 1));
    }
    return ring;
  }

  double reach() const override { return (reach_ + 1) * step(); }

  /// How often the ray in this direction leaves the part.
  int exits(double angle) const {
    const Line ray = ray_at(angle);
    int found = 0;
    bool before = true;
    // rays run along the diagonal too
    for (int k = 1; k <= 2 * reach_ + 2; ++k) {
      const bool here = holds(ray.at(k * step()));
      found += int(before && !here);
      before = here;
    }
    return found;
  }

 private:
  struct Line {
    Eigen::Vector2d begin, way;
    Eigen::Vector2d at(double s) const { return begin + s * way; }
  };
  static Line ray_at(double angle) {
    return {Eigen::Vector2d::Zero(), Eigen::Vector2d(std::cos(angle), std::sin(angle))};
  }
  double step() const { return net_->chord(); }

  /// Above zero outside, also where there is no net.
  double outside(const Eigen::Vector2d& uv) const {
    const auto point = net_->at(uv.x(), uv.y());
    const double value = point ? outside_(point->position) : 1;
    return std::isnan(value) ? 1 : value;
  }

  /// Whether a point is inside, beside a node that is.
  bool holds(const Eigen::Vector2d& uv) const {
    const int i = int(std::lround(uv.x() / step())), j = int(std::lround(uv.y() / step()));
    bool beside = false;
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a) beside = beside || net_->inside(i + a, j + b);
    return beside && outside(uv) < 0;
  }

  /// Where a line leaves the part between its sample k, which is inside, and the next one on that
  /// side.
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
  int reach_ = 0;  // nodes
};

}  // namespace

Result<std::unique_ptr<Domain>> part_of(std::shared_ptr<const SurfaceNet> net,
                                        Surface::Function outside) {
  constexpr int rays = 360;
  auto part = std::make_unique<Part>(std::move(net), std::move(outside));
  for (int k = 0; k < rays; ++k)
    if (part->exits(2 * M_PI * k / rays) != 1)
      return fail(Fault::bad_input,
                  fmt::format("the boundary is crossed more than once on the way from the apex "
                              "outwards, at {} degrees from the first rod: it must be seen from "
                              "there as a whole",
                              k));
  return part;
}

}  // namespace gridshell
