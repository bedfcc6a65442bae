// The figures of the paper, each on one page.
#pragma once

#include <filesystem>
#include <vector>

#include "app/case_record.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/draw/renderer.h"

namespace gridshell::app {

/// `<stem>_page.png`, `.svg` and `.pdf` of the preset's [page] kind, from its finished cases; none
/// where the kind is "none". Errors: io, cancelled, bad_input for a photograph that cannot be read
/// or cases that the page does not have the place for.
Result<void> draw_page(const std::vector<CaseRecord>& records, render::Renderer& renderer,
                       const std::filesystem::path& stem, Watch& watch);

}  // namespace gridshell::app
