// A point load by prescribed displacement: one joint of an actuated gridshell is pushed along the
// normal [Baek 2018, 'Nonlocal Response to Point Loading'].
#pragma once

#include <memory>
#include <vector>

#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"

namespace gridshell::simulate {

/// Checks that a joint is not on the boundary. Errors (bad_input): the boundary constrains it.
Result<void> not_on_boundary(const Footprint& footprint, int joint);

/// The joint nearest to the position in a preset, as seen from the origin: by its direction on the
/// net, or in the unloaded shell (`joints`, 3 x n) if there is no net. Of equal distances the
/// smallest (i, j) is taken. Errors (bad_input): a joint by indices that the footprint does not
/// have.
Result<int> pushed_joint(const preset::Indentation& indentation, const Footprint& footprint,
                         const Eigen::Matrix3Xd& joints);

/// The push of a preset on an unloaded shell. Errors (bad_input) as pushed_joint().
Result<Push> push_of(const preset::Indentation& indentation, const Scene& scene,
                     const NestedShell& shell);

/// Actuates on the meshes of `plan` and constrains the joint: a path with a push, and no segment
/// yet. A path that is too_coarse() has no push. Errors: bad_input as push_of(), no_equilibrium (no
/// shell to push, or none with the constraint), cancelled.
Result<EquilibriumPath> prepare_push(const std::shared_ptr<const Scene>& scene,
                                     const preset::Indentation& indentation, const LevelPlan& plan,
                                     const Watch& watch, const RunContext& context = {});

/// Writes the push of a path into a frame: force, its error, and reach. With [indentation] the
/// force is the component of the joint's reaction along the push, and t the fraction of the depth;
/// steps are measured by Simulation::put_push(). The frame is that of the current state, or
/// `interpolated` between load steps.
void put_push(const EquilibriumPath& path, record::Frame& frame, double t, bool interpolated);

/// Actuates, then pushes. Frames sample the push at `progress` in [0, 1] (fraction of the depth;
/// with `unload` of loading and unloading); the first is the unloaded shell. The solver chooses its
/// load steps; with `own_steps` they have frames too. Every frame is certified: the residual
/// includes all forces except the one on the joint. Errors: bad_input, no_equilibrium (no shell to
/// push), cancelled, those of the sink.
Result<EquilibriumPath> run_indentation(std::shared_ptr<const Scene> scene,
                                        const preset::Indentation& indentation,
                                        const std::vector<double>& progress, bool own_steps,
                                        record::Sink& sink, Watch& watch,
                                        const RunContext& context);

}  // namespace gridshell::simulate
