#include "engine/study/scan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "engine/core/dense.h"
#include "engine/core/proximity.h"

namespace gridshell::study {

Eigen::Matrix3Xd Pose::of(const Eigen::Matrix3Xd& points) const {
  return (turn * points).colwise() + shift;
}

namespace {

constexpr int most_triples = 80, least_points = 4;
constexpr Eigen::Index most_tried =
    1500;  // positions tried for a triple; of more, that many are drawn
constexpr std::size_t most_pairs = 4000;  // number of pairs at one distance that are tried
constexpr int looked_at = 24;             // points tested before all others are
constexpr double least_agreeing = 0.35;   // fraction of them that must agree
constexpr double enough =
    0.9;  // fraction of the positions or points at which no further triple is drawn
constexpr double as_good = 0.8;  // fraction of the best pose's count that is worth refining
constexpr std::size_t most_refined = 16;
constexpr double other_pose = 0.1;                          // rad
constexpr double shortest_side = 0.2, least_height = 0.15;  // of a triple, over the shape's extent
constexpr int most_turns = 60;

double distance(const Eigen::Matrix3Xd& points, int a, int b) {
  return (points.col(a) - points.col(b)).norm();
}

double extent_of(const Eigen::Matrix3Xd& points) {
  return (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
}

/// The rotation and shift that bring `from` nearest to `to`.
Pose fit(const Eigen::Matrix3Xd& from, const Eigen::Matrix3Xd& to) {
  const Eigen::Vector3d a = from.rowwise().mean(), b = to.rowwise().mean();
  const Eigen::Matrix3d turn = best_turn(from.colwise() - a, to.colwise() - b, false);
  return {turn, b - turn * a};
}

/// The positions of a shape, found by a grid of cells.
class PositionGrid {
 public:
  PositionGrid(const Eigen::Matrix3Xd& positions, double within)
      : positions_(positions), within_(within), grid_(2 * within) {
    for (int k = 0; k < int(positions.cols()); ++k) {
      const Eigen::Vector3d p = positions.col(k), around = Eigen::Vector3d::Constant(within);
      grid_.add(k, {p - around, p + around}, std::numeric_limits<std::size_t>::max());
    }
  }

  /// Calls visit(index, distance) for every position within the given length of p.
  void near(const Eigen::Vector3d& p, auto visit) const {
    const std::vector<int>* few = grid_.at(p);
    if (!few) return;
    for (const int k : *few)
      if (const double off = (positions_.col(k) - p).norm(); off <= within_) visit(k, off);
  }
  bool any(const Eigen::Vector3d& p) const {
    bool found = false;
    near(p, [&](int, double) { found = true; });
    return found;
  }

 private:
  const Eigen::Matrix3Xd& positions_;
  double within_;
  BoxGrid grid_;
};

/// Two positions and their distance.
struct PositionPair {
  double apart = 0;
  int i = 0, j = 0;
};

struct Guess {
  Pose pose;
  int agreeing = 0;
};

/// Draws triples of points and collects the poses in which most points agree with positions.
class Search {
 public:
  Search(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& positions, double bar)
      : points_(points),
        positions_(positions),
        bar_(bar),
        near_(positions, bar),
        size_(extent_of(positions)) {
    tried_.resize(std::size_t(positions.cols()));
    std::iota(tried_.begin(), tried_.end(), 0);
    if (positions.cols() > most_tried) {
      std::shuffle(tried_.begin(), tried_.end(), draw_);
      tried_.resize(most_tried);
    }
    for (const int i : tried_)
      for (const int j : tried_)
        if (j < i) pairs_.push_back({distance(positions, i, j), i, j});
    std::ranges::sort(pairs_, {}, &PositionPair::apart);
    order_.resize(std::size_t(points.cols()));
    std::iota(order_.begin(), order_.end(), 0);
    std::shuffle(order_.begin(), order_.end(), draw_);
  }

  std::vector<Guess> guesses() {
    const auto all = int(std::min(points_.cols(), positions_.cols()));
    for (int k = 0; k < most_triples && best_ < enough * all; ++k) {
      // every other triple is tried with a tight tolerance, which is faster
      within_ = k % 2 == 0 ? bar_ / 3 : bar_;
      if (const auto triple = drawn()) try_all(*triple);
    }
    std::ranges::stable_sort(guesses_, std::ranges::greater{}, &Guess::agreeing);
    return apart_from_one_another();
  }

 private:
  using Triple = std::array<int, 3>;

  int random_point() { return int(draw_() % std::uint64_t(points_.cols())); }

  /// Three points that could be on the shape and determine a pose.
  std::optional<Triple> drawn() {
    for (int k = 0; k < 1000; ++k) {
      const Triple t{random_point(), random_point(), random_point()};
      const Eigen::Vector3d ab = points_.col(t[1]) - points_.col(t[0]),
                            ac = points_.col(t[2]) - points_.col(t[0]);
      const double sides[] = {ab.norm(), ac.norm(), (ab - ac).norm()};
      const auto [least, most] = std::ranges::minmax(sides);
      if (least < shortest_side * size_ || most > size_) continue;
      if (ab.cross(ac).norm() >= least_height * size_ * ab.norm()) return t;
    }
    return std::nullopt;
  }

  void try_all(const Triple& t) {
    const double ab = distance(points_, t[0], t[1]), ac = distance(points_, t[0], t[2]),
                 bc = distance(points_, t[1], t[2]);
    const auto first = std::ranges::lower_bound(pairs_, ab - within_, {}, &PositionPair::apart),
               last = std::ranges::upper_bound(pairs_, ab + within_, {}, &PositionPair::apart);
    const auto step = std::max<std::ptrdiff_t>(1, (last - first) / std::ptrdiff_t(most_pairs));
    for (auto at = first; last - at > 0; at += std::min(step, last - at))
      for (const auto& [i, j] : {std::pair(at->i, at->j), std::pair(at->j, at->i)})
        for (const int k : tried_)
          if (std::abs(distance(positions_, i, k) - ac) < within_ &&
              std::abs(distance(positions_, j, k) - bc) < within_)
            try_pose(t, {i, j, k});
  }

  void try_pose(const Triple& t, const Triple& on) {
    Eigen::Matrix3Xd from(3, 3), to(3, 3);
    for (int k = 0; k < 3; ++k) {
      from.col(k) = points_.col(t[std::size_t(k)]);
      to.col(k) = positions_.col(on[std::size_t(k)]);
    }
    const Pose pose = fit(from, to);
    const auto agrees = [&](int k) { return near_.any(pose.turn * points_.col(k) + pose.shift); };
    const auto few = order_.begin() + std::min<std::ptrdiff_t>(looked_at, std::ssize(order_));
    int agreeing = int(std::count_if(order_.begin(), few, agrees));
    if (agreeing < least_agreeing * double(few - order_.begin())) return;
    agreeing += int(std::count_if(few, order_.end(), agrees));
    if (agreeing < as_good * best_) return;
    best_ = std::max(best_, agreeing);
    guesses_.push_back({pose, agreeing});
  }

  std::vector<Guess> apart_from_one_another() const {
    std::vector<Guess> kept;
    for (const Guess& guess : guesses_) {
      if (kept.size() == most_refined || guess.agreeing < as_good * best_) break;
      const auto same = [&](const Guess& other) {
        const Eigen::Matrix3d between = guess.pose.turn.transpose() * other.pose.turn;
        return std::abs(Eigen::AngleAxisd(between).angle()) < other_pose &&
               (guess.pose.shift - other.pose.shift).norm() < other_pose * size_;
      };
      if (std::ranges::none_of(kept, same)) kept.push_back(guess);
    }
    return kept;
  }

  const Eigen::Matrix3Xd &points_, &positions_;
  double bar_, within_ = 0;
  PositionGrid near_;
  double size_;
  std::vector<int> tried_;  // positions to which triples are mapped
  std::vector<PositionPair> pairs_;
  std::vector<int> order_;
  std::mt19937_64 draw_{1};
  std::vector<Guess> guesses_;
  int best_ = 0;
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + std::ssize(values) / 2;
  std::ranges::nth_element(values, middle);
  return *middle;
}

/// Assigns points to positions, the nearest pairs first, none further than `most`.
void assign(const Eigen::Matrix3Xd& moved, const PositionGrid& near, double most,
            Registration& found) {
  struct Near {
    double off;
    int position, point;
  };
  std::vector<Near> all;
  for (int point = 0; point < int(moved.cols()); ++point)
    near.near(moved.col(point), [&](int position, double off) {
      if (off <= most) all.push_back({off, position, point});
    });
  std::ranges::stable_sort(all, {}, &Near::off);
  std::vector<char> taken(std::size_t(moved.cols()), 0);
  std::ranges::fill(found.point_of, -1);
  found.distance.setConstant(std::nan(""));
  found.found = 0;
  for (const Near& one : all) {
    if (taken[std::size_t(one.point)] || found.point_of[std::size_t(one.position)] >= 0) continue;
    taken[std::size_t(one.point)] = 1;
    found.point_of[std::size_t(one.position)] = one.point;
    found.distance[one.position] = one.off;
    ++found.found;
  }
}

Pose fit_found(const Registration& found, const Eigen::Matrix3Xd& points,
               const Eigen::Matrix3Xd& positions) {
  Eigen::Matrix3Xd from(3, found.found), to(3, found.found);
  Eigen::Index k = 0;
  for (Eigen::Index position = 0; position < positions.cols(); ++position) {
    const int point = found.point_of[std::size_t(position)];
    if (point < 0) continue;
    from.col(k) = points.col(point);
    to.col(k++) = positions.col(position);
  }
  return fit(from, to);
}

std::optional<Registration> refined(const Pose& guess, const Eigen::Matrix3Xd& points,
                                    const Eigen::Matrix3Xd& positions, const PositionGrid& near,
                                    const RegistrationOptions& options) {
  Registration found;
  found.pose = guess;
  found.point_of.assign(std::size_t(positions.cols()), -1);
  found.distance.resize(positions.cols());
  double gate = options.reach;
  for (int turn = 0; turn < most_turns; ++turn) {
    const auto before = found.point_of;
    assign(found.pose.of(points), near, gate, found);
    if (found.found < least_points) return std::nullopt;
    if (turn > 0 && before == found.point_of) break;
    found.pose = fit_found(found, points, positions);
    std::vector<double> off;
    for (const double one : found.distance)
      if (!std::isnan(one)) off.push_back(one);
    gate = std::clamp(5 * median(off), options.nearest, options.reach);
  }
  // the assignment that belongs to the last fit
  assign(found.pose.of(points), near, gate, found);
  if (found.found < least_points) return std::nullopt;
  for (const double one : found.distance) {
    const double off = std::isnan(one) ? options.bar : std::min(one, options.bar);
    found.cost += off * off;
  }
  return found;
}

}  // namespace

std::optional<Registration> register_points(const Eigen::Matrix3Xd& points,
                                            const Eigen::Matrix3Xd& positions,
                                            const RegistrationOptions& options) {
  if (points.cols() < least_points || positions.cols() < least_points) return std::nullopt;
  if (!points.allFinite() || !positions.allFinite() || !(extent_of(positions) > 0))
    return std::nullopt;
  const PositionGrid near(positions, options.reach);
  std::optional<Registration> best;
  for (const Guess& guess : Search(points, positions, options.bar).guesses()) {
    auto found = refined(guess.pose, points, positions, near, options);
    if (found && (!best || found->cost < best->cost)) best = std::move(found);
  }
  return best;
}

}  // namespace gridshell::study
