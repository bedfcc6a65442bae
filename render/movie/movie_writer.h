// Frames of a run, or of several runs side by side, as a folder of numbered pictures.
#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <future>
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

/// Runs jobs one after another on a thread of its own, always the same, since libraries cache data
/// per thread. If no thread can be started, jobs run on the caller's.
class Worker {
 public:
  using Job = std::function<Result<void>()>;

  Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;
  /// Waits for the running job.
  ~Worker();

  /// Begins a job; wait() must have been called for the one before.
  void begin(const Job& job);
  /// Waits for the running job and returns its result, success if there is none. An exception of
  /// the job is thrown by wait().
  Result<void> wait();

 private:
  void loop();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::packaged_task<Result<void>()> job_;  // the next one; not valid: none
  std::future<Result<void>> running_;       // the last job that was begun
  bool over_ = false;                       // no more jobs follow
  std::thread thread_;
};

/// File name of a frame: "frame_00000.png".
std::string frame_name(int index);

/// Called with each frame, in order, after it was written, on the thread that writes.
using FrameCallback = std::function<void(int index, const Image& picture)>;
/// Draws captions and legends over a picture.
using DrawOverPicture = std::function<void(Image& picture)>;

/// Writes frame_00000.png ... into a folder: one picture gets its captions, is compressed and
/// written while the next is drawn. Every file is complete or absent. The progress of `watch` is
/// the fraction of frames that are written.
class FrameWriter {
 public:
  /// The folder must exist; `watch` must outlive the writer.
  FrameWriter(std::filesystem::path folder, int count, Watch& watch, FrameCallback on_frame = {})
      : folder_(std::move(folder)), count_(count), watch_(watch), on_frame_(std::move(on_frame)) {}

  /// Waits for the picture before and begins to write the next one, after `over` (which owns its
  /// data) was called on it. Errors: those of write_png for the picture before; Fault::cancelled,
  /// after which nothing more is written.
  Result<void> put(Image picture, DrawOverPicture over = {});

  /// Waits for the last picture. Errors: those of write_png.
  Result<void> finish();

  /// Errors: Fault::cancelled, with the number of frames written, once the watch is cancelled.
  Result<void> check();

 private:
  std::filesystem::path folder_;
  int count_;
  Watch& watch_;
  FrameCallback on_frame_;
  int begun_ = 0, written_ = 0;
  Image picture_;  // that is being written
  Worker worker_;  // the last member: its destructor waits for the picture
};

/// Writes frame_00000.png ... into `folder` (made if absent), one picture per frame of `source`,
/// whose summary is `survey`; `bar` is a common colour bar of several movies. Only two frames are
/// in memory at a time, and every file is complete at any time. The progress of `watch` increases
/// from 0 to 1. Errors: Fault::bad_input for a run without frames or without the values to be
/// coloured, or for a size outside its range; Fault::cancelled between frames; Fault::io; those of
/// the source.
Result<void> write_movie(const FrameSource& source, RunSummary survey, const MovieStyle& style,
                         const std::optional<ColourBar>& bar, Renderer& renderer,
                         const std::filesystem::path& folder, Watch& watch,
                         const FrameCallback& on_frame = {});

/// Writes frames of several runs (cases) side by side, each with its own camera, under one colour
/// bar: `folder`/frame_00000.png ... Picture k has frame k of every run, or its last frame if the
/// run ended earlier, with its name (plain text) above. Size, quality, camera and colours are the
/// style's. Errors: those of write_movie.
Result<void> write_side_by_side(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const FrameCallback& on_frame = {});

}  // namespace gridshell::render
