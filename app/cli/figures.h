// Pictures of several cases of a preset: a movie beside one another, the figures of point loads.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/cli/pictures.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/gridshell.h"
#include "render/gl/renderer.h"

namespace gridshell::app {

/// Whether the movie of these runs is one, the cases beside one another.
bool drawn_side_by_side(const preset::Preset& preset, const std::string& case_name);

/// folder/frames/frame_00000.png ... and folder/movie.mp4 where ffmpeg is on the PATH; the title is
/// that of the preset without its cases. Errors: io, cancelled, bad_input when a picture cannot be
/// that size.
Result<void> draw_beside(const std::vector<CaseRun>& records, const std::string& title,
                         render::Renderer& renderer, const std::filesystem::path& folder,
                         Watch& watch);

/// `<stem>_loads.png` and, each as PNG and SVG, `<stem>_force` and `<stem>_bins`; `title` is that
/// of the preset without its cases.
Result<void> draw_push_pictures(const std::vector<CaseRun>& records, const std::string& title,
                                render::Renderer& renderer, const std::filesystem::path& stem,
                                Watch& watch);

/// Whether a shell was designed on a net and is shown beside it; a pushed one is shown by itself.
bool shown_on_net(const preset::Preset& preset);

/// The figures that `figure` adds to the stills of each case: of shells on nets and of pushed ones,
/// each with a phase of the progress bar of its own; `title` as above.
Result<void> draw_case_figures(std::vector<CaseRun> records, const std::string& title,
                               render::Renderer& renderer, const std::filesystem::path& stem,
                               const std::function<Watch&()>& next_phase);

/// Whether stills show a run's first and last frame alone: of a push, whose others are for the
/// curve of its force, and of more steps than a figure holds.
bool stills_show_ends(const preset::Preset& preset);

/// These two frames.
record::Trajectory ends_of(const record::Trajectory& run);

// The figures of shells that were designed on nets: over their nets, by deviation, footprints, K,
// r against latitude.

/// Writes `<stem>_net.png`, `<stem>_deviation.png` and, each as PNG and SVG, `<stem>_footprint`,
/// `<stem>_K`, `<stem>_quantiles`, for one cap alone `<stem>_latitude` with the joints scanned
/// where the preset has any, and for building blocks `<stem>_blocks.png` and `<stem>_seams`.
/// Errors: io, cancelled, bad_input when a picture cannot be that size.
Result<void> draw_net_pictures(const std::vector<CaseRun>& records, render::Renderer& renderer,
                               const std::filesystem::path& stem, Watch& watch);

// Pictures of the states of a shell [Baek 2018, Fig. 2].

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
Result<void> draw_states(const CaseRun& one, render::Renderer& renderer,
                         const std::filesystem::path& stem, Watch& watch);

// Pictures of what was refused.

/// Of every run whose net ends before its boundary: `<folder>_refused.png`, .svg and .pdf (with
/// cases `<folder>_<case>_refused`), told on the error output.
void draw_refusals(const preset::Presets& presets, const std::filesystem::path& folder);

}  // namespace gridshell::app
