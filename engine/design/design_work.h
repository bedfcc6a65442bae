// What every design works on, whether it goes to its end or is watched and stopped.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/design/optimise.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

/// Edges a segment: optima on 4 are saddles of the shell.
inline constexpr int designed_on = 16, certified_on = 32;

struct DesignWork {
  std::shared_ptr<const Scene> scene;        ///< before anything is moved
  std::unique_ptr<MovedShell> coarse, fine;  ///< on the two meshes
  DesignTarget target;
  int symmetries = 1;
  DesignVariables variables;
  OptimiseOptions options;
  double jump_mm = 0;  ///< Newton's way from a prediction that is believed
};

/// Whether a shell has what a design needs. Errors: bad_input (nothing to vary, no net, a model
/// beyond the bend rung).
Result<void> can_be_designed(const preset::Preset& preset, const Scene& scene);

/// The work of a preset's [inverse] on a shell of its scene, at rest on the mesh that is designed
/// on. Errors: bad_input (ends that have nothing of what is to vary), no_equilibrium (on the mesh
/// that certifies), cancelled.
Result<DesignWork> begin_design(const preset::Preset& preset, std::shared_ptr<const Scene> scene,
                                std::unique_ptr<MovedShell> coarse, const Watch& watch = unwatched);

/// What a design aims at, for the joints of a scene that has a net. Errors: those of the net.
Result<DesignTarget> design_target(const Scene& scene, preset::Target kind);

/// Pins and legs as a builder measures them; 0: exact.
ShellEnds rounded(ShellEnds ends, double to_mm);

}  // namespace gridshell
