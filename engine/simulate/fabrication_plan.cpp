#include "engine/simulate/run.h"

#include <fmt/format.h>
#include <cmath>
#include <utility>

#include "engine/core/try.h"
#include "engine/preset/preset.h"
#include "engine/scene/rods_and_joints.h"
#include "engine/scene/scene.h"
#include "engine/simulate/frames.h"

namespace gridshell::simulate {
namespace {

using exports::CutRod;
using exports::Pin;

exports::CutSection section_of(const preset::Rod& rod) {
  if (rod.rectangular()) return {0, rod.width_mm, rod.thickness_mm, rod.wall_mm};
  return {rod.diameter_mm, 0, 0, rod.wall_mm};
}

CutRod cut(const FootprintRod& rod, const preset::Rod& made_of, const Scene& scene) {
  CutRod piece;
  piece.name = name_of(rod);
  piece.section = section_of(made_of);
  const double begin = rod.span.begin - rod.tail_begin, end = rod.span.end + rod.tail_end;
  const auto at = [&](double along) -> Eigen::Vector2d {
    return scene.flat.at(rod.at(along)).head<2>();
  };
  piece.length_mm = end - begin;
  piece.begin = at(begin);
  piece.end = at(end);
  for (const double mark : rod.marks) piece.joint_marks_mm.push_back(mark - begin);
  if (rod.tail_begin > 0) piece.pin_marks_mm.push_back(rod.tail_begin);
  if (rod.tail_end > 0) piece.pin_marks_mm.push_back(rod.span.end - begin);
  piece.leg_begin_mm = piece.joint_marks_mm.front() - rod.tail_begin;
  piece.leg_end_mm = piece.length_mm - rod.tail_end - piece.joint_marks_mm.back();
  if (rod.begin == RodEnd::joined) piece.leg_begin_mm = std::nan("");
  if (rod.end == RodEnd::joined) piece.leg_end_mm = std::nan("");
  for (std::size_t k = 1; k + 1 < rod.path.size(); ++k)
    piece.corners.push_back(at(rod.path[k].w()));
  piece.free_begin = rod.begin == RodEnd::free;
  piece.free_end = rod.end == RodEnd::free;
  return piece;
}

void add_pins(const FootprintRod& rod, Eigen::Index r, const CutRod& piece, const Scene& scene,
              std::vector<Pin>& pins) {
  const auto add = [&](bool at_end, RodEnd kind, double tail) {
    if (!is_fixed(kind)) return;
    const Eigen::Index end = 2 * r + at_end;
    const std::string name = exports::pin_name(piece.name, at_end);
    const double hole = piece.section.hole_mm();
    pins.push_back({name, scene.motion.end.col(end), true, hole});
    if (tail > 0) pins.push_back({name + ", far", scene.motion.end_far.col(end), false, hole});
  };
  add(false, rod.begin, rod.tail_begin);
  add(true, rod.end, rod.tail_end);
}

/// A sentence on what a builder does in a step; empty if the step is not one of building.
std::string hand_text(const preset::Step& step, const Scene& scene) {
  if (step.kind == preset::StepKind::tighten)
    return fmt::format(
        "Tighten the bolts of all {} joints{}.", scene.footprint.joints.size(),
        step.stiffness_Nmm > 0
            ? fmt::format(" so that each resists turning by {:g} N mm a rad", step.stiffness_Nmm)
            : ", so that rods keep their angles there");
  if (step.kind != preset::StepKind::brace) return "";
  const std::size_t cells = step.cells.empty() ? scene.footprint.cells.size() : step.cells.size();
  return fmt::format("Brace {}{} cells along {} by {} of EA = {:g} N, from joint to joint.",
                     step.cells.empty() ? "all " : "", cells,
                     step.diagonals == preset::Diagonals::both ? "both diagonals" : "one diagonal",
                     step.brace == preset::BraceKind::cable ? "cables" : "struts", step.EA_N);
}

}  // namespace

Result<exports::FabricationPlan> fabrication_plan_of(const preset::Preset& preset) {
  TRY(scene, scene_of(preset));
  TRY(made_of, rods_of(preset, scene->footprint));
  exports::FabricationPlan work;
  work.title = preset::title_or_name(preset);
  work.spacing_mm = scene->footprint.spacing;
  for (const preset::Step& step : preset.step)
    if (const std::string text = hand_text(step, *scene); !text.empty()) work.hand.push_back(text);
  for (std::size_t r = 0; r < scene->footprint.rods.size(); ++r) {
    const FootprintRod& rod = scene->footprint.rods[r];
    work.rods.push_back(cut(rod, (*made_of)[r], *scene));
    add_pins(rod, Eigen::Index(r), work.rods.back(), *scene, work.pins);
  }
  for (const FootprintJoint& joint : scene->footprint.joints)
    work.joints.push_back(scene->flat.at({joint.u, joint.v}).head<2>());
  work.original_boundary = scene->original_boundary.topRows<2>();
  work.actuated_boundary = scene->actuated_boundary;
  work.in_space = scene->footprint.in_space();
  work.original_radius_mm = scene->radius_begin_mm;
  work.actuated_radius_mm = scene->radius_end_mm;
  return exports::spliced(std::move(work), preset.figure.stock_mm);
}

}  // namespace gridshell::simulate
