// The camera of the view (orbit, pan, zoom to the cursor, standard views), the quantities that
// colour the shell, their scale and colour bar, and the drawing of the shell.
#pragma once

#include <memory>
#include <optional>
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

/// Millimetres per pixel in the plane through the camera's target.
double mm_per_pixel(const render::Camera& camera, const PictureSize& size);

/// Turns the camera around its target by a drag in pixels; the elevation is at most ±90 degrees.
void orbit(render::Camera& camera, double right_px, double down_px);
/// Shifts the camera so that the picture follows a drag in pixels.
void pan(render::Camera& camera, const PictureSize& size, double right_px, double down_px);
/// Moves the camera `steps` of the wheel closer; the point of the picture at (x, y), pixels from
/// the top left, does not move.
void zoom(render::Camera& camera, const PictureSize& size, double steps, double x, double y);

/// Turns the camera to a standard view.
void look_from(render::Camera& camera, const render::ViewDirection& view);

/// Moves the camera, without turning it, so that all points (3 x n, mm) are in the picture, with
/// equal margins on opposite sides.
void fit(render::Camera& camera, const PictureSize& size, const Eigen::Matrix3Xd& points);

/// The displacement of a point at `position`, mm, in the plane facing the camera, for a drag in
/// pixels.
Eigen::Vector3d dragged_in_plane(const render::Camera& camera, const PictureSize& size,
                                 const Eigen::Vector3d& position, double right_px, double down_px);
/// The displacement along the unit vector `axis` only, mm, that follows a drag in pixels best.
double dragged_along(const render::Camera& camera, const PictureSize& size,
                     const Eigen::Vector3d& position, const Eigen::Vector3d& axis, double right_px,
                     double down_px);
/// The distance from `from` along the unit vector `axis` to which a point at `at` must be pushed,
/// so that its picture, now `off_px` from the cursor, gets to the cursor. Perpendicular to the axis
/// the point is free.
double pushed_under(const render::Camera& camera, const PictureSize& size,
                    const Eigen::Vector3d& from, const Eigen::Vector3d& axis,
                    const Eigen::Vector3d& at, const Eigen::Vector2d& off_px);
/// The displacement in the horizontal plane through `position`; if the camera looks from the side,
/// only to the right or left of the picture.
Eigen::Vector3d dragged_level(const render::Camera& camera, const PictureSize& size,
                              const Eigen::Vector3d& position, double right_px, double down_px);

using preset::ColourBy;

/// The range of the colours: that of the current state, that of all states since this was chosen,
/// or one that the user set.
enum class RangeOf { state, run, hand };

/// A state that the edited shell is compared with: the last state of a run, an earlier state, the
/// net, or the joints of a scan.
struct OtherShell {
  std::string name;
  std::shared_ptr<const ShellView> seen;  ///< not null, and has a layout
};

/// What is drawn, and how.
struct Show {
  ColourBy colour_by = ColourBy::K;
  render::ColourScale scale;  ///< of the colours
  bool joints = true, rings = true, ground = true, net = false, footprint = false, dark = false,
       loads = true, braces = true;
  double largest_load_N = 0;  ///< of all states since the shell was opened; it scales the arrows
  double mode_mm = 0;         ///< amplitude along the lowest mode
  std::shared_ptr<const OtherShell> other = {};  ///< drawn over it, or next to it; null: none
  bool side_by_side = false;                     ///< `other` is drawn next to the shell
  int shells() const { return side_by_side && other ? 2 : 1; }  ///< that are drawn side by side
  bool operator==(const Show&) const = default;
};

/// Whether two shells have joints of the same names in the same order.
bool same_joints(const std::vector<record::Joint>& a, const std::vector<record::Joint>& b);

/// A text with the distance of two joints, straight and, if they have a common rod, along it; for
/// three joints the angle at the second.
std::string text_of_measure(const ShellView& shell, const std::vector<int>& joints);

/// Lines with the values at a node that are known: the given ones of its rod, bending energy, and
/// stress, "stress 120 MPa, 0.48 of the strength".
std::vector<std::string> known_values(const ShellView& shell, int node, double axial_force_N,
                                      double curvature_per_mm = record::unknown);

/// The name of the quantity that colours the shell, with its unit: "bending energy (mJ/m)".
std::string label_of(const ShellView& shell, const Show& show);
/// The colour bar, with the same text as in movies and figures.
render::ColourBar bar_of(const ShellView& shell, const Show& show);
/// A sentence that explains the quantity.
const char* meaning_of(ColourBy by);

/// The values of the quantity, one per cell or per node; empty if the shell has none.
Eigen::VectorXd values_of(const ShellView& shell, const Show& show);

/// A scale for these values, with round numbers as ends.
render::ColourScale scale_of(const ShellView& shell, const Show& show);

/// The next scale: `now`, `before`, or the union of both, as `of` requires.
render::ColourScale next_scale(const render::ColourScale& before, const render::ColourScale& now,
                               RangeOf of);

// The shell as the renderer of movies draws it.

/// The drawing of a shell; `thin_mm`: width of 1.5 pixels, for thin lines.
render::Drawing drawing_of(const ShellView& shell, const Show& show, double thin_mm);

/// The scale of the arrows of loads; empty if none are drawn, or if they are not to scale.
std::optional<render::ArrowKey> arrow_key_of(const ShellView& shell, const Show& show);

/// Position in which a node is drawn, mm.
Eigen::Vector3d node_position(const ShellView& shell, const Show& show, int node);

}  // namespace gridshell::window
