// Folders of pictures that were looked at and kept, and what stands in their place now.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "render/figure/contact_sheet.h"

namespace gridshell::app {

/// All PNG files of both folders and the folders in them, by their path in the folder, in order.
/// Errors: io, bad_input for a file that is no PNG.
Result<std::vector<render::PicturePair>> pictures_of(const std::filesystem::path& before,
                                                     const std::filesystem::path& after);

/// Puts every picture that is not the same in the place of the kept one, takes away what is gone,
/// and writes the reason with the names into `before`/WHY.md. Errors: io.
Result<void> update_baselines(const std::filesystem::path& before,
                              const std::vector<render::PicturePair>& pairs, double threshold,
                              const std::string& why);

}  // namespace gridshell::app
