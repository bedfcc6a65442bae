// Which state of a shell goes to which when a hand disturbs it, as a graph.
#pragma once

#include <filesystem>
#include <string>

#include "engine/record/snapshot.h"
#include "engine/record/states.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// States at their height and energy, moved apart where they would hide one another, the
/// ones that were disturbed with their number and below the axes as small shells from above. Arrows
/// lead to where they went, blue where the boundary was let out and drawn in again, orange where
/// joints were poked, with how often. What came back to where it was stands beside its shell, and
/// so does what went to a state that the search did not meet.
/// `run` has a frame a state; `title` (plain text) stands above. `<stem>.png`, `.svg`, `.pdf`.
Result<void> write_ways_graph(const std::filesystem::path& stem, const record::StateTables& states,
                              const record::Trajectory& run, const std::string& title,
                              const Print& print = {});

}  // namespace gridshell::render
