// Pictures of a design: the shell before and after, over its target, and how it came there.
#pragma once

#include <filesystem>

#include "app/case_record.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/design/design.h"
#include "render/draw/renderer.h"

namespace gridshell::app {

/// `<stem>_net.png`, `<stem>_deviation.png` and the plots of shells on nets, the target in the
/// place of the net: of every node its nearest point; `<stem>_convergence`. Errors: as
/// draw_net_pictures.
Result<void> draw_design(CaseRecord before, CaseRecord after, const Designed& found,
                         render::Renderer& renderer, const std::filesystem::path& stem,
                         Watch& watch);

}  // namespace gridshell::app
