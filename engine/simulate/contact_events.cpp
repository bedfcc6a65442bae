#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/simulate/equilibrium_path.h"
#include "engine/simulate/frames.h"

namespace gridshell::simulate {
namespace {

using record::ContactKind;
using record::Contacts;

constexpr int halvings = 5;      // of what lies between two load steps
constexpr int most_located = 6;  // events; those beyond lie between load steps
constexpr ContactKind kinds[] = {ContactKind::rods, ContactKind::joints, ContactKind::table};

const char* words_of(ContactKind kind) {
  switch (kind) {
    case ContactKind::rods:
      return "no rods";
    case ContactKind::joints:
      return "no joints";
    case ContactKind::table:
      return "no rod and the table";
  }
  return "";
}

/// A certified state of a segment.
struct Point {
  double t = 0;
  Contacts contacts;
};

/// From `before`, where it is not so, to `after`, where it is: whether parts of a kind touch, or no
/// longer touch.
class Bracket {
 public:
  Bracket(ContactKind kind, Point before, Point after)
      : kind_(kind), before_(std::move(before)), after_(std::move(after)) {}

  bool begins() const { return after_.contacts.deepest(kind_) != nullptr; }
  bool changes() const { return begins() != (before_.contacts.deepest(kind_) != nullptr); }
  void halve(EquilibriumPath& path, std::size_t segment, const Watch& watch) {
    for (int k = 0; k < halvings; ++k) {
      Point middle{0.5 * (before_.t + after_.t), {}};
      const Report report = certify_sample(path, {0, segment, middle.t, 0}, watch).report;
      if (report.end != Outcome::reached) return;
      middle.contacts = path.simulation.contacts();
      const bool there = middle.contacts.deepest(kind_) != nullptr;
      (there == begins() ? after_ : before_) = std::move(middle);
    }
  }
  ContactEvent event(std::size_t segment, const Footprint& footprint, const At& at) const {
    const double t = 0.5 * (before_.t + after_.t), error = 0.5 * std::abs(after_.t - before_.t);
    const record::Contact* first = after_.contacts.deepest(kind_);
    return {segment, t, error,
            first ? fmt::format("{} touch {}", text_of(*first, footprint), at(t, error))
                  : fmt::format("{} touch any more {}", words_of(kind_), at(t, error))};
  }

 private:
  ContactKind kind_;
  Point before_, after_;
};

/// What a path begins with.
void tell_first(EquilibriumPath& path, const Contacts& contacts, double t, const At& at) {
  for (const ContactKind kind : kinds)
    if (const record::Contact* first = contacts.deepest(kind))
      path.contacts.push_back({0, t, 0,
                               text_of(*first, path.simulation.scene().footprint) +
                                   " touch from the begin, " + at(t, {})});
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

void locate_contacts(EquilibriumPath& path, const At& at, const Watch& watch) {
  const Checkpoint stood = path.simulation.save();
  const Footprint& footprint = path.simulation.scene().footprint;
  path.contacts.clear();
  bool moved = false;
  for (std::size_t s = 0; s < path.segments.size(); ++s) {
    const PathSegment& segment = path.segments[s];
    const std::size_t first = path.contacts.size();
    std::vector<Point> points;
    for (const LoadStep& step : segment.load_steps) points.push_back({step.point.t, step.contacts});
    // a segment back is shown against its way
    if (segment.back) std::ranges::reverse(points);
    if (s == 0 && !points.empty()) tell_first(path, points[0].contacts, points[0].t, at);
    for (std::size_t k = 1; k < points.size(); ++k)
      for (const ContactKind kind : kinds) {
        Bracket bracket(kind, points[k - 1], points[k]);
        if (!bracket.changes() || watch.cancelled()) continue;
        if (path.single_motion && path.contacts.size() < most_located) {
          bracket.halve(path, s, watch);
          moved = true;
        }
        path.contacts.push_back(bracket.event(s, footprint, at));
      }
    const double way = segment.back ? -segment.sign() : segment.sign();
    std::ranges::stable_sort(path.contacts.begin() + long(first), path.contacts.end(), {},
                             [way](const ContactEvent& event) { return way * event.t; });
  }
  if (moved) path.simulation.restore(stood);
}

}  // namespace gridshell::simulate
