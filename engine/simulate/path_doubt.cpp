#include "engine/simulate/path_doubt.h"

#include <fmt/format.h>
#include <cmath>

#include "engine/simulate/shell_symmetry.h"

namespace gridshell::simulate {
namespace {

/// A sentence on a state that is closer to its own image under a symmetry than expected, by more
/// than its error. The meshes agree on such states, since each takes one for the other.
std::string near_image(const EquilibriumPath& path) {
  const Simulation& simulation = path.simulation;
  const Scene& scene = simulation.scene();
  if (path.of_steps() || !simulation.constraints().empty()) return "";
  constexpr double indistinguishable = 0.02;  // in units of d
  double least = scene.tolerance * scene.length_scale_mm / 4;
  if (const double error = simulation.certificate().error_estimate_mm; 2 * error > least)
    least = 2 * error;
  const double off = distance_of_image(simulation, least);
  if (!(off < indistinguishable * scene.footprint.spacing)) return "";
  return fmt::format(
      "the state lies {:.2g} mm from its own image under a symmetry of the shell, "
      "more than its error: either several states nearly coincide and it is one of them by chance, "
      "or on finer meshes (a smaller [accuracy] tolerance) it is symmetric",
      off);
}

/// A sentence on a path that enters a branch long after the bifurcation. If several modes lose
/// stability at once, it may enter another branch.
std::string late_on_branch(const EquilibriumPath& path) {
  constexpr double late = 0.05;  // in the path parameter
  for (const PathSegment& segment : path.segments)
    for (const Event& event : segment.report.events)
      if (!path.of_steps() && !event.jump && event.to && std::abs(*event.to - event.t) > late)
        return fmt::format(
            "a branch bifurcates from the path at progress {:.4f}, and its first state was "
            "found at progress {:.4f}: if several branches bifurcate there, which one it is may "
            "depend on the mesh",
            progress_at(event.t), progress_at(*event.to));
  return "";
}

/// A sentence on a rod that may turn, whose state is then one of many.
std::string turns_freely(const EquilibriumPath& path) {
  const Scene& scene = path.simulation.scene();
  const double off = off_free_axis(path.simulation);
  if (!(off > scene.tolerance * scene.length_scale_mm)) return "";
  return fmt::format(
      "a rod is {:.3g} mm off the line of its supports or joints and turns about it without "
      "force: its position around that line is one of many",
      off);
}

}  // namespace

std::string doubt_about(const EquilibriumPath& path) {
  if (!path.mesh_disagreement.empty()) return path.mesh_disagreement;
  if (!path.doubt_before.empty()) return path.doubt_before;
  for (const auto& look : {late_on_branch, near_image, turns_freely})
    if (std::string doubt = look(path); !doubt.empty()) return doubt;
  return "";
}

}  // namespace gridshell::simulate
