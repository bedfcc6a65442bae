// A run to a folder of numbered pictures.
#pragma once

#include <condition_variable>
#include <exception>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "engine/record/trajectory.h"
#include "render/canvas/legend.h"
#include "render/gl/image.h"
#include "render/gl/renderer.h"
#include "render/movie/movie_style.h"
#include "render/movie/run_plots.h"
#include "render/movie/run_summary.h"

namespace gridshell::render {

/// Does one job after the other on one thread of its own, which keeps what libraries remember of a
/// thread; where no thread is to be had, on the one that asks.
class Worker {
 public:
  using Job = std::function<Result<void>()>;

  Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Waits for the running job.
  ~Worker();

  /// Begins a job; the one before has been waited for.
  void begin(Job job);
  /// How the running job ended, once it has; nothing was to be done: well. What it threw is
  /// thrown here.
  Result<void> wait();

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  Job job_;                    // null: none is running
  Result<void> ended_;         // how the last one did
  std::exception_ptr thrown_;  // by it
  bool over_ = false;          // no more will come
  std::thread thread_;
};

// Pictures to numbered files, written while the next are drawn.

/// "frame_00000.png"
std::string frame_name(int index);

/// Called with each frame in turn once it is on the disk, on the thread that writes.
using FrameCallback = std::function<void(int index, const Image& picture)>;
/// What is still to be drawn over a picture.
using DrawOverPicture = std::function<void(Image& picture)>;

/// Writes frame_00000.png ... into a folder: one picture is finished, compressed and handed on
/// while the next is drawn. Every file is whole or absent. Progress of `watch` grows with what
/// is on the disk, to 1.
class FrameWriter {
 public:
  /// The folder exists; `watch` outlives the writer.
  FrameWriter(std::filesystem::path folder, int count, Watch& watch, FrameCallback on_frame = {})
      : folder_(std::move(folder)), count_(count), watch_(watch), on_frame_(std::move(on_frame)) {}

  /// Takes the next picture, once the one before is on the disk; `over` is done to it first, and
  /// owns what it needs. Errors: those of write_png for the one before; Fault::cancelled, with
  /// which nothing more is written.
  Result<void> put(Image picture, DrawOverPicture over = {});

  /// Waits for the last one.
  Result<void> finish();

  /// Fault::cancelled once the watch is, with how many frames there are.
  Result<void> check();

 private:
  std::filesystem::path folder_;
  int count_;
  Watch& watch_;
  FrameCallback on_frame_;
  int begun_ = 0, written_ = 0;
  Image picture_;  // in the making as a file
  Worker worker_;  // waits for it when destroyed
};

/// Writes frame_00000.png ... into `folder` (made if absent), one picture a frame of `source`,
/// whose survey has been taken; `bar` is a colour bar that several movies share. One frame is in
/// memory at a time, with the one before and its picture, every file is whole at any time. Progress
/// of `watch` grows from 0 to 1. Errors: Fault::bad_input for a run without frames or an impossible
/// size, Fault::cancelled between frames, Fault::io, those of the source.
Result<void> write_movie(const FrameSource& source, RunSummary survey, const MovieStyle& style,
                         const std::optional<ColourBar>& bar, Renderer& renderer,
                         const std::filesystem::path& folder, Watch& watch,
                         const FrameCallback& on_frame = {});

// Several runs of one preset next to one another in a frame, each from its own camera, under one
// colour bar: the cases of a movie.

/// Frames `folder`/frame_00000.png ...: frame k of every run, the last one where a run ended
/// earlier; above each its name, here plain text. Size, quality, camera and colours are the
/// style's; colours share one scale. Errors: as write_movie.
Result<void> write_side_by_side(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const FrameCallback& on_frame = {});

}  // namespace gridshell::render
