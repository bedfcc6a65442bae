// Pictures before and after a change beside one another, to look at.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/image/compare.h"
#include "render/image/image.h"

namespace gridshell::render {

/// A picture in two versions, either of which may be missing.
struct PicturePair {
  std::string name;
  std::optional<Image> before, after;
};

/// Whether two versions are the same to the eye, and how the line about them says it.
struct Verdict {
  bool same = false;
  std::string text;                 ///< "differs by 12.40 of 255 at (320, 96)", "is new", ...
  std::optional<Comparison> worst;  ///< where both are there and of one size
};
Verdict judge(const PicturePair& pair, double threshold);

/// A row a pair: before, after, and where they differ, each scaled into a cell of `cell_width`
/// pixels, with name and verdict above. Errors: none; an empty list is an empty sheet.
Image contact_sheet(const std::vector<PicturePair>& pairs, double threshold,
                    double cell_width = 480);

}  // namespace gridshell::render
