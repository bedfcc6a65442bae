// Every picture of a preset's runs, of each by itself and of several together.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/cli/delivery.h"
#include "app/cli/pictures.h"
#include "engine/gridshell.h"
#include "render/canvas/panels.h"
#include "render/gl/renderer.h"

namespace gridshell::app {

/// A phase for each picture that draw_all() draws.
std::vector<Phase> drawing_phases(const std::vector<Run>& runs);

/// Every picture of finished runs: of each by itself, in the folder of its case, then of all
/// together, `folder`/`stem`_...; `title` is that of the preset without its cases. Adds the time
/// that it took to their summaries. Errors: io, cancelled, bad_input when a picture cannot be that
/// size.
Result<void> draw_all(std::vector<Run>& runs, const std::string& title,
                      const std::filesystem::path& stem, render::Renderer& renderer,
                      const std::filesystem::path& folder, Progress& progress);

/// Writes panels side by side (render::write_panels). Errors: those of the figure, io.
Result<void> save_panels(const Result<render::PanelFigure>& figure,
                         const std::filesystem::path& file, double dpi = 0);

// The figures of shells that were designed on nets: over their nets, by deviation, footprints, K,
// r against latitude.

/// Writes, each as PNG, SVG and PDF, `<stem>_net`, `<stem>_deviation`, `<stem>_footprint`,
/// `<stem>_K`, `<stem>_quantiles`, for one cap alone `<stem>_latitude` with the joints scanned
/// where the preset has any, and for building blocks `<stem>_blocks` and `<stem>_seams`.
/// Errors: io, cancelled, bad_input when a picture cannot be that size.
Result<void> draw_net_pictures(const Runs& runs, const std::filesystem::path& stem, Watch& watch);

// Pictures of the states of a shell [Baek 2018, Fig. 2].

/// Lines for the terminal: how many states a search found, how many there may be, why trials ended
/// otherwise, and some of them, as states_to_draw() chooses.
std::string found_text(const record::StateTables& states);

/// "state *ii*", or "other", which the paper has no class for.
std::string class_text(record::StateClass kind);

/// "*C*_{4v}" of "C4v"; the position of mirrors is left to the table.
std::string group_text(const std::string& group);

/// Some of the states alone, each in its actuated boundary.
record::Trajectory states_alone(const record::Trajectory& run,
                                const std::vector<std::size_t>& which);

/// The atlas: the states of states_to_draw() side by side from one camera with class, group,
/// energy, why each is drawn and how often it was found (`<stem>.png`, each by itself
/// `<stem>_1.png` ...); energy against how often they were met (`<stem>_energies.*`); how far back
/// along the path they live (`<stem>_lives.*`); which goes to which (`<stem>_transitions.*`) and
/// the barriers between them (`<stem>_barriers.*`), where that was found out.
Result<void> draw_states(const Run& run, render::Renderer& renderer,
                         const std::filesystem::path& stem, Watch& watch);

// Pictures of nets on meshes.

/// Draws, for a run whose net lies on a mesh, `<folder>_plan.png`, .svg and .pdf (of a case
/// `<folder>_<case>_plan`): its rods in plan, what they do not reach and why. Returns the name.
Result<std::string> draw_net_plan(const preset::Case& run, const Scene& scene,
                                  const std::filesystem::path& folder);

// Pictures of what was refused.

/// Draws, for every run whose net ends before its boundary, `<folder>_refused.png`, .svg and .pdf
/// (with cases `<folder>_<case>_refused`), which it reports on the error output.
void draw_refusals(const preset::Presets& presets, const std::filesystem::path& folder);

}  // namespace gridshell::app
