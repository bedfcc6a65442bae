#include "render/movie/style.h"

namespace gridshell::render {

DrawQuality draw_quality(Quality quality) {
  switch (quality) {
    case Quality::draft:
      return {.supersample = 1, .shadow = false, .jittered_passes = 1};
    case Quality::movie:
      return {.supersample = 2, .shadow = true, .jittered_passes = 1};
    case Quality::figure:
      return {.supersample = 2, .shadow = true, .jittered_passes = 64};
  }
  return {};
}

}  // namespace gridshell::render
