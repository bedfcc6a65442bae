// Shells designed on nets in the plane: footprints, curvature, distance from the centre [Baek 2018,
// Figs. 3B, 3C and 4B].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/snapshot.h"
#include "render/plot/plot.h"

namespace gridshell::render {

/// A run and what the legend calls it (marked text).
struct NamedRun {
  const record::Trajectory* run = nullptr;
  std::string name;
};

/// K of every cell in the last frame against x/L of its centroid, L the half-span of the actuated
/// boundary along x.
Plot curvature_plot(const std::vector<NamedRun>& runs);

/// Delta/rho that a share of the joints does not exceed, against that share: from the nearest joint
/// to the farthest.
Plot quantile_plot(const std::vector<NamedRun>& runs);

/// r/rho of the joints and of the net (a line at 1) against latitude, for nets on a sphere; joints
/// measured by others (3 x n, mm, in the frame of the net) are one more series where there are any.
Plot latitude_plot(const NamedRun& run, const Eigen::Matrix3Xd& scan = {});

/// Room for the title above a figure that is no plot, points.
inline constexpr double figure_head = 17;
/// Plain text, bold, in that room; smaller where it would not fit.
void draw_figure_head(Canvas& canvas, const std::string& title);

/// What write_footprints draws, into a box.
void draw_footprints(Canvas& canvas, const Box& box, const std::vector<NamedRun>& runs);

/// Original boundaries to scale, with the rods inside when there is one; beside them, for caps, the
/// planes that cut them from the sphere, `title` (plain text) above. Writes `<stem>.png` and
/// `<stem>.svg`.
Result<void> write_footprints(const std::filesystem::path& stem, const std::vector<NamedRun>& runs,
                              const std::string& title = "", const Print& print = {});

}  // namespace gridshell::render
