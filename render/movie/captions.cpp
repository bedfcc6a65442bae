#include "render/movie/captions.h"

#include <algorithm>
#include <cmath>

#include "render/plot/ticks.h"

namespace gridshell::render {

std::vector<std::string> state_captions(const record::Frame& frame) {
  std::vector<std::string> captions;
  const bool pushed = std::isfinite(frame.depth_mm);
  if (pushed) captions.push_back("*δ* = " + fixed(frame.depth_mm, 2) + " mm");
  if (std::isfinite(frame.force_N)) captions.push_back("*F* = " + fixed(frame.force_N, 3) + " N");
  const bool moved = frame.actuation != 1;
  if (std::isfinite(frame.boundary_radius_mm) && (!pushed || moved))
    captions.push_back("*R*_{a} = " + fixed(frame.boundary_radius_mm, 1) + " mm");
  captions.push_back("height " + fixed(frame.height_mm, 1) + " mm");
  return captions;
}

std::string frame_caption(int at, int frames) {
  return "frame " + std::to_string(at + 1) + " / " + std::to_string(frames);
}

std::string equilibrium_caption(const record::Frame& frame) {
  if (std::isfinite(frame.time_s)) return "t = " + fixed(1e3 * frame.time_s, 0) + " ms";
  if (!std::isfinite(frame.residual_N)) return "";  // a net, nothing was solved for
  // its order alone, down to a micronewton: below, tolerances and round-off decide
  const double order = std::ceil(std::log10(std::max(frame.residual_N, 1e-6)) - 1e-9);
  const std::string text = "residual < " + scientific(std::pow(10, order), 1) + " N";
  return frame.negative_pivots == 0 ? text + ", stable" : text;
}

std::string event_caption(const record::Frame& frame) {
  if (!frame.event.empty() || frame.negative_pivots <= 0) return frame.event;
  return "unstable: " + std::to_string(frame.negative_pivots) + " negative pivot" +
         (frame.negative_pivots > 1 ? "s" : "");
}

}  // namespace gridshell::render
