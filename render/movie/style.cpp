#include "render/movie/style.h"

namespace gridshell::render {

Look paper_look() {
  Look look;
  look.rod = {0, 0, 0, 1};
  look.joint_mm = 0;
  look.ring = {0, 0, 0, 1};
  look.cells = look.floor = look.shadow = false;
  look.sheen = 0;
  return look;
}

DrawQuality draw_quality(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {.supersample = 1, .shadow = false, .jittered_passes = 1};
    case Quality::movie:
      return {.supersample = 1, .shadow = true, .jittered_passes = 1};
    case Quality::figure:
      return {.supersample = 1, .shadow = true, .jittered_passes = 24};
  }
  return {};
}

DrawQuality draw_quality(const MovieStyle& style) {
  DrawQuality quality = draw_quality(style.quality);
  quality.shadow = quality.shadow && style.look.shadow;
  return quality;
}

}  // namespace gridshell::render
