// Fig. 2 of [Baek 2018] on one page: states of one footprint, the phase diagram, and a state of
// each class from above.
#pragma once

#include <vector>

#include "app/case_record.h"
#include "app/page_layout.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/draw/renderer.h"
#include "render/movie/style.h"

namespace gridshell::app {

/// A: the states ii, iii and iv of the first record. B: the sweep that the preset names, or an
/// empty frame. C: of each class the state of lowest energy that any record has, or an empty frame.
/// Errors: bad_input where no record is a search or the sweep cannot be read; the renderer's;
/// cancelled.
Result<Page> states_page(const std::vector<CaseRecord>& records, const render::MovieStyle& style,
                         render::Renderer& renderer, Watch& watch);

}  // namespace gridshell::app
