// Pictures of the states of a shell [Baek 2018, Fig. 2].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/case_record.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/draw/renderer.h"

namespace gridshell::app {

/// Lines for the terminal: how many states a search found, how many there may be, why trials ended
/// otherwise, and the lowest state of each of the paper's classes.
std::string found_text(const record::StateTables& states);

/// "*C*_{4v}" of "C4v"; the place of mirrors is left to the table.
std::string group_text(const std::string& group);

/// Some of the states alone, each in its actuated boundary.
record::Trajectory states_alone(const record::Trajectory& run,
                                const std::vector<std::size_t>& which);

/// The atlas: the states side by side from one camera with class, group, energy and how often they
/// were met (`<stem>.png`, each by itself `<stem>_1.png` ...); energy against how often they were
/// met (`<stem>_energies.*`); how far back along the path they live (`<stem>_lives.*`); which goes
/// to which (`<stem>_ways.*`) and the barriers between them (`<stem>_barriers.*`), where that was
/// found out.
Result<void> draw_states(const CaseRecord& one, render::Renderer& renderer,
                         const std::filesystem::path& stem, Watch& watch);

}  // namespace gridshell::app
