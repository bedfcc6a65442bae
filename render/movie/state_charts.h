// Charts of the states of a shell: barriers, bifurcation diagrams, load factors, phase diagrams,
// maps of states and graphs of transitions.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/record/phase_diagram.h"
#include "engine/record/states.h"
#include "engine/record/study_tables.h"
#include "engine/record/trajectory.h"
#include "render/canvas/canvas.h"
#include "render/canvas/plot.h"

namespace gridshell::render {

/// Colour and marker of a class of states, the same in all pictures.
struct ClassLook {
  Colour colour;
  Marker marker;
};
ClassLook look_of(record::StateClass kind);

/// The states between which passes are known, in the order of their number: each is a bar at its
/// energy, and a curve over each pass joins two bars, with its height above the lower state. Passes
/// between images of one state and to states that are not in the library are left out.
Plot barrier_plot(const record::StateTables& states);

/// The quantity over the path in a panel of a bifurcation diagram.
enum class BranchAxis { height, amplitude };

/// A bifurcation diagram: height or amplitude over the boundary's radius, or over progress if there
/// is none. Stable parts are solid, others dashed; bifurcations, limit points and ends are marked.
/// It has no legend.
Plot branches_plot(const std::vector<record::BranchPoint>& points, BranchAxis axis);

/// Writes both panels side by side with a legend as `<stem>.png`, `.svg` and `.pdf`. If all events
/// are within a sixth of the path, two more panels below show only that part. Errors: Fault::io.
Result<void> write_branches(const std::filesystem::path& stem,
                            const std::vector<record::BranchPoint>& points,
                            const std::string& title);

/// The load factor over a joint's displacement, one curve per case, dashed where it is unstable.
/// Limit points and bifurcations are marked, and so are the points at which the rods reach their
/// strength, with their errors. If the critical factors of the cases differ much, factors are
/// divided by them.
Plot load_plot(const std::vector<record::LoadPoint>& points,
               const std::vector<record::LoadRow>& cases, const std::string& title);

/// The phase diagram of stable states [Baek 2018, Fig. 2B] over the longest leg L_d and the number
/// n of rods per direction. Each point has a marker for each class of the paper that was found
/// (filled: by random trials, hollow: only by trials with an imposed symmetry) and the number of
/// other states; a cross if nothing was found. Several searches of one footprint are combined.
/// Lines are those of the shortest leg l_d = 1, 0, -1.
Plot phase_plot(const record::PhaseDiagram& diagram, const std::string& title);

/// Writes the phase diagram as `<stem>.png`, `.svg` and `.pdf`. Errors: Fault::io.
Result<void> write_phase_chart(const std::filesystem::path& stem,
                               const record::PhaseDiagram& diagram, const std::string& title,
                               const Print& print);

// The map of a state: the shell seen from above [Baek 2018, Fig. 2C], with rods in the first and in
// higher buckling modes and its planes of symmetry.

/// Colours of rods without and with inflections.
inline constexpr Colour first_order_ink{0.10f, 0.10f, 0.12f, 1},
    higher_order_ink{0.85f, 0.45f, 0.10f, 1};
inline constexpr Colour mirror_ink{0.16f, 0.42f, 0.78f, 1};  ///< of planes and axes of symmetry

/// The numbers in StateRow::inflections, rod by rod; empty if there are none.
std::vector<int> inflections_of(const record::StateRow& row);

/// The scale (units of the canvas per millimetre) at which the shell fills the box.
double state_map_scale(const Box& box, const record::Layout& layout);

/// Draws the rods and the boundary of a state in the middle of the box, with the mirror planes of
/// its symmetry group (dashed), or a square in the middle if the group has only rotations by 90
/// degrees.
void draw_state_map(Canvas& canvas, const Box& box, double units_per_mm,
                    const record::Layout& layout, const record::Frame& frame,
                    const record::StateRow& row);

/// Writes the graph of transitions between the states of a shell as `<stem>.png`, `.svg` and
/// `.pdf`. States are at their height and energy. Those that were perturbed have names and are also
/// drawn below as small shells from above. Arrows lead to the states that they became: blue if the
/// boundary was released and contracted again, red (with the number of times) if joints were
/// pushed. Next to the small shell is how often the state returned to itself or became one that is
/// not in the library. `run` has a frame per state; `title` is plain text. Errors: Fault::io.
Result<void> write_transition_graph(const std::filesystem::path& stem,
                                    const record::StateTables& states,
                                    const record::Trajectory& run, const std::string& title,
                                    const Print& print = {});

}  // namespace gridshell::render
