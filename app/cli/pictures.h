// Draws the pictures that a preset describes of a run: the connection of commands and renderer.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/gridshell.h"
#include "render/canvas/legend.h"
#include "render/gl/context.h"
#include "render/gl/renderer.h"
#include "render/movie/movie_style.h"
#include "render/movie/movie_writer.h"

namespace gridshell::app {

/// Which pictures a command makes.
enum class Pictures { none, movie, stills };

/// One run of a preset or of one of its cases: planned, done, or read back from its folder.
struct Run {
  std::string name = {};  ///< name of the case and its folder; empty without cases
  preset::Preset preset = {};
  Pictures pictures = Pictures::movie;      ///< those that the command draws
  std::shared_ptr<const Scene> scene = {};  ///< made by plan(); null after the simulation
  record::Trajectory trajectory = {};
  record::Summary summary = {};
  record::StateTables states = {};  ///< results of a search for states
  std::string label = {};           ///< its name in pictures; empty: that of its net
  bool in_journal = false;          ///< read from the journal of an interrupted run
};

/// Runs that one picture shows.
using Runs = std::vector<const Run*>;

/// The common colour bar of several runs; none if each has its own.
using SharedColourBar = std::optional<render::ColourBar>;

/// For each run the common colour bar of all runs that are coloured by the same quantity.
std::vector<SharedColourBar> shared_bars(const std::vector<Run>& runs);

render::MovieStyle style_of(const preset::Preset& preset, Pictures pictures);

/// The joints that were measured on a real shell, [figure] scan: 3 x n, mm.
Eigen::Matrix3Xd scan_of(const preset::Preset& preset);

/// Owns the OpenGL context, so only the thread that made it may use it.
class PictureMaker {
 public:
  /// `context` as in --context; `font`: that of all text, empty: the default. Errors: io if no
  /// context can be created, with what was tried; bad_input for a font that is not installed.
  static Result<PictureMaker> create(const std::string& context, const std::string& font);
  /// Does not change the font. Errors: io; bad_input for an unknown context.
  static Result<PictureMaker> create(const std::string& context);

  render::Context& context() { return *context_; }
  render::Renderer& renderer() { return *renderer_; }

 private:
  PictureMaker(std::unique_ptr<render::Context> context, std::unique_ptr<render::Renderer> renderer)
      : context_(std::move(context)), renderer_(std::move(renderer)) {}

  std::unique_ptr<render::Context> context_;  // outlives the renderer
  std::unique_ptr<render::Renderer> renderer_;
};

/// Draws a run as `run.pictures` says. Movie: folder/frames/frame_00000.png ... and, if ffmpeg is
/// on the PATH, folder/movie.mp4. Stills: folder/<preset>_1.png ... and all in one,
/// folder/<preset>.png; for a push or more than eight steps only the first and last frame. Each
/// file is complete or absent. Errors: io, cancelled, bad_input when a picture cannot be that size.
Result<void> draw_run(const Run& run, const SharedColourBar& bar, render::Renderer& renderer,
                      const std::filesystem::path& folder, Watch& watch);

// Displacements along a mode, which are drawn like states but are none.

/// The largest displacement of a node as drawn; a mode has no size of its own.
inline double drawn_move_mm(const record::Layout& layout) { return 0.12 * layout.length_scale_mm; }

/// The last frame of `state` with its nodes displaced by `part` times `shape` times
/// drawn_move_mm(); `shape`: 3 x nodes, its largest displacement is 1. The frame has no energies
/// and forces.
record::Frame moved_by(const record::Trajectory& state, const Eigen::Matrix3Xd& shape, double part,
                       int index);

/// The colour bar of these displacements.
extern const render::ColourBar bar_of_moves;

/// Writes the frames of a movie and calls `seen` with each of them.
using DrawFrames = std::function<Result<void>(const render::FrameCallback& seen)>;

/// Writes the movie of `frames` frames that `draw` writes into folder/frames: if ffmpeg is on the
/// PATH movie.mp4, and if the preset requests them movie.webm, movie.gif, poster.png and a title
/// card. Errors: those of `draw`, io, cancelled.
Result<void> make_movie(const std::filesystem::path& folder, const preset::Preset& preset,
                        render::MovieStyle style, int frames, Watch& watch, const DrawFrames& draw);

/// Estimated time of drawing, s, for the progress bar and `check`.
double expected_seconds(Pictures pictures, const preset::Preset& preset);

/// Two lines with the command that makes a movie of the frames in a run's folder, if it has frames
/// and no movie, since ffmpeg is not on the PATH; else empty.
std::string how_to_make_movie(const std::filesystem::path& folder, const preset::Preset& preset);

}  // namespace gridshell::app
