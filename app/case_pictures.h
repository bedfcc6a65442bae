// Pictures of several cases of a preset: a movie beside one another, the figures of point loads.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "app/case_record.h"
#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/draw/renderer.h"

namespace gridshell::app {

/// Whether the movie of these runs is one, the cases beside one another.
bool beside_one_another(const preset::Preset& preset, const std::string& case_name);

/// folder/frames/frame_00000.png ... and folder/movie.mp4 where ffmpeg is on the PATH; the title is
/// that of the preset without its cases. Errors: io, cancelled, bad_input when a picture cannot be
/// that size.
Result<void> draw_beside(const std::vector<CaseRecord>& records, const std::string& title,
                         render::Renderer& renderer, const std::filesystem::path& folder,
                         Watch& watch);

/// `<stem>_loads.png` and, each as PNG and SVG, `<stem>_force` and `<stem>_bins`; `title` is that
/// of the preset without its cases.
Result<void> draw_push_pictures(const std::vector<CaseRecord>& records, const std::string& title,
                                render::Renderer& renderer, const std::filesystem::path& stem,
                                Watch& watch);

/// Whether a shell was designed on a net and is shown beside it; a pushed one is shown by itself.
bool shown_on_net(const preset::Preset& preset);

/// The figures that `figure` adds to the stills of each case: of shells on nets and of pushed ones,
/// each with a phase of the progress bar of its own; `title` as above.
Result<void> draw_case_figures(std::vector<CaseRecord> records, const std::string& title,
                               render::Renderer& renderer, const std::filesystem::path& stem,
                               const std::function<Watch&()>& next_phase);

/// Whether stills show a run's first and last frame alone: of a push, whose others are for the
/// curve of its force, and of more steps than a figure holds.
bool stills_show_ends(const preset::Preset& preset);

/// These two frames.
record::Trajectory ends_of(const record::Trajectory& run);

}  // namespace gridshell::app
