// A small plot within a panel.
#pragma once

#include <string>
#include <vector>

#include "app/ui/panel.h"

namespace gridshell::ui {

/// One curve, or two over the same x.
struct Curve {
  const char* y_label;
  const char* x_label;
  const char* without;  ///< said where there is nothing to plot
  std::vector<float> x, y;
  bool bars = false;
  std::vector<std::size_t> jumps = {};  ///< points that no line leads to
  std::vector<float> second = {};       ///< another one, paler
  bool logarithmic = false;             ///< y, which is above 0
};

/// Draws it between two corners, pixels.
void draw_curve(const Panel& panel, ImVec2 low, ImVec2 high, const Curve& curve);

}  // namespace gridshell::ui
