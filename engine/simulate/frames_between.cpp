#include "engine/simulate/frames_between.h"

#include <algorithm>
#include <cmath>

#include "engine/simulate/frames.h"

namespace gridshell::simulate {
namespace {

constexpr double share_of_tolerance = 0.1;  // that a polynomial in t may leave
constexpr double nearby = 1e-3;  // of d: a correction beyond is none of the guess's own branch
constexpr std::size_t most_knots = 4;

/// Whether nothing happens to the branch between two load steps that follow one another.
bool smooth(const PathSegment& segment, std::size_t k) {
  const LoadStep &a = segment.load_steps[k], &b = segment.load_steps[k + 1];
  const double way = segment.sign(), from = way * a.point.t, to = way * b.point.t;
  if (!(from < to) || !a.certificate.stable() || !b.certificate.stable()) return false;
  return std::ranges::none_of(segment.report.events, [&](const Event& event) {
    const auto [begin, end] = std::minmax({way * event.t, way * event.to.value_or(event.t)});
    return begin < to && end > from;
  });
}

/// Of the polynomial through values at `known`: its weights at t, 0 for the one left out.
Eigen::VectorXd weights_of(const std::vector<double>& known, double t, std::size_t left_out) {
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(Eigen::Index(known.size()));
  for (std::size_t k = 0; k < known.size(); ++k)
    for (std::size_t j = 0; j < known.size(); ++j)
      if (j != k && j != left_out)
        weights[Eigen::Index(k)] *= k == left_out ? 0 : (t - known[j]) / (known[k] - known[j]);
  return weights;
}

/// The cubic through two states and their tangents; angles, which count from a state's own frames,
/// go on from the first.
State hermite(const Model& model, const PathPoint& a, const PathPoint& b, double t) {
  const double h = b.t - a.t, s = (t - a.t) / h;
  const double to = s * s * (3 - 2 * s), from_slope = h * s * (1 - s) * (1 - s),
               to_slope = -h * s * s * (1 - s);
  const auto between = [&](const auto& x, const auto& vx, const auto& y, const auto& vy) {
    return (x + to * (y - x) + from_slope * vx + to_slope * vy).eval();
  };
  State guess = a.state;
  guess.force = between(a.state.force, a.velocity.force, b.state.force, b.velocity.force);
  Eigen::Matrix3Xd x = a.state.x + (t - a.t) * a.velocity.x;
  x.leftCols(model.nodes) =
      between(a.state.x, a.velocity.x, b.state.x, b.velocity.x).leftCols(model.nodes);
  move_to(model, x, guess);
  return guess;
}

}  // namespace

FramesBetween::FramesBetween(EquilibriumPath& path, decltype(Caption::measure) measure,
                             const Watch& watch)
    : path_(path),
      measure_(std::move(measure)),
      watch_(watch),
      to_finest_(path.simulation.shell().mesh(0), path.simulation.shell().finest()),
      contacts_(parts_of(path.simulation.scene(), path.simulation.shell().finest())) {
  const Simulation& simulation = path.simulation;
  wanted_ = simulation.shell().levels() > 1 && !simulation.scene().rods.contact.barrier.acts() &&
            strains_by_curvature(simulation.shell().model(simulation.shell().levels() - 1));
}

std::optional<FramesBetween::Window> FramesBetween::window_at(const PathSegment& segment,
                                                              double t) const {
  const auto& steps = segment.load_steps;
  const double way = segment.sign();
  std::size_t k = 0;
  while (k + 2 < steps.size() && way * (steps[k + 1].point.t - t) <= 0) ++k;
  if (steps.size() < 2 || !(way * (t - steps[k].point.t) > 0) ||
      !(way * (steps[k + 1].point.t - t) > 0) || !smooth(segment, k))
    return {};
  std::size_t first = k, last = k + 1;
  if (first > 0 && smooth(segment, first - 1)) --first;
  if (last + 1 < steps.size() && smooth(segment, last)) ++last;
  // at the end of a branch those further back
  while (last - first + 1 < most_knots && first > 0 && smooth(segment, first - 1)) --first;
  while (last - first + 1 < most_knots && last + 1 < steps.size() && smooth(segment, last)) ++last;
  std::vector<double> known;
  for (std::size_t j = first; j <= last; ++j) known.push_back(steps[j].point.t);
  const std::size_t farthest =
      std::abs(known.front() - t) > std::abs(known.back() - t) ? 0 : known.size() - 1;
  const double a = steps[k].point.t, b = steps[k + 1].point.t;
  return Window{first, weights_of(known, t, known.size()), weights_of(known, t, farthest),
                (t - a) / (b - a), k};
}

/// The coarsest mesh brought to rest beside a guess, where it is stable there.
std::optional<record::Frame> FramesBetween::leading_at(double t, State guess) {
  NestedShell& shell = path_.simulation.shell();
  Linearisation& system = shell.system(0);
  const Scene& scene = path_.simulation.scene();
  NewtonOptions options;
  options.tolerance_mm = options.trusted_mm = 1e-3 * scene.tolerance * scene.length_scale_mm;
  options.trusted_misfit = 1e-5;  // as of the finest mesh: forces are shown
  options.farthest_mm = nearby * scene.footprint.spacing;
  options.most_iterations = 5;
  shell.motion(0).impose(system, t, guess);
  const NewtonReport report = newton(system, guess, options, watch_);
  if (report.outcome != Outcome::reached || !report.inertia.positive_definite()) return {};
  system.gradient_at(guess);
  record::Frame frame = leading_frame(path_.simulation, guess, system.assembly(), to_finest_);
  frame.residual_N = system.residual();
  frame.negative_pivots = 0;
  frame.newton_iterations = report.iterations;
  return frame;
}

const FramesBetween::Knot* FramesBetween::knot(const PathSegment& segment, std::size_t k) {
  const auto [at, made] = knots_.try_emplace(k);
  if (made) {
    const LoadStep& step = segment.load_steps[k];
    const Report report = path_.simulation.sample(step.point.t, step, false, watch_);
    if (report.end == Outcome::reached && report.certificate.stable()) {
      Knot knot{frame_of(path_.simulation), {}};
      measure_(knot.full, step.point.t, false);
      if (auto leading = leading_at(step.point.t, step.point.state)) {
        knot.leading = std::move(*leading);
        at->second = std::move(knot);
      }
    }
  }
  return at->second ? &*at->second : nullptr;
}

std::optional<record::Frame> FramesBetween::at(const PathSample& sample) {
  const PathSegment& segment = path_.segments[sample.segment];
  const auto window = wanted_ ? window_at(segment, sample.t) : std::nullopt;
  if (!window) return {};
  const auto size = std::size_t(window->high.size());
  if (sample.segment != segment_) knots_.clear();
  segment_ = sample.segment;
  std::erase_if(knots_, [&](const auto& known) {
    return known.first < window->first || known.first >= window->first + size;
  });
  std::vector<const Knot*> knots;
  for (std::size_t k = 0; k < size; ++k) {
    knots.push_back(knot(segment, window->first + k));
    if (!knots.back()) return {};
  }
  const PathPoint &a = segment.load_steps[window->before].point,
                  &b = segment.load_steps[window->before + 1].point;
  if (a.velocity.x.size() == 0 || b.velocity.x.size() == 0) return {};
  const Model& model = path_.simulation.shell().model(0);
  auto leading = leading_at(sample.t, hermite(model, a, b, sample.t));
  if (!leading) return {};

  // what finer meshes add, and what is interpolated as it is
  const auto added = [&](auto member, const Eigen::VectorXd& weights) {
    std::decay_t<decltype((*leading).*member)> all =
        weights[0] * (knots[0]->full.*member - knots[0]->leading.*member);
    for (std::size_t k = 1; k < size; ++k)
      all += weights[Eigen::Index(k)] * (knots[k]->full.*member - knots[k]->leading.*member);
    return all;
  };
  const auto along = [&](auto member, const Eigen::VectorXd& weights) {
    std::decay_t<decltype((*leading).*member)> all = weights[0] * (knots[0]->full.*member);
    for (std::size_t k = 1; k < size; ++k)
      all += weights[Eigen::Index(k)] * (knots[k]->full.*member);
    return all;
  };
  using record::Frame;
  const Eigen::VectorXd left = window->high - window->low;
  const Eigen::Index joints = path_.simulation.shell().finest().joints;
  const double nodes_mm = max_column_norm(added(&Frame::nodes, left).leftCols(joints));
  const Scene& scene = path_.simulation.scene();
  if (!(nodes_mm <= share_of_tolerance * scene.tolerance * scene.length_scale_mm)) return {};

  Frame frame = *leading;
  frame.nodes += added(&Frame::nodes, window->high);
  frame.cell_K += added(&Frame::cell_K, window->high);
  frame.reactions_N += added(&Frame::reactions_N, window->high);
  frame.energies += added(&Frame::energies, window->high);
  frame.axial_force_N = along(&Frame::axial_force_N, window->high);
  frame.bending_mJ_per_m = along(&Frame::bending_mJ_per_m, window->high).cwiseMax(0);
  frame.curvature_per_mm = along(&Frame::curvature_per_mm, window->high).cwiseMax(0);
  frame.stiffness_N_per_mm = along(&Frame::stiffness_N_per_mm, window->high);
  const Frame &before = knots[window->before - window->first]->full,
              &after = knots[window->before - window->first + 1]->full;
  const auto error = [&](double Frame::*member, double by_interpolation) {
    frame.*member =
        (1 - window->share) * before.*member + window->share * after.*member + by_interpolation;
  };
  const Energies energies = added(&Frame::energies, left);
  double energy = std::abs(energies.total());
  for (const TermName& term : energy_terms)
    energy = std::max(energy, std::abs(energies[term.term]));
  const Eigen::Matrix3Xd reactions = added(&Frame::reactions_N, left);
  const double force = reactions.cols() > 0 ? max_column_norm(reactions) : 0;
  error(&Frame::error_estimate_mm, nodes_mm);
  error(&Frame::energy_error_mJ, energy);
  error(&Frame::force_error_N, force);
  error(&Frame::push_error_N, force);
  error(&Frame::stiffness_error_N_per_mm, std::abs(along(&Frame::stiffness_N_per_mm, left)));
  complete_shape(path_.simulation, contacts_.in(frame.nodes), frame);
  measure_(frame, sample.t, true);
  return frame;
}

}  // namespace gridshell::simulate
