// Frames, layouts and summaries of certified states for the record.
#pragma once

#include "engine/preset/preset.h"
#include "engine/record/summary.h"
#include "engine/record/trajectory.h"
#include "engine/simulate/simulation.h"

namespace gridshell::simulate {

/// The part of a summary that is known before anything is solved: the preset, its model and why,
/// rods, joints, cells.
record::Summary summary_before(const preset::Preset& preset, const Scene& scene);

/// A sentence on ends of rods that are ball joints, since their joints have no law, in a network
/// where other joints have one; empty: there are none.
std::string ends_on_balls(const Scene& scene);

/// The parts of the shell on a mesh: rods, joints and their sizes, and a table.
record::Layout parts_of(const Scene& scene, const RodMesh& mesh);

/// "u+3": a rod by its family and its index in it.
std::string name_of(const FootprintRod& rod);

/// Text on which parts touch, and where: "rods u+3 and v-1 at (10.0, 2.5, 48.1) mm".
std::string text_of(const record::Contact& contact, const Footprint& footprint);

/// The layout of a run, all that does not change: the nodes of `mesh` (without ghosts), the net,
/// the boundaries. Errors: those of the net.
Result<record::Layout> layout_of(const Scene& scene, const RodMesh& mesh);
/// The layout on the finest mesh of a simulation, which says whether positions are extrapolated.
Result<record::Layout> layout_of(const Simulation& simulation);

/// Writes what depends on the shape alone: positions of the mesh's nodes without ghosts, K of the
/// cells and its bins along x, height.
void fill_shape(const Scene& scene, const RodMesh& mesh, const Eigen::Matrix3Xd& x,
                const Eigen::VectorXd& K, record::Frame& frame);

/// The current state of a simulation as a frame: positions, energies, K of the cells and its bins
/// along x, certificate, extrapolated where the plan extrapolates. The experiment adds index,
/// progress, boundary, push and event.
record::Frame frame_of(const Simulation& simulation);

/// The largest stress of a fibre over its rod's strength, on the finest mesh; NaN if the strength
/// is not known.
double utilisation_of(const Simulation& simulation);
/// Utilisation, stress over strength, of an equilibrium on one mesh. `forces`: those of this state.
double utilisation_of(const Scene& scene, const RodMesh& mesh, const Model& model,
                      const State& state, const Assembly& forces);

/// The normal of the shell at a joint, t_u x t_v, extrapolated over the last two meshes where both
/// have the state; zero where no two rods cross.
Eigen::Vector3d joint_normal(const Footprint& footprint, const NestedShell& shell, int joint);

/// Writes what follows from a frame's nodes, K, reactions and curvature on the finest mesh.
void complete_shape(const Simulation& simulation, const record::Contacts& contacts,
                    record::Frame& frame);

/// Frame of an equilibrium on one mesh that is not the state of a simulation. `forces`: those of
/// this equilibrium.
record::Frame frame_of(const Scene& scene, const RodMesh& mesh, const Model& model,
                       const State& state, const Assembly& forces);

/// The flat footprint as a frame at progress 0; straight rods are exact on any mesh. The simulation
/// is then in that state.
record::Frame flat_frame(Simulation& simulation);

/// Frames of a snap in time under the loads at path parameter t, at most 24, evenly distributed
/// until no motion is visible: positions, energies, K and the unbalanced force. Pivots and error
/// are not known; `event` is "in motion".
std::vector<record::Frame> frames_in_motion(Simulation& simulation, double t,
                                            const std::vector<TimedState>& moments);

}  // namespace gridshell::simulate
