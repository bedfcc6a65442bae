// Inverse design: changes the ends and rods of a preset so that its shell is nearer to the target.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/design/optimise.h"
#include "engine/preset/preset.h"
#include "engine/scene/scene.h"

namespace gridshell {

struct Assembly;

/// Edges per segment of a design: an optimum found with 4 edges is a saddle of the shell.
inline constexpr int designed_on = 16, certified_on = 32;

/// The target of a design for the joints of a scene, which must have a net. Errors: those of the
/// net.
Result<DesignTarget> design_target(const Scene& scene, preset::Target kind);

/// A shell with given ends, in equilibrium on one mesh.
struct DesignedState {
  int edges_per_segment = 0;
  double max_mm = 0, mean_mm = 0;  ///< distances of the joints from the target
  Energies energies;               ///< mJ
  double eigenvalue = 0;           ///< smallest, N/mm^2
  double largest_leg_force_N = 0, largest_leg_compression_N = 0;
  double residual_N = 0;
};

/// Shells with fabrication errors: every pin and leg has a normally distributed error.
struct FabricationErrors {
  double sigma_mm = 0;
  int samples = 0, lost = 0;  ///< lost: no stable equilibrium found nearby
  double max_mm = 0;          ///< mean over the samples of the largest distance of a joint
  double worst_mm = 0;        ///< the largest distance of a joint in any sample
  double mean_mm = 0;         ///< mean over joints and samples
};

struct DesignResult {
  double length_scale_mm = 0;
  std::vector<DesignedState> before, after;  ///< with 16 and with 32 edges per segment
  std::optional<DesignedState> rounded;      ///< at 32 edges
  std::vector<FabricationErrors> fabricated;
  std::vector<DesignStep> steps;
  std::vector<DesignVariable> variables;
  Eigen::VectorXd q;  ///< values of the variables
  int kept = 0;       ///< the accepted step: the last that both meshes find stable enough
  int symmetries = 1, free_variables = 0;
  double largest_move_mm = 0, largest_turn_deg = 0;
  double largest_thickening = 0;            ///< change of a diameter over the one before
  double thinnest_mm = 0, thickest_mm = 0;  ///< diameters of the designed rods
  double cpu_s = 0;
  preset::Points table, rounded_table;    ///< rows for `[ends] table`
  std::vector<int> row_of_end;            ///< row of each end in both tables; -1: a free end
  preset::Points rods_before, rod_table;  ///< rows for `[rod] table`
};

/// Designs the shell of a preset as its [inverse] table says: on meshes of 16 edges per segment,
/// since optima on 4 are saddles of the shell; certified on 32. Errors: bad_input (no variables, no
/// net, a rod model other than bend), no_equilibrium (of the initial shell, of the rounded one),
/// cancelled.
Result<DesignResult> design(const preset::Preset& preset, Watch& watch,
                            const std::function<void(const DesignStep&)>& seen = {});

/// The points of the target that are nearest to nodes of a shell (3 x nodes); `flat`: positions of
/// the nodes in the flat grid. Where the net does not extend to a node, the node itself is
/// returned. The preset's footprint must be a net. Errors: those of building a scene.
Result<Eigen::Matrix3Xd> nearest_to(const preset::Preset& preset, const Eigen::Matrix3Xd& flat,
                                    const Eigen::Matrix3Xd& nodes);

// An interactive design: the user sees each step and may stop it.

/// A step that is confirmed with 16 and 32 edges per segment: in equilibrium, stable, above the
/// least stability.
struct CertifiedStep {
  const DesignStep& step;
  // on 16 edges per segment
  const RodMesh& mesh;
  const Model& model;
  const State& state;
  const Assembly& forces;
  const ShellEnds& shell_ends;
  double residual_N = 0;
  const Eigen::VectorXd& distances_mm;  ///< distances of the joints from the target
  double eigenvalue = 0;                ///< smallest on 32 edges, N/mm^2
  preset::Points ends, rods;            ///< `[ends] table`, `[rod] table`
};

/// Current state of the shell to be designed: an equilibrium of the scene's own model.
struct DesignStart {
  std::shared_ptr<const Scene> scene;
  const RodMesh& mesh;
  const Model& model;
  const State& state;
};

/// How an interactive design ended.
struct LiveDesignResult {
  bool stopped = false;  ///< whether it was stopped before the optimum
  int iterations = 0;    ///< including refused ones
  /// Largest distance at 32 edges with pins and legs rounded to `[inverse] round_mm`; empty if that
  /// shell has no equilibrium, or after a stop.
  std::optional<double> rounded_max_mm;
};

/// Optimises as design() does and passes on each step after its certification, the initial state
/// first; steps that the finer mesh does not confirm are left out. After a cancel, also within a
/// step, the result is the last step passed on. It does not simulate fabrication errors. Errors: as
/// design(); cancelled before the initial state was passed on.
Result<LiveDesignResult> design_live(const preset::Preset& preset, const DesignStart& from,
                                     int most_iterations, const Watch& watch,
                                     const std::function<void(const CertifiedStep&)>& seen);

}  // namespace gridshell
