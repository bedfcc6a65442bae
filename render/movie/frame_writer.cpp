#include "render/movie/frame_writer.h"

#include <fmt/format.h>

#include <utility>

#include "render/image/png.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

std::string frame_name(int index) { return fmt::format("frame_{:05d}.png", index); }

Result<void> FrameWriter::put(Image picture, Finish over) {
  return finish().and_then([&] { return check(); }).map([&] {
    picture_ = std::move(picture);
    worker_.begin(
        [this, over = std::move(over), index = begun_++, on_finished = CanvasWatch::of_thread()] {
          const CanvasWatch canvases(on_finished);
          if (over) over(picture_);
          return write_png(picture_, folder_ / frame_name(index)).map([&] {
            watch_.report(double(index + 1) / count_);
            if (on_frame_) on_frame_(index, picture_);
          });
        });
  });
}

Result<void> FrameWriter::finish() {
  if (auto written = worker_.wait(); !written) return written;
  written_ = begun_;
  return {};
}

Result<void> FrameWriter::check() {
  if (!watch_.cancelled()) return {};
  if (auto done = finish(); !done) return done;
  return fail(Fault::cancelled, fmt::format("stopped after {} of {} frames", written_, count_));
}

}  // namespace gridshell::render
