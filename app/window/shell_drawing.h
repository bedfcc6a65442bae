// What the mouse does to a camera (orbit, pan, zoom to the cursor, the standard views), by what the
// shell is coloured, and its colours with the bar that explains them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/window/shell_view.h"
#include "engine/gridshell.h"
#include "render/canvas/legend.h"
#include "render/gl/renderer.h"

namespace gridshell::window {

/// A picture's size in pixels.
struct PictureSize {
  double width = 1, height = 1;
  bool operator==(const PictureSize&) const = default;
};

/// Millimetres a pixel in the plane through the camera's target.
double mm_per_pixel(const render::Camera& camera, const PictureSize& size);

/// Turned by a drag of so many pixels; the elevation stays within straight down and straight up.
void orbit(render::Camera& camera, double right_px, double down_px);
/// The picture moves along with the mouse.
void pan(render::Camera& camera, const PictureSize& size, double right_px, double down_px);
/// `steps` of the wheel closer; what lies under (x, y), pixels from the top left, stays there.
void zoom(render::Camera& camera, const PictureSize& size, double steps, double x, double y);

void look_from(render::Camera& camera, const render::ViewDirection& view);

/// All points (3 x n, mm) within the picture, from where the camera looks.
void fit(render::Camera& camera, const PictureSize& size, const Eigen::Matrix3Xd& points);

/// Millimetres that a point at `place` moves in the plane facing the camera for a drag in pixels.
Eigen::Vector3d dragged_in_plane(const render::Camera& camera, const PictureSize& size,
                                 const Eigen::Vector3d& place, double right_px, double down_px);
/// Displacement along the unit vector `axis` alone: as far as its picture follows the mouse.
double dragged_along(const render::Camera& camera, const PictureSize& size,
                     const Eigen::Vector3d& place, const Eigen::Vector3d& axis, double right_px,
                     double down_px);
/// How far from `from` along the unit vector `axis` a point is to be pushed that is at `at` now, so
/// that it comes under a cursor so many pixels off its picture; across the axis it moves by itself.
double pushed_under(const render::Camera& camera, const PictureSize& size,
                    const Eigen::Vector3d& from, const Eigen::Vector3d& axis,
                    const Eigen::Vector3d& at, const Eigen::Vector2d& off_px);
/// Displacement within the horizontal plane through the position; seen from the side, along the
/// picture's right alone.
Eigen::Vector3d dragged_level(const render::Camera& camera, const PictureSize& size,
                              const Eigen::Vector3d& place, double right_px, double down_px);

using preset::ColourBy;

/// What the colours' range is of: the state in sight, all since it was chosen, or as it was set by
/// hand.
enum class RangeOf { state, run, hand };

/// A state that the edited shell is compared with: the last of a run, an earlier one, the net, the
/// joints of a scan.
struct OtherShell {
  std::string name;
  std::shared_ptr<const ShellView> seen;  ///< not null, and has a layout
};

/// What is shown, and how.
struct Show {
  ColourBy colour_by = ColourBy::K;
  render::ColourScale scale;  ///< of the colours
  bool joints = true, rings = true, ground = true, net = false, footprint = false, dark = false,
       loads = true, braces = true;
  double largest_load_N = 0;  ///< of the states since the shell was opened: the arrows' scale
  double mode_mm = 0;         ///< amplitude along the lowest mode
  std::shared_ptr<const OtherShell> other = {};  ///< drawn over it, or next to it; null: none
  bool beside = false;
  int shells() const { return beside && other ? 2 : 1; }  ///< side by side
  bool operator==(const Show&) const = default;
};

/// For two joints their distance, straight and, if they have a common rod, along it; for three the
/// angle at the second.
std::string text_of_measure(const ShellView& shell, const std::vector<int>& joints);

/// As the interface names it of a shell, with its unit: "bending energy (mJ/m)".
std::string label_of(const ShellView& shell, const Show& show);
/// The bar of these colours, in the words of movies and figures.
render::ColourBar bar_of(const ShellView& shell, const Show& show);
/// What it is, in a sentence.
const char* meaning_of(ColourBy by);

/// The values that are coloured, of the cells or of the nodes; empty where the shell has none.
Eigen::VectorXd values_of(const ShellView& shell, const Show& show);

/// The scale of these values, with nice ends.
render::ColourScale scale_of(const ShellView& shell, const Show& show);

/// The scale that follows `before`, as the range setting requires.
render::ColourScale next_scale(const render::ColourScale& before, const render::ColourScale& now,
                               RangeOf of);

// The shell in sight as the renderer of movies draws it.

/// Drawing of a shell; `thin_mm`: the width of a pixel and a half.
render::Drawing drawing_of(const ShellView& shell, const Show& show, double thin_mm);

/// Where a node is drawn.
Eigen::Vector3d place_of(const ShellView& shell, const Show& show, int node);

}  // namespace gridshell::window
