// Pictures of a run as its preset wants them: what joins the renderer to the commands.
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
  std::string name = {};  ///< of the case, and of its folder; empty without cases
  preset::Preset preset = {};
  Pictures pictures = Pictures::movie;      ///< that are drawn of it
  std::shared_ptr<const Scene> scene = {};  ///< of its plan, until it is simulated
  record::Trajectory trajectory = {};
  record::Summary summary = {};
  record::StateTables states = {};  ///< of a search for states
  std::string label = {};           ///< what pictures call it; empty: after its net
  bool in_journal = false;          ///< it was cut short: its files are still to be made
};

/// Some runs that one picture shows.
using Runs = std::vector<const Run*>;

/// A colour bar of several runs; none where each has its own.
using SharedColourBar = std::optional<render::ColourBar>;

/// One per run: the bar that it shares with all others that are coloured by the same quantity.
std::vector<SharedColourBar> shared_bars(const std::vector<Run>& runs);

/// How the preset wants its run shown.
render::MovieStyle style_of(const preset::Preset& preset, Pictures pictures);

/// The joints that were measured on a real shell, 3 x n, mm.
Eigen::Matrix3Xd scan_of(const preset::Preset& preset);

/// Owns the OpenGL context, so it stays on the thread that made it.
class PictureMaker {
 public:
  /// `context` as in --context; `font` of all text, empty: the usual one. Errors: io when no
  /// context can be had, naming what was tried; bad_input for a font that is not there.
  static Result<PictureMaker> create(const std::string& context, const std::string& font);
  /// With the font that is in use. Errors: io, bad_input for no such context.
  static Result<PictureMaker> create(const std::string& context);

  render::Context& context() { return *context_; }
  render::Renderer& renderer() { return *renderer_; }

 private:
  PictureMaker(std::unique_ptr<render::Context> context, std::unique_ptr<render::Renderer> renderer)
      : context_(std::move(context)), renderer_(std::move(renderer)) {}

  std::unique_ptr<render::Context> context_;  // outlives the renderer
  std::unique_ptr<render::Renderer> renderer_;
};

/// Movie: folder/frames/frame_00000.png ... and folder/movie.mp4 where ffmpeg is on the PATH.
/// Stills: folder/<preset>_1.png ... and all in one, folder/<preset>.png; of a push and of very
/// many steps of their ends alone. Each file is whole or absent. Errors: io, cancelled, bad_input
/// when a picture cannot be that size.
Result<void> draw_run(const Run& run, const SharedColourBar& bar, render::Renderer& renderer,
                      const std::filesystem::path& folder, Watch& watch);

// A shell that moves as a mode says, which is no state.

/// How far the node that moves furthest is drawn: a shape has no size of its own.
inline double drawn_move_mm(const record::Layout& layout) { return 0.12 * layout.length_scale_mm; }

/// The one of `state`'s last frame, moved by `part` of a shape whose largest move is 1:
/// drawn_move_mm(). It knows nothing but its shape.
record::Frame moved_by(const record::Trajectory& state, const Eigen::Matrix3Xd& shape, double part,
                       int index);

/// How its moves are coloured.
extern const render::ColourBar bar_of_moves;

/// Writes the frames of a movie, and shows each to whoever wants to see it.
using DrawFrames = std::function<Result<void>(const render::FrameCallback& seen)>;

/// Draws so many frames into folder/frames and makes of them, where ffmpeg is on the PATH,
/// movie.mp4 and what else the preset asks for; poster.png. Errors: those of `draw`, io, cancelled.
Result<void> make_movie(const std::filesystem::path& folder, const preset::Preset& preset,
                        render::MovieStyle style, int frames, Watch& watch, const DrawFrames& draw);

/// What drawing will take about, for the progress bar and `check`.
double expected_seconds(Pictures pictures, const preset::Preset& preset);

/// Two lines that say how to make a movie of the frames in a run's folder, where there are frames
/// and no movie because ffmpeg is not on the PATH; else empty.
std::string how_to_make_movie(const std::filesystem::path& folder, const preset::Preset& preset);

}  // namespace gridshell::app
