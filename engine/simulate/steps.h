// The steps of a preset as commands to a simulation: apply_step() turns a [[step]] into calls, for
// runs and for the window.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/preset/preset.h"
#include "engine/record/trajectory.h"
#include "engine/simulate/equilibrium_path.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// A step as text for messages: "push [2, -1]".
std::string text_of(const preset::Step& step);

/// The cells that a step names, all if it names none. Errors (bad_input): the footprint has no such
/// cell.
Result<std::vector<FootprintCell>> cells_of(const preset::Step& step, const Footprint& footprint);

/// The progress to which a move step goes.
double progress_of(const preset::Step& step, const Scene& scene);

/// Checks that steps name existing joints and cells, and release only what an earlier step fixed.
/// Errors: bad_input with the step's number.
Result<void> check_steps(const std::vector<preset::Step>& steps, const Footprint& footprint);

/// Applies one step. A step that ends early leaves the simulation in its last certified state;
/// `rest`, `jitter` and a `release` without an equilibrium leave it in the state before them.
/// Errors (bad_input): a joint or an edge point that does not exist, nothing to release, individual
/// displacements of edge points whose rods' directions are prescribed. `path` gets the load steps
/// of a push, a joint actuation, or a move that displaces no edge point by itself.
Result<Report> apply_step(Simulation& simulation, const preset::Step& step, const Watch& watch,
                          PathSegment* path = nullptr);

// A run of a preset with steps: the shell is actuated, then the steps are applied in order.

/// Distributes `frames` over the steps; the first frame is the shell before them. Each step has at
/// least one; the others are distributed evenly over the steps with a sampled path: pushes, joint
/// actuations and moves of the whole boundary.
std::vector<int> frames_of_steps(const std::vector<preset::Step>& steps, int frames);

/// Applies the steps in order until one ends early, which is then the path's limit, and passes
/// certified frames to the sink: the shell before the steps, and as many frames of each step as
/// frames_of_steps() gives. Frames only sample the paths of the steps. Meshes are chosen and events
/// confirmed as for a path (mesh_policy.h). Errors: bad_input as apply_step(), no_equilibrium (no
/// initial shell), cancelled, those of the sink.
Result<EquilibriumPath> run_steps(const std::shared_ptr<const Scene>& scene,
                                  const std::vector<preset::Step>& steps, int frames,
                                  record::Sink& sink, Watch& watch, const RunContext& context = {});

// Stiffening and loading of a formed shell: bolts, braces, load cases.

/// Fixes the current angles of all joints. Errors (bad_input): a shell that is still flat.
Result<Report> tighten(Simulation& simulation, const preset::Step& step, const Watch& watch);

/// Whether the first step opens the joints of a network that remains as drawn until then.
bool opens_as_drawn(const std::vector<preset::Step>& steps, const Scene& scene);

/// Bolts at the joints that a step opens, with the drawn angles as natural angles. Errors
/// (bad_input) as open().
Result<Bolts> bolts_as_drawn(const preset::Step& step, const Footprint& footprint);

/// Drives the crossing angles of joints linearly along a path by bolts: each is a spring at the
/// joint, tightened at its current angle, whose natural angle is driven to the target of the step.
/// With the drive `mean` one torque, equal at all joints, keeps their mean angle at the target.
/// Bolts of another stiffness or drive are replaced first: where two rods cross the new ones have
/// their torque.
/// Errors (bad_input): a flat shell, a joint where not two rods cross, an angle that no joint can
/// have.
Result<Report> open(Simulation& simulation, const preset::Step& step, const Watch& watch,
                    PathSegment* path);

/// Text on the crossing angles that a joint actuation reached: "joints at 62.1 degrees on average,
/// ...".
std::string text_of_opened(const Simulation& simulation);

/// Adds diagonals to cells, with their present lengths as natural lengths. Errors (bad_input): a
/// cell that does not exist, a flat shell.
Result<Report> brace(Simulation& simulation, const preset::Step& step, const Watch& watch);

/// Removes all bolts or braces; the shell relaxes to the equilibrium nearby. Errors (bad_input):
/// there are none.
Result<Report> take_out(Simulation& simulation, preset::Released what, const Watch& watch);

/// Sets the factor of the scene's load case of that name. Errors (bad_input): there is no such
/// case.
Result<Report> bring_case(Simulation& simulation, const std::string& name, double factor,
                          const Watch& watch);

}  // namespace gridshell::simulate
