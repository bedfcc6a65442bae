// Draws the pictures of a preset's runs: of each run and of several runs together.
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

/// Draws every picture of finished runs: those of one run in the folder of its case, then those of
/// several runs, `folder`/`stem`_...; `title`: that of the preset without its cases. Adds the time
/// of drawing to the summaries. Errors: io, cancelled, bad_input when a picture cannot be that
/// size.
Result<void> draw_all(std::vector<Run>& runs, const std::string& title,
                      const std::filesystem::path& stem, render::Renderer& renderer,
                      const std::filesystem::path& folder, Progress& progress);

/// Writes a figure of panels side by side (render::write_panels). Errors: that of `figure`, io.
Result<void> save_panels(const Result<render::PanelFigure>& figure,
                         const std::filesystem::path& file, double dpi = 0);

// Pictures of shells that were designed on nets.

/// Writes, each as PNG, SVG and PDF: `<stem>_net`, the shells over their nets; `<stem>_deviation`,
/// the distances between them; `<stem>_footprint`; `<stem>_K`, the integrated Gauss curvature of
/// the cells; `<stem>_quantiles`, of the distances; for a single cap `<stem>_latitude`, with
/// scanned joints if the preset has them; for building blocks `<stem>_blocks` and `<stem>_seams`.
/// Errors: io, cancelled, bad_input when a picture cannot be that size.
Result<void> draw_net_pictures(const Runs& runs, const std::filesystem::path& stem, Watch& watch);

// Pictures of the states of a shell [Baek 2018, Fig. 2].

/// Lines for the terminal: how many states a search found, how many there may be, why trials ended
/// otherwise, and some of them, as states_to_draw() chooses.
std::string found_text(const record::StateTables& states);

/// "state *ii*"; "other" for a state that is in none of the classes of the paper.
std::string class_text(record::StateClass kind);

/// Marked text for a symmetry group: "*C*_{4v}" for "C4v". The position of mirrors, "_..." at the
/// end of the name, is left out.
std::string group_text(const std::string& group);

/// The atlas: the states of states_to_draw() side by side from one camera with class, group,
/// energy, why each is drawn and how often it was found (`<stem>.png`, each by itself
/// `<stem>_1.png` ...); how often each was found against its energy (`<stem>_energies.*`); the
/// range of the path in which each exists (`<stem>_lives.*`); if they were computed, the
/// transitions between states (`<stem>_transitions.*`) and their energy barriers
/// (`<stem>_barriers.*`).
Result<void> draw_states(const Run& run, render::Renderer& renderer,
                         const std::filesystem::path& stem, Watch& watch);

// Pictures of nets on meshes.

/// Draws, for a run whose target is a mesh, `<folder>_plan.png`, .svg and .pdf (for a case
/// `<folder>_<case>_plan`): the rods in plan, the areas that they do not reach, and why. Returns
/// the name of the PNG. Errors: io, and those of rods_on_net().
Result<std::string> draw_net_plan(const preset::Case& run, const Scene& scene,
                                  const std::filesystem::path& folder);

// Pictures of what was refused.

/// Draws, for every run whose net ends before its boundary, `<folder>_refused.png`, .svg and .pdf
/// (for a case `<folder>_<case>_refused`), and prints the name or the error on stderr.
void draw_refusals(const preset::Presets& presets, const std::filesystem::path& folder);

}  // namespace gridshell::app
