#include "engine/study/mountain_pass.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/solve/equilibrium.h"

namespace gridshell {
namespace {

constexpr int first_steps = 6;    // steps of a new image before the next one is added
constexpr int first_climb = 4;    // rounds before the first search for a saddle
constexpr int climb_every = 4;    // rounds between two searches
constexpr int images = 16;        // number of states along the path, both ends included
constexpr int most_rounds = 500;  // in each round every state of the string takes one step
// perturbation of the first string, so that a symmetry of both ends does not constrain it
constexpr double noise_mm = 0.01;
constexpr double on_string = 2;     // largest distance of a saddle from the highest image, spacings
constexpr double over_softest = 4;  // least shift, over the lowest stiffness of the first state

class ElasticString {
 public:
  ElasticString(Linearisation& system, double step_mm, const Watch& watch)
      : system_(system), step_mm_(step_mm), watch_(watch) {}

  /// Adds images from both ends towards one another. Returns false if an image cannot take a step.
  bool grow(const State& a, const State& b) {
    least_shift_ = over_softest * softest_stiffness(a);
    spacing_ = (b.x - a.x).norm() / (images - 1);
    std::vector<Image> left{{a, system_.energy_at(a), 0}}, right{{b, system_.energy_at(b), 0}};
    const Eigen::Matrix3Xd noise = noise_mm * generic_direction(a.x.cols());
    for (int k = 0; k < 4 * images && !watch_.cancelled(); ++k) {
      auto& from = k % 2 == 0 ? left : right;
      const State& tip = from.back().state;
      const Eigen::Matrix3Xd ahead = (k % 2 == 0 ? right : left).back().state.x - tip.x;
      const double gap = ahead.norm();
      if (!(gap > 1.5 * spacing_)) break;
      Image next{tip, 0, 0};
      Eigen::Matrix3Xd step = spacing_ / gap * ahead + noise;
      clear_fixed(system_.model(), step);
      move_to(system_.model(), tip.x + step, next.state);
      for (int n = 0; n < first_steps; ++n)
        if (!go_down(next, ahead / gap)) return false;
      from.push_back(std::move(next));
    }
    images_ = std::move(left);
    std::move(right.rbegin(), right.rend(), std::back_inserter(images_));
    even_out();
    return true;
  }

  /// Every image takes a step down perpendicular to the string. Returns false if one cannot.
  bool go_down_all() {
    const std::vector<Image> before = images_;
    for (std::size_t k = 1; k + 1 < images_.size(); ++k) {
      Eigen::Matrix3Xd along = before[k + 1].state.x - before[k - 1].state.x;
      along /= along.norm();
      if (!go_down(images_[k], along)) return false;
    }
    highest_ =
        std::size_t(std::ranges::max_element(images_, {}, &Image::energy_mJ) - images_.begin());
    return true;
  }

  /// The saddle that Newton's method finds from the highest image.
  std::optional<MountainPass> climb() {
    if (highest_ == 0 || highest_ + 1 == images_.size()) return std::nullopt;
    MountainPass pass;
    pass.saddle = images_[highest_].state;
    NewtonOptions options;
    options.tolerance_mm = 1e-8;
    options.farthest_mm = 4 * step_mm_;
    if (newton(system_, pass.saddle, options, watch_).outcome != Outcome::reached)
      return std::nullopt;
    const double away = (pass.saddle.x - images_[highest_].state.x).norm();
    if (away > on_string * spacing_) return std::nullopt;
    const Inertia inertia = system_.at(pass.saddle, false);
    if (!inertia.usable || inertia.negative_pivots != 1) return std::nullopt;
    pass.residual_N = system_.residual();
    pass.energy_mJ = system_.energy_at(pass.saddle);
    pass.towards_b = softest_mode(system_, {}, watch_);
    const Eigen::Matrix3Xd along = images_[highest_ + 1].state.x - images_[highest_ - 1].state.x;
    if (product(pass.towards_b, along) < 0) pass.towards_b *= -1;
    pass.outcome = Outcome::reached;
    return pass;
  }

  /// Redistributes the images evenly; their number stays the same.
  void even_out() {
    std::vector<double> at(images_.size(), 0.0);
    for (std::size_t k = 1; k < images_.size(); ++k)
      at[k] = at[k - 1] + (images_[k].state.x - images_[k - 1].state.x).norm();
    spacing_ = at.back() / (images - 1);
    std::vector<Image> even;
    std::size_t right = 1;
    for (int n = 0; n < images; ++n) {
      const double position = spacing_ * n;
      while (right + 1 < at.size() && at[right] < position) ++right;
      const double fraction = (position - at[right - 1]) / (at[right] - at[right - 1]);
      even.push_back(between(images_[right - 1], images_[right], std::clamp(fraction, 0.0, 1.0)));
    }
    images_ = std::move(even);
  }

  std::vector<double> energies() const {
    std::vector<double> all;
    for (const Image& image : images_) all.push_back(image.energy_mJ);
    return all;
  }

 private:
  struct Image {
    State state;
    double energy_mJ = 0;
    double shift = 0;  ///< shift of its last step
  };

  /// Lowest stiffness of a stable state, N/mm.
  double softest_stiffness(const State& state) {
    system_.at(state, false);
    Eigen::Matrix3Xd mode = generic_direction(state.x.cols());
    double softness = 1;
    for (int k = 0; k < 8; ++k) {
      mode /= mode.norm();
      system_.solve(mode);
      softness = mode.norm();
    }
    return 1 / softness;
  }

  /// A state between two neighbouring images; an end is the state itself.
  Image between(const Image& a, const Image& b, double fraction) const {
    if (fraction == 0 || fraction == 1) return fraction == 0 ? a : b;
    Image image = fraction < 0.5 ? a : b;
    const Eigen::Matrix3Xd x = a.state.x + fraction * (b.state.x - a.state.x);
    move_to(system_.model(), x, image.state);
    image.state.force = a.state.force + fraction * (b.state.force - a.state.force);
    return image;
  }

  /// The image takes a step down in the plane through it perpendicular to `along`. Returns false if
  /// it cannot.
  bool go_down(Image& image, const Eigen::Matrix3Xd& along) {
    if (watch_.cancelled()) return false;
    image.shift = std::max(least_shift_, image.shift / 2);
    Inertia inertia = system_.at(image.state, true, image.shift);
    while (!inertia.positive_definite()) {
      image.shift *= 4;
      if (!(image.shift < 1e8) || watch_.cancelled()) return false;
      inertia = system_.shifted(image.shift);
    }
    ++system_.effort().newton_iterations;
    Eigen::Matrix3Xd down, normal = along;
    system_.correction(down);
    system_.solve(normal);
    down -= product(along, down) / product(along, normal) * normal;
    const double move = max_column_norm(down);
    if (!std::isfinite(move)) return false;
    system_.apply(std::min(1.0, step_mm_ / move) * down, image.state);
    image.energy_mJ = system_.energy_at(image.state);
    return true;
  }

  Linearisation& system_;
  double step_mm_;
  const Watch& watch_;
  std::vector<Image> images_;  // from a to b
  double spacing_ = 0;
  double least_shift_ = 0;
  std::size_t highest_ = 0;
};

}  // namespace

MountainPass mountain_pass(Linearisation& system, const State& a, const State& b, double step_mm,
                           const Watch& watch) {
  MountainPass none;
  if (max_column_norm(b.x - a.x) < noise_mm) return none;  // no displacement at all
  ElasticString string(system, step_mm, watch);
  if (string.grow(a, b)) {
    for (int round = 0; round < most_rounds; ++round) {
      if (!string.go_down_all()) break;
      if (round >= first_climb && (round - first_climb) % climb_every == 0)
        if (auto pass = string.climb()) {
          pass->string_mJ = string.energies();
          return *std::move(pass);
        }
      string.even_out();
    }
    none.string_mJ = string.energies();
  }
  if (watch.cancelled()) none.outcome = Outcome::cancelled;
  return none;
}

}  // namespace gridshell
