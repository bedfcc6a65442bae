// How the states of a shell are drawn, and the barriers between them.
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

/// A class of states has one colour and one marker in all pictures.
struct ClassLook {
  Colour colour;
  Marker marker;
};
ClassLook look_of(record::StateClass kind);

/// The states between which passes are known, in the order of their number, each a bar at its
/// energy on the mesh of the passes; from bar to bar a curve over the pass, with its height above
/// the lower one. Passes between images of one state and to states that were not met are left out.
Plot barrier_plot(const record::StateTables& states);

// A bifurcation diagram as a picture.

/// What the two axes of one panel show.
enum class BranchAxis { height, amplitude };

/// Height or amplitude over the boundary's radius, or over progress where there is none: stable
/// parts full, others dashed; bifurcations, limit points and ends are marked. Without names of
/// curves: the legend is the figure's.
Plot branches_plot(const std::vector<record::BranchPoint>& points, BranchAxis axis);

/// Both panels next to one another, `<stem>.png`, `.svg` and `.pdf`; where what happens lies within
/// a sixth of the path, two more below show that part alone.
Result<void> write_branches(const std::filesystem::path& stem,
                            const std::vector<record::BranchPoint>& points,
                            const std::string& title);

/// The load factor over a joint's displacement, a curve per case, dashed where it is not stable;
/// limit points and bifurcations are marked, and where the rods reach their strength, with its
/// error.
Plot load_plot(const std::vector<record::LoadPoint>& points,
               const std::vector<record::LoadRow>& cases, const std::string& title);

// Which stable states footprints of so many rods and so long legs have [Baek 2018, Fig. 2B].

/// L_d along x, n upwards. At each point a marker a class of the paper, filled where trials met it
/// and hollow where only symmetric forms led to it, and the number of other states; the lines of
/// the shortest leg l_d = 1, 0, -1. A cross where nothing was found. Of several searches of one
/// footprint what any found.
Plot phase_plot(const record::PhaseDiagram& diagram, const std::string& title);

/// Writes it as `<stem>.png`, `.svg` and `.pdf`.
Result<void> write_phase_chart(const std::filesystem::path& stem,
                               const record::PhaseDiagram& diagram, const std::string& title,
                               const Print& print);

// A state of a shell seen from above [Baek 2018, Fig. 2C]: which of its rods are of the first order
// and which planes it is symmetric in.

/// Rods without and with inflections.
inline constexpr Colour first_order_ink{0.10f, 0.10f, 0.12f, 1},
    higher_order_ink{0.85f, 0.45f, 0.10f, 1};
inline constexpr Colour mirror_ink{0.16f, 0.42f, 0.78f, 1};  ///< of planes and axes of symmetry

/// The numbers of StateRow::inflections, rod by rod; empty where it is none of those.
std::vector<int> inflections_of(const record::StateRow& row);

/// Units of the canvas a millimetre at which the shell fills the box.
double state_map_scale(const Box& box, const record::Layout& layout);

/// The rods of a frame in equilibrium, its boundary and, dashed, the mirrors of its group (a square
/// in the middle where it is turns by 90 degrees alone), in the middle of the box.
void draw_state_map(Canvas& canvas, const Box& box, double units_per_mm,
                    const record::Layout& layout, const record::Frame& frame,
                    const record::StateRow& row);

// Which state of a shell goes to which when a hand disturbs it, as a graph.

/// States at their height and energy, the ones that were disturbed with their name next to them and
/// below the axes as small shells from above. Arrows lead to where they went, blue where the
/// boundary was released and contracted again, red where joints were pushed, with how often. What
/// came back to where it was is next to its shell, and so is what went to a state that the
/// search did not meet.
/// `run` has a frame per state; `title` (plain text) is above. `<stem>.png`, `.svg`, `.pdf`.
Result<void> write_transition_graph(const std::filesystem::path& stem,
                                    const record::StateTables& states,
                                    const record::Trajectory& run, const std::string& title,
                                    const Print& print = {});

}  // namespace gridshell::render
