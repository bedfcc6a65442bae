// Pictures to numbered files, beside whoever draws them.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "engine/core/result.h"
#include "engine/core/watch.h"
#include "render/image/image.h"
#include "render/movie/worker.h"

namespace gridshell::render {

/// "frame_00000.png"
std::string frame_name(int index);

/// Called with each frame in turn once it stands on the disk, on the thread that writes.
using OnFrame = std::function<void(int index, const Image& picture)>;
/// What is still to be drawn over a picture.
using Finish = std::function<void(Image& picture)>;

/// Writes frame_00000.png ... into a folder: one picture is finished, compressed and handed on
/// while the next is drawn. Every file is whole or absent. Progress of `watch` grows with what
/// stands on the disk, to 1.
class FrameWriter {
 public:
  /// The folder exists; `watch` outlives the writer.
  FrameWriter(std::filesystem::path folder, int count, Watch& watch, OnFrame on_frame = {})
      : folder_(std::move(folder)), count_(count), watch_(watch), on_frame_(std::move(on_frame)) {}

  /// The next picture, once the one before stands on the disk; `over` is done to it first, and
  /// holds what it needs. Errors: those of write_png for the one before; Fault::cancelled, with
  /// which nothing more is written.
  Result<void> put(Image picture, Finish over = {});

  /// Waits for the last one.
  Result<void> finish();

  /// Fault::cancelled once the watch is, with how many frames there are.
  Result<void> check();

  int written() const { return written_; }

 private:
  std::filesystem::path folder_;
  int count_;
  Watch& watch_;
  OnFrame on_frame_;
  int begun_ = 0, written_ = 0;
  Image picture_;  // in the making as a file
  Worker worker_;  // waits for it when destroyed
};

}  // namespace gridshell::render
