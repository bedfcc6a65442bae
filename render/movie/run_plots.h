// Shells designed on nets in the plane: footprints, curvature, distance from the centre [Baek 2018,
// Figs. 3B, 3C and 4B].
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

/// A run and what the legend calls it (marked text).
struct NamedRun {
  const record::Trajectory* run = nullptr;
  std::string name;
};

/// K of every cell in the last frame against x/L of its centroid, L the half-span of the actuated
/// boundary along x.
Plot curvature_plot(const std::vector<NamedRun>& runs);

/// Delta/rho that a fraction of the joints does not exceed, against that fraction: from the nearest
/// joint to the farthest.
Plot quantile_plot(const std::vector<NamedRun>& runs);

/// r/rho of the joints and of the net (a line at 1) against latitude, for nets on a sphere; joints
/// measured by others (3 x n, mm, in the frame of the net) are one more series where there are any.
Plot latitude_plot(const NamedRun& run, const Eigen::Matrix3Xd& scan = {});

/// The colour of nets next to their shells: distinct from a shell's black in print and in grey.
inline constexpr Colour net_ink{0.93f, 0.53f, 0.05f, 1};

/// Room for the title above a figure that is no plot, points.
inline constexpr double figure_title_room = 17;
/// Plain text, bold, in that room; smaller where it would not fit.
void draw_figure_title(Canvas& canvas, const std::string& title);

/// A line as long as the spacing, to read a drawing by, and how long that is; returns the text's
/// box.
Box draw_spacing(Canvas& canvas, Point left, const record::Layout& layout, double units_per_mm);

/// What write_footprints draws, into a box.
void draw_footprints(Canvas& canvas, const Box& box, const std::vector<NamedRun>& runs);

/// Original boundaries to scale, with the rods inside when there is one; next to them, for caps,
/// the planes that cut them from the sphere, `title` (plain text) above. Writes `<stem>.png` and
/// `<stem>.svg`.
Result<void> write_footprints(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                              const std::string& title = "", const Print& print = {});

// Where a net ends that was refused.

/// Lines of a net as far as it comes, seen from above, mm; where its rods are close to parallel,
/// and a cross where it ends before its boundary.
Plot refused_plot(const std::vector<Eigen::Matrix3Xd>& lines, const Eigen::Matrix3Xd& narrow,
                  const Eigen::Vector3d& end, const std::string& title);

// What of a mesh a net reaches, in plan.

/// Lines, or points that represent an area, seen from above, mm.
struct PlanPart {
  enum class Kind { rods, rim, hole, crease, left_out, apex };
  Kind kind = Kind::rods;
  std::string name;  ///< in the legend, marked text; empty: not in it
  std::vector<Eigen::Matrix3Xd> lines = {};
  Eigen::Matrix3Xd points = Eigen::Matrix3Xd(3, 0);
};

/// Parts above one another, the first below; those that are left out each in a colour of its own.
Plot net_plan(const std::vector<PlanPart>& parts, const std::string& title);

// Curvature of the cells along x, over that of the first frame.

/// Mean and standard deviation of K in every bin of x/L as points with error bars, over the grey
/// bars of the run's first frame; the mean over all `cells` as a line across (dashed that of the
/// first frame). The range is fixed over the run, or (low, high) as given. Frames need K_bins.
Plot bins_plot(const RunSummary& run, long cells, const record::Frame& frame,
               const std::vector<double>& range, double font_size);

/// By how much the means of the bins differ from those of the run's first frame; range as above.
Plot change_plot(const RunSummary& run, const record::Frame& frame, double font_size);

}  // namespace gridshell::render
