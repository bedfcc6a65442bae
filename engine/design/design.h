// Inverse design: from a preset whose shell misses its surface to one whose shell meets it.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/design/optimise.h"
#include "engine/preset/preset.h"

namespace gridshell {

/// A shell with given ends, at rest on one mesh.
struct DesignedState {
  int edges_per_segment = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints from the target
  Energies energies;               ///< mJ
  double eigenvalue = 0;           ///< smallest, N/mm^2
  double largest_leg_force_N = 0, largest_leg_compression_N = 0;
  double residual_N = 0;
};

/// Shells as a builder would make them: every pin and leg off by a normal error.
struct Fabricated {
  double sigma_mm = 0;
  int samples = 0, lost = 0;  ///< lost: came to no stable rest nearby
  double max_mm = 0;          ///< largest distance of a joint, over the samples the mean of it
  double worst_mm = 0;        ///< and the largest of all
  double mean_mm = 0;         ///< mean over joints and samples
};

struct Designed {
  double length_scale_mm = 0;
  std::vector<DesignedState> before, after;  ///< at 16 and at 32 edges a segment
  std::optional<DesignedState> rounded;      ///< at 32 edges
  std::vector<Fabricated> fabricated;
  std::vector<DesignStep> steps;
  std::vector<DesignVariable> variables;
  Eigen::VectorXd q;  ///< of the variables
  int kept = 0;       ///< the step that was: the last that both meshes find stable enough
  int symmetries = 1, free_variables = 0;
  double largest_move_mm = 0, largest_turn_deg = 0;
  double largest_thickening = 0;            ///< change of a diameter over the one before
  double thinnest_mm = 0, thickest_mm = 0;  ///< of the designed rods
  double cpu_s = 0;
  preset::Points table, rounded_table;    ///< of `[ends] table`
  std::vector<int> row_of_end;            ///< in them; -1: a free end
  preset::Points rods_before, rod_table;  ///< of `[rod] table`
};

/// Designs the shell of a preset as its [inverse] table says: on meshes of 16 edges a segment, for
/// optima on 4 are saddles of the shell; certified on 32. Errors: bad_input (nothing to vary, no
/// net, a model beyond the bend rung), no_equilibrium (of the shell as it is, of the rounded one),
/// cancelled.
Result<Designed> design(const preset::Preset& preset, Watch& watch,
                        const std::function<void(const DesignStep&)>& seen = {});

/// The nearest points of the target to nodes of a shell (3 x nodes) whose places in the flat are
/// `flat`; where the net is not known there, the nodes themselves. Errors: as of a scene.
Result<Eigen::Matrix3Xd> nearest_to(const preset::Preset& preset, const Eigen::Matrix3Xd& flat,
                                    const Eigen::Matrix3Xd& nodes);

}  // namespace gridshell
