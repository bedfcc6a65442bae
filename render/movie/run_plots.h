// Plots of shells designed on nets: footprints, curvature, deviation from the net, distance from
// the centre [Baek 2018, Figs. 3B, 3C and 4B].
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"
#include "render/canvas/plot.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {

/// A run and how it is shown; figures of shells in space show its last frame.
struct NamedRun {
  const record::Trajectory* run = nullptr;
  std::string name = {};          ///< in the legend or below the panel, text with markup
  Eigen::Matrix3Xd scanned = {};  ///< joints measured on a real shell, mm, in the net's coordinates
  bool half_span = false;         ///< with the axis x and the half-span L next to the shell
};

/// K□ of every cell in the last frame over x/L of its centroid, L the half-span of the actuated
/// boundary along x.
Plot curvature_plot(const std::vector<NamedRun>& runs);

/// Quantiles of the deviation of joints from the net: the deviation (deviation_unit()) that a
/// fraction of the joints does not exceed, over that fraction.
Plot quantile_plot(const std::vector<NamedRun>& runs);

/// r/rho of the joints and of the net (a line at 1) over latitude, for nets on a sphere, with the
/// run's measured joints as a further series.
Plot latitude_plot(const NamedRun& run);

/// The colour of nets, which differs from the black of shells in print and in grey.
inline constexpr Colour net_ink{0.93f, 0.53f, 0.05f, 1};

/// Height for the title above a figure that is not a plot, points.
inline constexpr double figure_title_room = 17;
/// Draws a title (plain text, bold) in that height at the top, smaller if it would not fit.
void draw_figure_title(Canvas& canvas, const std::string& title);

/// Draws a line as long as the spacing d, from `left`, with its length next to it; returns the box
/// of this text.
Box draw_spacing(Canvas& canvas, Point left, const record::Layout& layout, double units_per_mm);

/// Draws the original boundaries of runs to scale into a box; a single run also has its rods and
/// (dashed) its actuated boundary. Next to caps of a sphere are the planes that cut them from it.
void draw_footprints(Canvas& canvas, const Box& box, const std::vector<NamedRun>& runs);

/// Writes the drawing of draw_footprints() with `title` (plain text) above as `<stem>.png`, `.svg`
/// and `.pdf`. Errors: Fault::io.
Result<void> write_footprints(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                              const std::string& title = "", const Print& print = {});

/// A net that was refused, seen from above (mm): its lines as far as they could be computed, the
/// points `narrow` at which its rods are nearly parallel, and a cross at `end`, where it ends
/// before its boundary.
Plot refused_plot(const std::vector<Eigen::Matrix3Xd>& lines, const Eigen::Matrix3Xd& narrow,
                  const Eigen::Vector3d& end, const std::string& title);

/// A part of a plan of a mesh with its net: lines, or points that represent an area, seen from
/// above, mm.
struct PlanPart {
  enum class Kind { rods, rim, hole, crease, left_out, apex };
  Kind kind = Kind::rods;
  std::string name;  ///< in the legend, with markup; empty: not in the legend
  std::vector<Eigen::Matrix3Xd> lines = {};
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 0);
};

/// The plan of a mesh and the part of it that a net covers. Later parts are drawn over earlier
/// ones; each part that is left out has its own colour.
Plot net_plan(const std::vector<PlanPart>& parts, const std::string& title);

// K□ of the cells along x, compared with that in the first frame.

/// Mean and standard deviation of K□ in every bin of x/L as points with error bars, over the grey
/// bars of the run's first frame; the mean over all `cells` is a line, dashed for the first frame.
/// `range`: (low, high) of the axis; empty: that of all frames. Frames must have K_bins.
Plot bins_plot(const RunSummary& run, long cells, const record::Frame& frame,
               const std::vector<double>& range, double font_size);

/// Difference of the means of the bins from those of the run's first frame; the range is that of
/// all frames.
Plot change_plot(const RunSummary& run, const record::Frame& frame, double font_size);

}  // namespace gridshell::render
