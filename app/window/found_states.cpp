// Marks on the paths of a shell, and the states that were found, to return to.

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "app/window/command.h"
#include "app/window/edit_session.h"
#include "app/window/shell_view.h"
#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

/// The path parameter of the loss of stability between an unstable and a stable load step: that of
/// an event between them; without one that of the unstable step.
double edge_between(double unstable, double stable, const std::vector<Event>& events) {
  for (const Event& event : events)
    if (event.kind == Event::Kind::stability_lost && (event.t - unstable) * (event.t - stable) <= 0)
      return event.t;
  return unstable;
}

constexpr double touching = 1e-9;

std::string text_of_event(const Event& event) {
  switch (event.kind) {
    case Event::Kind::stability_lost:
      return !event.to    ? "stability lost"
             : event.jump ? "stability lost: snapped to another state"
                          : "the path branches";
    case Event::Kind::turned_back:
      return event.to ? "limit point: snapped to another state" : "limit point";
    case Event::Kind::locked:
      return words_of(outcome_of(event.kind)).what;
    case Event::Kind::overbent:
      return "a rod is strained as far as [limits] " + event.what + " allows";
    case Event::Kind::contact:
      return "past it there touch " + event.what;
  }
  return "";
}

constexpr std::size_t most_states = 24;

bool nearly(double a, double b, double within) {
  return std::abs(a - b) <= within * std::max({std::abs(a), std::abs(b), 1e-12});
}

}  // namespace

std::vector<PathMark> marks_of(const PathRecord& path, const std::vector<Event>& events, int joint,
                               const std::function<double(double)>& position) {
  std::vector<PathMark> marks;
  const auto add = [&](double from, double to, bool unstable, std::string what) {
    const auto [low, high] = std::minmax({position(from), position(to)});
    marks.push_back({low, high, joint, unstable, std::move(what)});
  };
  const auto& steps = path.load_steps;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    if (steps[k].certificate.stable()) continue;
    const double t = steps[k].point.t;
    double from = t, to = t;
    if (k > 0)
      from = steps[k - 1].certificate.stable() ? edge_between(t, steps[k - 1].point.t, events)
                                               : steps[k - 1].point.t;
    if (k + 1 < steps.size() && steps[k + 1].certificate.stable())
      to = edge_between(t, steps[k + 1].point.t, events);
    add(from, to, true, "not stable");
  }
  std::vector<PathMark> joined;
  add_marks(joined, marks);
  marks = std::move(joined);
  if (steps.empty()) return marks;
  for (const Event& event : events) add(event.t, event.t, false, text_of_events({event}));
  return marks;
}

void add_marks(std::vector<PathMark>& marks, const std::vector<PathMark>& more) {
  for (PathMark mark : more) {
    std::erase_if(marks, [&](const PathMark& other) {
      if (other.unstable != mark.unstable || other.joint != mark.joint) return false;
      if (mark.from > other.to + touching || other.from > mark.to + touching) return false;
      mark.from = std::min(mark.from, other.from);
      mark.to = std::max(mark.to, other.to);
      return true;
    });
    marks.push_back(std::move(mark));
  }
}

std::string text_of_events(const std::vector<Event>& events) {
  std::string message, last;
  for (const Event& event : events) {
    const std::string text = text_of_event(event);
    if (text == last) continue;
    message += (message.empty() ? "" : "; ") + text;
    last = text;
  }
  return message;
}

std::string text_of_range(const PathMark& mark, const std::function<double(double)>& shown) {
  const double a = shown(mark.from), b = shown(mark.to);
  return mark.unstable ? fmt::format("{:.5g} to {:.5g}", std::max(a, b), std::min(a, b))
                       : fmt::format("{:.5g}", a);
}

/// The distance, mm, of a pushed joint from the position in which its constraint was set.
double EditSession::pushed_mm(const preset::Step& step) const {
  if (step.kind != preset::StepKind::push) return 0;
  const auto joint = joint_named(now_.scene->footprint, step.joint);
  const auto from =
      joint ? session_->constraint_origins.find(*joint) : session_->constraint_origins.end();
  if (from == session_->constraint_origins.end()) return 0;
  return (session_->nodes().col(*joint) - from->second).norm();
}

/// "Rₐ = 124.2 to 122.9 mm", "2.1 mm".
std::string EditSession::position_text(const PathMark& mark) const {
  if (mark.joint >= 0) return text_of_range(mark, [](double mm) { return mm; }) + " mm";
  if (now_.preset.footprint.kind != preset::FootprintKind::circle)
    return "progress " + text_of_range(mark, [](double at) { return at; });
  return "Rₐ = " + text_of_range(mark, [&](double at) { return now_.scene->radius_at(at); }) +
         " mm";
}

/// Adds the marks of a path, and a message if stability was lost and regained on it. Returns the
/// position of its first event, as text; empty if it has none.
std::string EditSession::note_path(const preset::Step& step, const simulate::PathSegment& path,
                                   double began_mm, bool began_stable, Report& report) {
  // a path that starts in an unstable state does not lose its stability
  if (!began_stable)
    std::erase_if(report.events, [](const Event& event) {
      return event.kind == Event::Kind::stability_lost && !event.to;
    });
  const bool snapped =
      std::ranges::any_of(report.events, [](const Event& e) { return e.to && e.jump; });
  const bool moves = step.kind == preset::StepKind::move,
             pushes = step.kind == preset::StepKind::push;
  // the marks of a branch do not apply to another one
  const auto lost = [](const PathMark& mark) { return mark.unstable; };
  if ((snapped || !(moves || pushes)) && std::erase_if(now_.marks, lost) > 0) {
    const double at = session_->progress();
    now_.path_left = fmt::format("{} at {}", moves || pushes ? "a snap" : word_of(step.kind),
                                 position_text({at, at}));
  }
  if (path.load_steps.empty()) return "";
  const auto joint = joint_named(now_.scene->footprint, step.joint);
  const double grew_mm = pushed_mm(step) - began_mm,
               end = std::max(1e-12, path.load_steps.back().point.t);
  const auto position = [&](double t) {
    return moves ? progress_at(t) : began_mm + grew_mm * t / end;
  };
  const auto marks = marks_of(path, report.events, pushes && joint ? *joint : -1, position);
  add_marks(now_.marks, marks);
  for (const PathMark& mark : marks)
    if (mark.unstable && report.certificate.stable() && !snapped)
      view_.message = view_.event =
          "stable again; not stable on the path at " + position_text(mark);
  const auto event = std::ranges::find(marks, false, &PathMark::unstable);
  return event == marks.end() ? "" : position_text(*event);
}

// States that were found.

/// Whether two states belong to the same shell on the same boundary.
bool EditSession::FoundState::same_boundary(const FoundState& other) const {
  return state.scene == other.state.scene && nearly(seen->progress, other.seen->progress, 1e-9) &&
         kind_of_change(state.preset, other.state.preset) <= ChangeKind::accuracy;
}

/// Whether two states are the same or mirror images.
bool EditSession::FoundState::same_as(const FoundState& other) const {
  return same_boundary(other) &&
         nearly(seen->frame.energies.total(), other.seen->frame.energies.total(), 1e-4) &&
         nearly(seen->frame.height_mm, other.seen->frame.height_mm, 1e-3);
}

/// Stores an equilibrium if another one of the same boundary was found before.
void EditSession::note_state() {
  if (!view_.stable() || !session_->constraints().empty() || only_coarse_mesh_ || now_.design ||
      !session_->dragged().isZero(0))
    return;
  FoundState here{now_, session_->save(), std::make_shared<const ShellView>(view_)};
  const auto is_here = [&](const FoundState& one) { return one.same_as(here); };
  // copied first: if memory runs out, last_found_ remains as it is
  std::optional<FoundState> before = here;
  before.swap(last_found_);
  if (std::ranges::any_of(found_, is_here) || found_.size() >= most_states) return;
  const bool among =
      std::ranges::any_of(found_, [&](const FoundState& one) { return one.same_boundary(here); });
  const bool snapped = before && before->same_boundary(here) && !before->same_as(here);
  if (!among && !snapped) return;
  if (!among) found_.push_back(std::move(*before));
  found_.push_back(std::move(here));
  std::vector<std::shared_ptr<const ShellView>> seen;
  for (const FoundState& one : found_) seen.push_back(one.seen);
  view_.found = std::make_shared<const decltype(seen)>(std::move(seen));
}

Result<void> EditSession::act(const Recall& command, const Watch&) {
  if (command.state < 0 || command.state >= int(found_.size()))
    return invalid("no other state of this shell was met yet");
  const FoundState& state = found_[std::size_t(command.state)];
  return restore({state.state, state.checkpoint}).map([&] {
    view_.message = fmt::format("state {}", command.state + 1);
  });
}

}  // namespace gridshell::window
