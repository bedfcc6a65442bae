#include "engine/simulate/frames_between.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <span>
#include <utility>

#include "engine/core/dense.h"
#include "engine/core/team.h"
#include "engine/simulate/frame_forces.h"
#include "engine/simulate/frames.h"
#include "engine/solve/equilibrium_path.h"

namespace gridshell::simulate {
namespace {

constexpr double share_of_tolerance = 0.1;  // that a polynomial in t may leave
constexpr double nearby = 1e-3;  // of d: a correction beyond is none of the guess's own branch
constexpr double misfit_of_knots = 1e-5;  // of the largest axial force (nested_certificate.cpp)
constexpr std::size_t most_knots = 6;
constexpr int parts = 4;               // of the way between two load steps
constexpr std::size_t most_ahead = 8;  // pieces of the way; two a thread serve where there are few

bool smooth(const PathSegment& segment, std::size_t k) {
  return goes_on_between(segment, segment.load_steps[k], segment.load_steps[k + 1]);
}

/// What acts and what is held on another system of the same mesh.
void take_over(const Linearisation& from, Linearisation& to) {
  to.outside = from.outside;
  to.hold(from.holds());
  if (from.neutral_shift() > 0) to.bear_neutral_directions();
}

}  // namespace

FramesBetween::FramesBetween(EquilibriumPath& path, decltype(Caption::measure) measure,
                             const Watch& watch, std::vector<PathSample> expected)
    : path_(path),
      measure_(std::move(measure)),
      watch_(watch),
      to_finest_(path.simulation.shell().mesh(0), path.simulation.shell().finest()),
      contacts_(parts_of(path.simulation.scene(), path.simulation.shell().finest())),
      expected_(std::move(expected)) {
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
  return Window{first, last, k};
}

/// Where the coarsest mesh is looked for: on the polynomial through the states and tangents of the
/// knots around t, and of the next on each side, but where it lies so near to these that round-off
/// would count, or beyond a way that bends too much for it to tell.
State FramesBetween::guess_at(double t, const Knots& knots) const {
  const auto at = [&](std::size_t k) { return knots[k]->leading.t; };
  const double way = at(knots.size() - 1) - at(0);
  std::size_t k = 0;
  while (k + 2 < knots.size() && way * (t - at(k + 1)) >= 0) ++k;
  std::vector<const PathPoint*> points{&knots[k]->leading, &knots[k + 1]->leading};
  const double least = 0.5 * std::abs(at(k + 1) - at(k));
  const auto tells = [&](std::size_t a) {
    return !knots[a + 1]->hard && std::abs(at(a + 1) - at(a)) >= least;
  };
  if (k > 0 && tells(k - 1)) points.push_back(&knots[k - 1]->leading);
  if (k + 2 < knots.size() && tells(k + 1)) points.push_back(&knots[k + 2]->leading);
  return between(path_.simulation.shell().model(0), points, t);
}

FramesBetween::Weights FramesBetween::weights_at(const Knots& knots, double t) {
  std::vector<double> known;
  for (const auto& knot : knots) known.push_back(knot->leading.t);
  const Eigen::VectorXd all = polynomial_weights(known, t);
  return {all,
          {all - polynomial_weights(known, t, 0),
           all - polynomial_weights(known, t, known.size() - 1)}};
}

/// So that a frame does not depend on which others there are.
double FramesBetween::Draft::middle() const {
  return from() + (std::floor(parts * share()) + 0.5) / parts * (to() - from());
}

/// The coarsest mesh brought to rest beside a guess, where it is stable there.
std::optional<record::Frame> FramesBetween::leading_at(Linearisation& system, double t,
                                                       State& guess,
                                                       std::optional<Inertia> factored) const {
  const Scene& scene = path_.simulation.scene();
  NewtonOptions options;
  options.tolerance_mm = options.trusted_mm = 1e-3 * scene.tolerance * scene.length_scale_mm;
  options.trusted_misfit = 3e-5;  // forces are shown
  options.farthest_mm = nearby * scene.footprint.spacing;
  options.most_iterations = 8;
  if (factored && factored->positive_definite()) options.factored = factored;
  path_.simulation.shell().motion(0).impose(system, t, guess);
  const NewtonReport report = newton(system, guess, options, watch_);
  if (report.outcome != Outcome::reached || !report.inertia.positive_definite()) return {};
  system.gradient_at(guess);
  record::Frame frame = leading_frame(path_.simulation, guess, system, to_finest_);
  frame.residual_N = system.residual();
  frame.negative_pivots = 0;
  frame.newton_iterations = report.iterations;
  return frame;
}

/// The frame of a certified state, but of nodes, K, reactions and energies what finer meshes add.
/// Nothing: there is no stable one.
std::shared_ptr<const FramesBetween::Knot> FramesBetween::knot_at(double t, const LoadStep& beside,
                                                                  const LoadStep* across) {
  NestedShell& shell = path_.simulation.shell();
  const Report report = path_.simulation.sample(t, beside, false, watch_, across);
  if (report.end != Outcome::reached || !report.certificate.stable()) return nullptr;
  const auto knot = std::make_shared<Knot>(Knot{
      frame_of(path_.simulation), {t, shell.state().levels[0], {}}, !beside.point.way.empty()});
  measure_(knot->added, t, false);
  PathPoint& at = knot->leading;
  const auto leading = leading_at(shell.system(0), t, at.state);
  if (!leading) return nullptr;
  shell.motion(0).velocity(shell.system(0), t, at.state, at.velocity);
  knot->added.nodes -= leading->nodes;
  knot->added.cell_K -= leading->cell_K;
  knot->added.reactions_N -= leading->reactions_N;
  knot->added.energies += -1 * leading->energies;
  return knot;
}

/// The knots at the load steps of a window; fewer: one of them has none.
FramesBetween::Knots FramesBetween::knots_in(const PathSegment& segment, const Window& window) {
  Knots knots;
  for (std::size_t k = window.first; k <= window.last; ++k) {
    const auto [at, is_new] = knots_.try_emplace({k, 0});
    if (is_new) at->second = knot_at(segment.load_steps[k].point.t, segment.load_steps[k], nullptr);
    if (at->second) knots.push_back(at->second);
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
    if (is_new)
      at->second = knot_at((1 - share) * a.point.t + share * b.point.t, whole ? b : a,
                           part > 0 && !whole ? &b : nullptr);
    if (!at->second) break;
    knots.push_back(at->second);
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
  if (!ready_.contains(sample.index)) read_ahead(sample);
  auto frame = std::move(ready_.extract(sample.index).mapped());
  if (frame) measure_(*frame, sample.t, true);
  return frame;
}

std::size_t FramesBetween::helpers() const {
  const Team* team = path_.simulation.scene().team.get();
  return team ? std::size_t(team->threads()) : 1;
}

/// Knots that neither the frame of a sample nor later ones need.
void FramesBetween::forget_behind(const PathSample& sample) {
  const PathSegment& segment = path_.segments[sample.segment];
  if (sample.segment != segment_) knots_.clear();
  segment_ = sample.segment;
  const auto window = window_at(segment, sample.t);
  if (!window) return;
  // a segment back is shown against its way
  const auto behind = [&](std::size_t step, std::size_t first, std::size_t last) {
    return segment.back ? step > last : step < first;
  };
  std::erase_if(knots_, [&](const auto& known) {
    const auto& [step, part] = known.first;
    return part > 0 ? behind(step, window->before, window->before)
                    : behind(step, window->first, window->last);
  });
}

/// Makes the frames of the piece of the way in which a sample lies, and of the next ones.
void FramesBetween::read_ahead(const PathSample& sample) {
  const std::size_t most = std::min(2 * helpers(), most_ahead);
  forget_behind(sample);
  std::vector<Draft> drafts;
  std::set<double> pieces;
  auto next = std::ranges::find(expected_, sample.index, &PathSample::index);
  for (PathSample ahead = sample; ahead.segment == sample.segment; ahead = *next) {
    auto draft = draft_at(ahead, false);
    if (!draft || (pieces.insert(draft->middle()), pieces.size() > most)) break;
    drafts.push_back(std::move(*draft));
    if (next == expected_.end() || ++next == expected_.end()) break;
  }
  ready_.clear();
  ready_[sample.index] = {};
  finish(drafts);
  Factored alone{path_.simulation.shell().system(0)};
  for (Draft& draft : drafts) {
    if (!draft.frame && !draft.closer)
      if (auto closer = draft_at(draft.sample, true)) {
        finish(*closer, alone);
        draft.frame = std::move(closer->frame);
      }
    ready_[draft.sample.index] = std::move(draft.frame);
  }
}

/// What a sample's frame is made from, by states in between where the polynomial through load steps
/// is in doubt or `closer` is asked for. Nothing: as of at().
std::optional<FramesBetween::Draft> FramesBetween::draft_at(const PathSample& sample, bool closer) {
  const PathSegment& segment = path_.segments[sample.segment];
  const auto window = wanted_ ? window_at(segment, sample.t) : std::nullopt;
  if (!window) return {};
  const Scene& scene = path_.simulation.scene();
  const double allowed_mm = share_of_tolerance * scene.tolerance * scene.length_scale_mm;
  const Knots knots = knots_in(segment, *window);
  if (knots.size() <= window->last - window->first) return {};
  const std::size_t before = window->before - window->first;
  Draft draft{sample, {knots[before], knots[before + 1]}, knots, weights_at(knots, sample.t)};
  draft.closer =
      closer || knots[before + 1]->hard || !(doubt_mm(draft.knots, draft.weights) <= allowed_mm);
  if (!draft.closer) return draft;
  // states in between
  draft.knots = knots_between(segment, *window);
  if (int(draft.knots.size()) <= parts) return {};
  draft.weights = weights_at(draft.knots, sample.t);
  if (!(doubt_mm(draft.knots, draft.weights) <= allowed_mm)) return {};
  return draft;
}

/// Whole pieces of the way, each by one of the team.
void FramesBetween::finish(std::vector<Draft>& drafts) {
  std::vector<std::span<Draft>> pieces;
  for (std::size_t begin = 0, end = 0; begin < drafts.size(); begin = end) {
    while (end < drafts.size() && drafts[end].middle() == drafts[begin].middle()) ++end;
    pieces.push_back(std::span(drafts).subspan(begin, end - begin));
  }
  const Scene& scene = path_.simulation.scene();
  NestedShell& shell = path_.simulation.shell();
  Linearisation& first = shell.system(0);
  const int lanes = int(std::min(helpers(), pieces.size()));
  while (int(systems_.size()) + 1 < lanes)
    systems_.push_back(std::make_unique<Linearisation>(shell.model(0)));
  const auto work = [&](int lane) {
    Factored factored{lane == 0 ? first : *systems_[std::size_t(lane - 1)]};
    for (auto k = std::size_t(lane); k < pieces.size(); k += std::size_t(lanes))
      for (Draft& draft : pieces[k]) finish(draft, factored);
  };
  if (lanes < 2) {
    if (lanes == 1) work(0);
    return;
  }
  for (const auto& system : systems_) take_over(first, *system);
  first.work_with(nullptr);
  scene.team->run(lanes, work);
  first.work_with(scene.team.get());
  for (const auto& system : systems_) first.effort() += std::exchange(system->effort(), {});
}

/// Brings the coarsest mesh to rest with one factorisation a piece.
void FramesBetween::finish(Draft& draft, Factored& factored) const {
  const NestedShell& shell = path_.simulation.shell();
  Linearisation& system = factored.system;
  const double middle = draft.middle();
  // alike for all frames of a piece that have the same knots
  if (factored.t != middle || factored.closer != draft.closer ||
      factored.count != system.effort().factorizations) {
    State state = guess_at(middle, draft.knots);
    shell.motion(0).impose(system, middle, state);
    factored.inertia = system.at(state);
    factored.t = middle;
    factored.closer = draft.closer;
    factored.count = system.effort().factorizations;
  }
  State guess = guess_at(draft.sample.t, draft.knots);
  draft.frame = leading_at(system, draft.sample.t, guess, factored.inertia);
  if (draft.frame) compose(draft);
}

/// The coarsest mesh's frame with what finer meshes add, and the errors of both.
void FramesBetween::compose(Draft& draft) const {
  using record::Frame;
  Frame& frame = *draft.frame;
  const double share = draft.share();
  const Knots &around = draft.around, &knots = draft.knots;
  const Weights& weights = draft.weights;
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
}

}  // namespace gridshell::simulate
