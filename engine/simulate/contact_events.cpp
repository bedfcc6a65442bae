#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>

#include "engine/elastic/model.h"
#include "engine/simulate/equilibrium_path.h"
#include "engine/simulate/frames.h"

namespace gridshell::simulate {
namespace {

using record::ContactKind;
using record::Contacts;

constexpr int halvings = 5;  // of the interval between two load steps
constexpr ContactKind kinds[] = {ContactKind::rods, ContactKind::joints, ContactKind::table};

const char* end_text(ContactKind kind) {
  switch (kind) {
    case ContactKind::rods:
      return "rods no longer touch";
    case ContactKind::joints:
      return "joints no longer touch";
    case ContactKind::table:
      return "no rod touches the table any longer";
  }
  return "";
}

/// A state of a segment.
struct Point {
  double t = 0;
  Contacts contacts;
};

/// An interval of the path parameter. If parts of one kind touch at only one of its ends, they
/// begin to touch, or separate, in it.
class Bracket {
 public:
  Bracket(ContactKind kind, Point before, Point after)
      : kind_(kind), before_(std::move(before)), after_(std::move(after)) {}

  bool begins() const { return after_.contacts.deepest(kind_) != nullptr; }
  bool changes() const { return begins() != (before_.contacts.deepest(kind_) != nullptr); }
  /// Halves the interval several times, by the contacts at its middle.
  void halve(const std::function<Contacts(double t)>& contacts_at) {
    for (int k = 0; k < halvings; ++k) {
      const double middle = 0.5 * (before_.t + after_.t);
      Point point{middle, contacts_at(middle)};
      const bool there = point.contacts.deepest(kind_) != nullptr;
      (there == begins() ? after_ : before_) = std::move(point);
    }
  }
  ContactEvent event(std::size_t segment, const Footprint& footprint, const At& at) const {
    const double t = 0.5 * (before_.t + after_.t), error = 0.5 * std::abs(after_.t - before_.t);
    const record::Contact* first = after_.contacts.deepest(kind_);
    return {segment, t, error,
            first ? fmt::format("{} touch {}", text_of(*first, footprint), at(t, error))
                  : fmt::format("{} {}", end_text(kind_), at(t, error))};
  }

 private:
  ContactKind kind_;
  Point before_, after_;
};

/// Writhe of a closed polygon, one column per corner: the sum of the signed solid angles of all
/// pairs of edges, over 2 pi [Klenin, Langowski 2000, method 1a].
double writhe_of(const Eigen::Matrix3Xd& corners) {
  constexpr double flat = 1e-12;  // relative volume that rounding leaves
  const Eigen::Index count = corners.cols();
  double sum = 0;
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = i + 2; j < count; ++j) {
      if (i == 0 && j + 1 == count) continue;  // adjacent edges contribute nothing
      const Eigen::Vector3d a = corners.col(i), b = corners.col(i + 1), c = corners.col(j),
                            d = corners.col((j + 1) % count);
      const double volume = (d - c).cross(b - a).dot(c - a);
      // in one plane they see nothing of one another either; on one line rounding gives the normals
      if (std::abs(volume) < flat * (d - c).norm() * (b - a).norm() * (c - a).norm()) continue;
      const std::array<Eigen::Vector3d, 4> sides{
          (c - a).cross(d - a).stableNormalized(), (d - a).cross(d - b).stableNormalized(),
          (d - b).cross(c - b).stableNormalized(), (c - b).cross(c - a).stableNormalized()};
      double angle = 0;
      for (std::size_t k = 0; k < 4; ++k)
        angle += std::asin(std::clamp(sides[k].dot(sides[(k + 1) % 4]), -1.0, 1.0));
      sum += std::copysign(angle, volume);
    }
  return sum / (2 * std::numbers::pi);
}

/// Twist over 2 pi plus writhe of a closed rod. It changes only if the rod passes through itself,
/// then by 2 [Calugareanu 1961, Fuller 1971].
double linking_of(const Model& model, const Model::Rod& rod, const State& state) {
  double twist = 0;
  const auto add = [&](int number) {
    const ModelBend& bend = model.bends[std::size_t(number)];
    twist +=
        model.angle(state.x, bend.f) - model.angle(state.x, bend.e) + state.reference_twist[number];
  };
  Eigen::Matrix3Xd corners(3, Eigen::Index(rod.edges.size()));
  for (std::size_t k = 0; k < rod.edges.size(); ++k) {
    corners.col(Eigen::Index(k)) = state.x.col(model.edges[std::size_t(rod.edges[k])].from);
    if (k > 0) add(rod.first_bend + int(k) - 1);
  }
  if (rod.closing_bend >= 0) add(rod.closing_bend);
  return twist / (2 * std::numbers::pi) + writhe_of(corners);
}

/// A load step and its segment, in the order in which load steps are shown.
struct Shown {
  std::size_t segment;
  const State* state;
  double t;
};

/// Finds where closed rods pass through themselves, by their linking numbers. No state on the path
/// may show such a contact, if a snap leads past it.
std::vector<ContactEvent> self_passages(const EquilibriumPath& path) {
  const NestedShell& shell = path.simulation.shell();
  const Model& model = shell.model();
  const Scene& scene = path.simulation.scene();
  std::vector<ContactEvent> events;
  if (!model.has_spins() || std::ranges::none_of(model.rods, &Model::Rod::closed)) return events;
  const State drawn = start_state(
      model, columns_of(shell.finest(), model, drawn_nodes(shell.finest(), scene.flat)));
  std::vector<Shown> shown{{0, &drawn, 0}};
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const auto first = std::ptrdiff_t(shown.size());
    for (const LoadStep& step : path.segments[s].load_steps)
      if (step.point.state.x.cols() == model.columns())
        shown.push_back({s, &step.point.state, step.point.t});
    if (path.segments[s].back) std::reverse(shown.begin() + first, shown.end());
  }
  for (std::size_t r = 0; r < model.rods.size(); ++r) {
    if (!model.rods[r].closed) continue;
    const auto turns = [&](std::size_t k) {
      return linking_of(model, model.rods[r], *shown[k].state);
    };
    const std::function<void(std::size_t, double, std::size_t, double)> look =
        [&](std::size_t a, double at_a, std::size_t b, double at_b) {
          if (std::abs(at_b - at_a) < 0.5) return;
          if (b - a > 1) {
            const std::size_t middle = (a + b) / 2;
            const double there = turns(middle);
            look(a, at_a, middle, there);
            look(middle, there, b, at_b);
            return;
          }
          const bool before = a == 0;
          const double from = before ? shown[b].t : shown[a].t;
          events.push_back(
              {shown[b].segment, 0.5 * (from + shown[b].t), 0.5 * std::abs(shown[b].t - from),
               fmt::format(
                   "{} passed through itself {}{}", name_of(scene.footprint.rods[r]),
                   before ? "before the first state, " : "",
                   path.at_on(path.segments[shown[b].segment])(0.5 * (from + shown[b].t), {}))});
        };
    look(0, turns(0), shown.size() - 1, turns(shown.size() - 1));
  }
  return events;
}

}  // namespace

std::string name_of(const FootprintRod& rod) {
  const bool of_grid = rod.family != Family::other;
  return of_grid ? fmt::format("{}{:+}", name_of(rod.family), rod.index)
                 : fmt::format("{}{}", name_of(rod.family), rod.index);
}

std::string text_of(const record::Contact& contact, const Footprint& footprint) {
  const auto rod = [&](int k) {
    const std::string name = name_of(footprint.rods[std::size_t(k)]);
    return name.starts_with("rod ") ? name.substr(4) : name;
  };
  const auto joint = [&](int k) {
    const FootprintJoint& of = footprint.joints[std::size_t(k)];
    return fmt::format("({}, {})", of.i, of.j);
  };
  const auto parts = [&] {
    switch (contact.kind) {
      case record::ContactKind::rods:
        if (contact.first == contact.second)
          return fmt::format("rod {} and itself", rod(contact.first));
        return fmt::format("rods {} and {}", rod(contact.first), rod(contact.second));
      case record::ContactKind::joints:
        return fmt::format("joints {} and {}", joint(contact.first), joint(contact.second));
      case record::ContactKind::table:
        return fmt::format("rod {} and the table", rod(contact.first));
    }
    return std::string();
  };
  const Eigen::Vector3d& at = contact.at;
  return fmt::format("{} at ({:.1f}, {:.1f}, {:.1f}) mm", parts(), at.x(), at.y(), at.z());
}

std::vector<ContactEvent> contact_events(const EquilibriumPath& path) {
  const NestedShell& shell = path.simulation.shell();
  const Scene& scene = path.simulation.scene();
  std::vector<ContactEvent> events = self_passages(path);
  std::optional<record::ContactSearch> search;
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const PathSegment& segment = path.segments[s];
    const At at = path.at_on(segment);
    const std::size_t first = events.size();
    std::vector<const LoadStep*> steps;
    for (const LoadStep& step : segment.load_steps) steps.push_back(&step);
    // of a step without a path only its result is known
    if (path.of_steps() && steps.size() == 1) {
      const LoadStep& before =
          (s > 0 ? path.segments[s - 1] : path.earlier.back()).load_steps.back();
      const double t = segment.end();
      for (const ContactKind kind : kinds)
        if (const record::Contact* touch = before.contacts.deepest(kind); touch && s == 0)
          events.push_back(
              {0, t, 0, text_of(*touch, scene.footprint) + " touch before it already"});
      for (const ContactKind kind : kinds)
        if (const Bracket step(kind, {t, before.contacts}, {t, steps[0]->contacts}); step.changes())
          events.push_back(step.event(s, scene.footprint,
                                      [](double, std::optional<double>) { return "at its end"; }));
      continue;
    }
    // a segment back is shown in reverse
    if (segment.back) std::ranges::reverse(steps);
    if (s == 0 && !steps.empty())
      for (const ContactKind kind : kinds)
        if (const record::Contact* touch = steps[0]->contacts.deepest(kind))
          events.push_back({0, steps[0]->point.t, 0,
                            text_of(*touch, scene.footprint) +
                                " touch in the first state already, " + at(steps[0]->point.t, {})});
    for (std::size_t k = 1; k < steps.size(); ++k) {
      const LoadStep &a = *steps[k - 1], &b = *steps[k];
      const bool smooth = goes_on_between(segment, segment.back ? b : a, segment.back ? a : b);
      // load steps of the branch, up to two on each side
      std::vector<const PathPoint*> around;
      const auto same_branch = [&](std::size_t n, std::size_t next) {
        const LoadStep &first = *steps[segment.back ? next : n],
                       &last = *steps[segment.back ? n : next];
        return goes_on_between(segment, first, last);
      };
      if (smooth) {
        if (k > 1 && same_branch(k - 2, k - 1)) around.push_back(&steps[k - 2]->point);
        around.insert(around.end(), {&a.point, &b.point});
        if (k + 1 < steps.size() && same_branch(k, k + 1)) around.push_back(&steps[k + 1]->point);
      }
      std::erase_if(around, [](const PathPoint* p) { return p->velocity.x.size() == 0; });
      for (const ContactKind kind : kinds) {
        Bracket bracket(kind, {a.point.t, a.contacts}, {b.point.t, b.contacts});
        if (!bracket.changes()) continue;
        if (around.size() > 1 && a.point.state.x.cols() == shell.model().columns()) {
          if (!search) search.emplace(parts_of(scene, shell.finest()));
          bracket.halve([&](double t) {
            const State state = between(shell.model(), around, t);
            return search->in(nodes_of(shell.finest(), shell.model(), state.x));
          });
        }
        events.push_back(bracket.event(s, scene.footprint, at));
      }
    }
    const double sign = segment.back ? -segment.sign() : segment.sign();
    std::ranges::stable_sort(events.begin() + long(first), events.end(), {},
                             [sign](const ContactEvent& event) { return sign * event.t; });
  }
  for (ContactEvent& event : events)
    if (const std::string& step = path.segments[event.segment].step; !step.empty())
      event.text = fmt::format("step {} ({}): {}", event.segment + 1, step, event.text);
  return events;
}

}  // namespace gridshell::simulate
