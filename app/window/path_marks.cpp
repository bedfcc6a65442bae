#include "app/window/shell_view.h"

#include <fmt/format.h>

#include <algorithm>

namespace gridshell::window {
namespace {

/// Where between a load step that is not stable and one that is an event says that stability ends,
/// else the first: of what lies between nothing is known.
double edge_between(double unstable, double stable, const std::vector<Event>& events) {
  for (const Event& event : events)
    if (event.kind == Event::Kind::stability_lost && (event.t - unstable) * (event.t - stable) <= 0)
      return event.t;
  return unstable;
}

constexpr double touching = 1e-9;

}  // namespace

std::vector<PathMark> marks_of(const PathRecord& path, const std::vector<Event>& events, int joint,
                               const std::function<double(double)>& place) {
  std::vector<PathMark> marks;
  const auto add = [&](double from, double to, bool unstable, std::string what) {
    const auto [low, high] = std::minmax({place(from), place(to)});
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

namespace {

std::string text_of_event(const Event& event) {
  switch (event.kind) {
    case Event::Kind::stability_lost:
      return !event.to    ? "stability lost"
             : event.leap ? "stability lost: snapped to another state"
                          : "the path branches";
    case Event::Kind::turned_back:
      return event.to ? "the path turned back: snapped to another state" : "path turned back";
    case Event::Kind::locked:
      return "the rods are at their length";
    case Event::Kind::overbent:
      return "a rod is strained as far as [limits] " + event.what + " allows";
    case Event::Kind::contact:
      return "beyond, there touch " + event.what;
  }
  return "";
}

}  // namespace

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

std::string text_of_place(const PathMark& mark, const std::function<double(double)>& shown) {
  const double a = shown(mark.from), b = shown(mark.to);
  return mark.unstable ? fmt::format("{:.5g} to {:.5g}", std::max(a, b), std::min(a, b))
                       : fmt::format("{:.5g}", a);
}

}  // namespace gridshell::window
