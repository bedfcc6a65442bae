// Pictures of a run as a preset wants them: what joins the renderer, which knows no preset, to the
// commands.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/preset/preset.h"
#include "engine/record/snapshot.h"

namespace gridshell::app {

/// Which pictures a command makes.
enum class Pictures { none, movie, stills };

/// Draws trajectories; holds the OpenGL context, so it stays on the thread that made it.
class Artist {
 public:
  /// `context` as in --context; `threads` of the rasteriser, 0: its own choice. Errors: io when no
  /// context can be had, naming what was tried.
  static Result<std::unique_ptr<Artist>> create(const std::string& context, int threads);
  virtual ~Artist() = default;

  /// Movie: folder/frames/frame_00000.png ... and folder/movie.mp4 where ffmpeg is at hand.
  /// Stills: folder/still_1.png ... Each file is whole or absent. Errors: io, cancelled.
  virtual Result<void> draw(Pictures pictures, const preset::Preset& preset,
                            const record::Trajectory& trajectory,
                            const std::filesystem::path& folder, Watch& watch) = 0;
};

/// What drawing is expected to take, for the progress bar.
double expected_seconds(Pictures pictures, const preset::Preset& preset);

}  // namespace gridshell::app
