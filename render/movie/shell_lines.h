// A shell as lines: what is hidden behind cells is faded, what is not stands out, and all of it can
// be enlarged without end.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "engine/core/result.h"
#include "render/canvas/canvas.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

/// Whether each point is hidden from the camera by a cell of the drawing (its four joints' two
/// triangles), which lies before it by more than `slack_mm`.
std::vector<bool> hidden_points(const Drawing& drawing, const Camera& camera,
                                const Eigen::Matrix3Xd& points, double slack_mm);

/// Draws rods, rings, nets beside them, joints, marks and arrows of `drawing` into a box of the
/// canvas as the camera sees them: hidden ones first, faded by the drawing's far_fade (1: left
/// out).
void draw_shell_lines(Canvas& canvas, const Box& box, const Drawing& drawing, const Camera& camera);

/// The same at a later time: keeps the drawing and its layout.
std::function<void(Canvas&, const Box&)> shell_lines(Drawing drawing, const Camera& camera);

}  // namespace gridshell::render
