#include "engine/simulate/frames_between.h"

#include <algorithm>
#include <cmath>

#include "engine/core/dense.h"
#include "engine/simulate/frame_forces.h"
#include "engine/simulate/frames.h"

namespace gridshell::simulate {
namespace {

constexpr double share_of_tolerance = 0.1;  // that a polynomial in t may leave
constexpr double nearby = 1e-3;  // of d: a correction beyond is none of the guess's own branch
constexpr double misfit_of_knots = 1e-5;  // of the largest axial force (nested_certificate.cpp)
constexpr std::size_t most_knots = 6;
constexpr int parts = 4;  // of the way between two load steps

bool smooth(const PathSegment& segment, std::size_t k) {
  return goes_on_between(segment, segment.load_steps[k], segment.load_steps[k + 1]);
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
  for (std::size_t size = 0; size != last - first;) {
    size = last - first;
    if (first > 0 && size + 1 < most_knots && smooth(segment, first - 1)) --first;
    if (last + 1 < steps.size() && last - first + 1 < most_knots && smooth(segment, last)) ++last;
  }
  std::vector<double> known;
  for (std::size_t j = first; j <= last; ++j) known.push_back(steps[j].point.t);
  return Window{first, std::move(known), k};
}

FramesBetween::Weights FramesBetween::weights_at(const std::vector<double>& known, double t) {
  const Eigen::VectorXd all = polynomial_weights(known, t);
  return {all,
          {all - polynomial_weights(known, t, 0),
           all - polynomial_weights(known, t, known.size() - 1)}};
}

/// Factorises the coarsest mesh in the middle of the piece between two load steps in which t lies,
/// so that a frame does not depend on which others there are.
Inertia FramesBetween::factored_near(double t, const PathPoint& from, const PathPoint& to) {
  const double piece = std::floor(parts * (t - from.t) / (to.t - from.t));
  const double middle = from.t + (piece + 0.5) / parts * (to.t - from.t);
  NestedShell& shell = path_.simulation.shell();
  Linearisation& system = shell.system(0);
  if (factored_.t == middle && factored_.count == system.effort().factorizations)
    return factored_.inertia;
  State state = hermite(shell.model(0), from, to, middle);
  shell.motion(0).impose(system, middle, state);
  factored_ = {middle, system.at(state), system.effort().factorizations};
  return factored_.inertia;
}

/// The coarsest mesh brought to rest beside a guess, where it is stable there.
std::optional<record::Frame> FramesBetween::leading_at(double t, State& guess,
                                                       std::optional<Inertia> factored) {
  NestedShell& shell = path_.simulation.shell();
  Linearisation& system = shell.system(0);
  const Scene& scene = path_.simulation.scene();
  NewtonOptions options;
  options.tolerance_mm = options.trusted_mm = 1e-3 * scene.tolerance * scene.length_scale_mm;
  options.trusted_misfit = 3e-5;  // forces are shown
  options.farthest_mm = nearby * scene.footprint.spacing;
  options.most_iterations = 8;
  if (factored && factored->positive_definite()) options.factored = factored;
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

/// The frame of a certified state, but of nodes, K, reactions and energies what finer meshes add.
std::optional<FramesBetween::Knot> FramesBetween::knot_at(double t, const LoadStep& beside) {
  const Report report = path_.simulation.sample(t, beside, false, watch_);
  if (report.end != Outcome::reached || !report.certificate.stable()) return {};
  Knot knot{frame_of(path_.simulation), path_.simulation.shell().state().levels[0]};
  measure_(knot.added, t, false);
  const auto leading = leading_at(t, knot.leading);
  if (!leading) return {};
  knot.added.nodes -= leading->nodes;
  knot.added.cell_K -= leading->cell_K;
  knot.added.reactions_N -= leading->reactions_N;
  knot.added.energies += -1 * leading->energies;
  return knot;
}

/// The knots at the load steps of a window; fewer: one of them has none.
FramesBetween::Knots FramesBetween::knots_in(const PathSegment& segment, const Window& window) {
  const auto end = window.first + window.t.size();
  std::erase_if(knots_, [&](const auto& known) {
    const auto& [step, part] = known.first;
    return step < window.first || step >= end || (part > 0 && step != window.before);
  });
  Knots knots;
  for (std::size_t k = window.first; k < end; ++k) {
    const auto [at, is_new] = knots_.try_emplace({k, 0});
    if (is_new) at->second = knot_at(segment.load_steps[k].point.t, segment.load_steps[k]);
    if (at->second) knots.push_back(&*at->second);
  }
  return knots;
}

/// The knots at quarters of the way between two load steps, those with it; fewer: one has none.
FramesBetween::Knots FramesBetween::knots_between(const PathSegment& segment,
                                                  const Window& window) {
  const std::size_t k = window.before;
  const LoadStep &a = segment.load_steps[k], &b = segment.load_steps[k + 1];
  Knots knots;
  for (int part = 0; part <= parts; ++part) {
    const bool whole = part == parts;
    const auto [at, is_new] = knots_.try_emplace({whole ? k + 1 : k, whole ? 0 : part});
    const double share = double(part) / parts;
    if (is_new) at->second = knot_at((1 - share) * a.point.t + share * b.point.t, whole ? b : a);
    if (!at->second) break;
    knots.push_back(&*at->second);
  }
  return knots;
}

namespace {

constexpr auto weighted = [](const auto& knots, const Eigen::VectorXd& w, const auto& of) {
  std::decay_t<decltype(of(*knots[0]))> all = w[0] * of(*knots[0]);
  for (std::size_t k = 1; k < knots.size(); ++k) all += w[Eigen::Index(k)] * of(*knots[k]);
  return all;
};

}  // namespace

/// By how much the polynomial of the joints is in doubt.
double FramesBetween::doubt_mm(const Knots& knots, const Weights& weights) const {
  const Eigen::Index joints = path_.simulation.shell().finest().joints;
  double most = 0;
  for (const Eigen::VectorXd& without : weights.without)
    most = std::max(most, max_column_norm(weighted(knots, without, [&](const Knot& knot) {
                      return Eigen::Matrix3Xd(knot.added.nodes.leftCols(joints));
                    })));
  return 2 * most;
}

std::optional<record::Frame> FramesBetween::at(const PathSample& sample) {
  const PathSegment& segment = path_.segments[sample.segment];
  const auto window = wanted_ ? window_at(segment, sample.t) : std::nullopt;
  if (!window) return {};
  const PathPoint &from = segment.load_steps[window->before].point,
                  &to = segment.load_steps[window->before + 1].point;
  if (from.velocity.x.size() == 0 || to.velocity.x.size() == 0) return {};
  if (sample.segment != segment_) knots_.clear();
  segment_ = sample.segment;
  const Scene& scene = path_.simulation.scene();
  const Model& model = path_.simulation.shell().model(0);
  const double allowed_mm = share_of_tolerance * scene.tolerance * scene.length_scale_mm,
               share = (sample.t - from.t) / (to.t - from.t);
  const Knots knots = knots_in(segment, *window);
  if (knots.size() < window->t.size()) return {};
  const Knot &before = *knots[window->before - window->first],
             &after = *knots[window->before - window->first + 1];
  State guess = hermite(model, from, to, sample.t);
  const Weights weights = weights_at(window->t, sample.t);
  if (doubt_mm(knots, weights) <= allowed_mm)
    if (auto frame = leading_at(sample.t, guess, factored_near(sample.t, from, to)))
      return composed(std::move(*frame), sample.t, share, {&before, &after}, knots, weights);
  // states in between
  const Knots closer = knots_between(segment, *window);
  if (int(closer.size()) <= parts) return {};
  std::vector<double> known;
  for (int part = 0; part <= parts; ++part)
    known.push_back(from.t + (to.t - from.t) * part / parts);
  const Weights of_closer = weights_at(known, sample.t);
  if (!(doubt_mm(closer, of_closer) <= allowed_mm)) return {};
  guess = hermite(model, from, to, sample.t);
  Eigen::Matrix3Xd x = guess.x;
  x.leftCols(model.nodes) = weighted(closer, of_closer.all, [&](const Knot& knot) {
    return Eigen::Matrix3Xd(knot.leading.x.leftCols(model.nodes));
  });
  move_to(model, x, guess);
  guess.force = weighted(closer, of_closer.all, [](const Knot& knot) -> const Eigen::VectorXd& {
    return knot.leading.force;
  });
  auto frame = leading_at(sample.t, guess, factored_near(sample.t, from, to));
  if (!frame) return {};
  return composed(std::move(*frame), sample.t, share, {&before, &after}, closer, of_closer);
}

/// The coarsest mesh's frame with what finer meshes add, and the errors of both.
record::Frame FramesBetween::composed(record::Frame frame, double t, double share,
                                      const Knots& around, const Knots& knots,
                                      const Weights& weights) const {
  using record::Frame;
  const auto sum = [&](const Eigen::VectorXd& w, auto member) {
    return weighted(
        knots, w, [&](const Knot& knot) -> const auto& { return knot.added.*member; });
  };
  // by how much a polynomial is in doubt
  const auto doubt = [&](auto member, const auto& size) {
    return 2 *
           std::max(size(sum(weights.without[0], member)), size(sum(weights.without[1], member)));
  };
  const double nodes_mm = doubt_mm(knots, weights);

  frame.nodes += sum(weights.all, &Frame::nodes);
  frame.cell_K += sum(weights.all, &Frame::cell_K);
  frame.reactions_N += sum(weights.all, &Frame::reactions_N);
  frame.energies += sum(weights.all, &Frame::energies);
  frame.axial_force_N = sum(weights.all, &Frame::axial_force_N);
  frame.brace_force_N = sum(weights.all, &Frame::brace_force_N);
  frame.bending_mJ_per_m = sum(weights.all, &Frame::bending_mJ_per_m).cwiseMax(0);
  frame.curvature_per_mm = sum(weights.all, &Frame::curvature_per_mm).cwiseMax(0);
  frame.stiffness_N_per_mm = sum(weights.all, &Frame::stiffness_N_per_mm);

  const auto error = [&](double Frame::*member, double by_polynomial) {
    frame.*member =
        (1 - share) * around[0]->added.*member + share * around[1]->added.*member + by_polynomial;
  };
  double force_N = doubt(&Frame::reactions_N, [](const Eigen::Matrix3Xd& forces) {
    return forces.cols() > 0 ? max_column_norm(forces) : 0;
  });
  // and what load steps leave on their finest mesh
  if (frame.axial_force_N.size() > 0)
    force_N += misfit_of_knots * frame.axial_force_N.cwiseAbs().maxCoeff();
  error(&Frame::error_estimate_mm, nodes_mm);
  error(&Frame::force_error_N, force_N);
  error(&Frame::push_error_N, force_N);
  error(&Frame::energy_error_mJ, doubt(&Frame::energies, [](const Energies& energies) {
    double most = std::abs(energies.total());
    for (const TermName& term : energy_terms) most = std::max(most, std::abs(energies[term.term]));
    return most;
  }));
  error(&Frame::stiffness_error_N_per_mm,
        doubt(&Frame::stiffness_N_per_mm, [](double value) { return std::abs(value); }));
  complete_shape(path_.simulation, contacts_.in(frame.nodes), frame);
  measure_(frame, t, true);
  return frame;
}

}  // namespace gridshell::simulate
