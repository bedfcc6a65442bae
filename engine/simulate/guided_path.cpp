#include "engine/simulate/guided_path.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace gridshell::simulate {
namespace {

constexpr int most_restarts = 4;  // of a way that the coarse leader enters late
constexpr double same_limit_t = 0.02;

double joints_apart(const Simulation& simulation, const Eigen::Matrix3Xd& a,
                    const Eigen::Matrix3Xd& b) {
  const Eigen::Index joints = simulation.shell().finest().joints;
  return max_column_norm(a.leftCols(joints) - b.leftCols(joints));
}

/// One segment of a guide, followed on other meshes.
class GuidedSegment {
 public:
  GuidedSegment(Simulation& simulation, const PathSegment& guide, const StateTransfer& carried,
                const Watch& watch)
      : simulation_(simulation), guide_(guide), carried_(carried), watch_(watch) {}

  /// Nothing: these meshes have no such branch.
  std::optional<PathSegment> followed();
  /// From the guide's state at a load step, brought to these meshes; whether it is beside it.
  bool begin(std::size_t step);

 private:
  std::optional<std::size_t> begin_from(std::size_t step, int& restarts);
  bool beside(std::size_t step) const;
  bool through_unstable(std::size_t step) const;
  std::size_t end_of_branch(std::size_t step) const;
  bool at_its_limit(const Report& report, PathSegment& segment) const;

  Simulation& simulation_;
  const PathSegment& guide_;
  const StateTransfer& carried_;
  const Watch& watch_;
};

bool GuidedSegment::beside(std::size_t step) const {
  const LoadStep& there = guide_.load_steps[step];
  const double apart = joints_apart(simulation_, simulation_.nodes(), there.point.state.x);
  return apart < near_spacings * simulation_.scene().footprint.spacing &&
         (simulation_.certificate().stable() || !there.certificate.stable());
}

bool GuidedSegment::begin(std::size_t step) {
  const LoadStep& there = guide_.load_steps[step];
  NestedShell& shell = simulation_.shell();
  shell.allow_unstable(!there.certificate.stable());
  const Report begun =
      simulation_.begin_at(there.point.t, carried_.carry(there.point.state), watch_);
  shell.allow_unstable(false);
  return begun.end == Outcome::reached && beside(step);
}

/// As the guide went: back towards the flat, or on along the branch that lost its stability.
bool GuidedSegment::through_unstable(std::size_t step) const {
  const auto begin = guide_.load_steps.begin();
  return std::any_of(begin, begin + std::ptrdiff_t(end_of_branch(step) + 1),
                     [](const LoadStep& at) { return !at.certificate.stable(); });
}

/// The last load step before the guide goes on in a rest further on.
std::size_t GuidedSegment::end_of_branch(std::size_t step) const {
  const auto& steps = guide_.load_steps;
  const auto leapt_to = [&](std::size_t k) {
    return std::ranges::any_of(guide_.report.events, [&](const Event& event) {
      return event.to && *event.to == steps[k].point.t;
    });
  };
  while (step + 1 < steps.size() && !leapt_to(step + 1)) ++step;
  return step;
}

/// Whether the way ended at a limit where the guide's did; the place is this segment's own.
bool GuidedSegment::at_its_limit(const Report& report, PathSegment& segment) const {
  if (!at_limit(report.end) || report.end != guide_.report.end ||
      std::abs(report.t - guide_.end()) > same_limit_t)
    return false;
  std::erase_if(segment.report.events, [](const Event& event) { return event.is_limit(); });
  std::ranges::copy(report.events, std::back_inserter(segment.report.events));
  segment.report.t = report.t;
  return true;
}

/// From a load step of the guide, or from the next where these meshes lose or regain the branch a
/// little beside the guide's; its number.
std::optional<std::size_t> GuidedSegment::begin_from(std::size_t step, int& restarts) {
  for (const std::size_t last = end_of_branch(step); step <= last; ++step) {
    if (begin(step)) return step;
    if (watch_.cancelled() || ++restarts > most_restarts) break;
  }
  return std::nullopt;
}

std::optional<PathSegment> GuidedSegment::followed() {
  const auto& steps = guide_.load_steps;
  PathSegment segment{{}, guide_.from, guide_.to, guide_.report, guide_.back};
  int restarts = 0;
  for (std::size_t next = 0; next < steps.size();) {
    const auto step = begin_from(next, restarts);
    if (!step) break;
    for (Event& event : segment.report.events)
      if (event.to && *event.to == steps[next].point.t) event.to = steps[*step].point.t;
    const std::size_t last = end_of_branch(*step);
    const Report way =
        simulation_.go(steps[last].point.t, watch_,
                       {.wanted = false, .through_unstable = through_unstable(*step)}, &segment);
    const bool all = last + 1 == steps.size();
    if (all && at_its_limit(way, segment)) return segment;
    // what the leader loses in between would have frames on another branch
    if (way.end != Outcome::reached || !beside(last)) break;
    segment.report.certificate = way.certificate;
    if (all) return segment;
    next = last + 1;
  }
  return std::nullopt;
}

StateTransfer between_leaders(const Simulation& from, const Simulation& to) {
  return {from.shell().mesh(0), from.shell().model(0), to.shell().mesh(0), to.shell().model(0)};
}

}  // namespace

bool follow_guide(EquilibriumPath& path, const EquilibriumPath& guide, double allowed_mm,
                  const Watch& watch) {
  Simulation& simulation = path.simulation;
  if (!guide.single_motion || !guide.earlier.empty() || !simulation.holds().empty() ||
      simulation.scene().snap.wanted || guide.segments.empty())
    return false;
  const StateTransfer carried = between_leaders(guide.simulation, simulation);
  std::vector<PathSegment> segments;
  for (const PathSegment& segment : guide.segments) {
    auto followed = GuidedSegment(simulation, segment, carried, watch).followed();
    if (!followed) return false;
    segments.push_back(std::move(*followed));
  }
  path.segments = std::move(segments);
  path.mesh_disagreement = guide.mesh_disagreement;
  return worst_estimate_mm(path) <= allowed_mm;
}

bool stable(const PathSegment& segment) {
  return std::ranges::all_of(segment.load_steps,
                             [](const LoadStep& step) { return step.certificate.stable(); });
}

namespace {

/// Whether what finer meshes add to the leader goes on from one load step to the next. Where it
/// leaps the finer ones went over to another branch, which the leader was on before or never is.
bool corrections_go_on(const Simulation& simulation, const PathSegment& segment) {
  constexpr double leap = 0.5, least = 1e-3;  // of itself, of d
  const Eigen::Index joints = simulation.shell().finest().joints;
  const double seen = least * simulation.scene().footprint.spacing;
  for (std::size_t k = 1; k < segment.load_steps.size(); ++k) {
    const auto &before = segment.load_steps[k - 1].point.beyond,
               &after = segment.load_steps[k].point.beyond;
    for (std::size_t level = 0; level < std::min(before.size(), after.size()); ++level) {
      const auto size = [&](const Eigen::Matrix3Xf& x) {
        return double(x.leftCols(joints).colwise().norm().maxCoeff());
      };
      const auto &a = before[level].x, &b = after[level].x;
      if (size(b - a) > std::max(seen, leap * std::max(size(a), size(b)))) return false;
    }
  }
  return true;
}

}  // namespace

bool has_states_of(Simulation& simulation, const EquilibriumPath& path, const Watch& watch) {
  if (path.segments.empty()) return true;  // the flat itself
  const StateTransfer carried = between_leaders(path.simulation, simulation);
  const PathSegment& segment = path.segments.back();
  GuidedSegment guided(simulation, segment, carried, watch);
  const std::size_t last = segment.load_steps.size() - 1;
  return stable(segment) && corrections_go_on(path.simulation, segment) &&
         std::ranges::all_of(std::initializer_list<std::size_t>{0, last / 2, last},
                             [&](std::size_t step) { return guided.begin(step); });
}

bool uneventful(const EquilibriumPath& path) {
  return !path.has_events() && std::ranges::all_of(path.segments, stable);
}

bool begin_alike(const EquilibriumPath& a, const EquilibriumPath& b) {
  if (a.segments.size() != b.segments.size() || a.segments.empty()) return false;
  const PathPoint &first = a.segments.front().load_steps.front().point,
                  &other = b.segments.front().load_steps.front().point;
  return first.t == other.t && joints_apart(a.simulation, first.state.x, other.state.x) <
                                   near_spacings * a.simulation.scene().footprint.spacing;
}

}  // namespace gridshell::simulate
