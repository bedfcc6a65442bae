#include "render/movie/frame_writer.h"

#include <fmt/format.h>

#include <utility>

#include "render/image/png.h"

namespace gridshell::render {

std::string frame_name(int index) { return fmt::format("frame_{:05d}.png", index); }

Result<void> FrameWriter::put(Image picture) {
  return finish().and_then([&] { return check(); }).map([&] {
    picture_ = std::move(picture);
    // where no thread is to be had it waits until it is asked for
    writing_ = std::async(std::launch::async | std::launch::deferred,
                          [this] { return write_png(picture_, folder_ / frame_name(written_)); });
  });
}

Result<void> FrameWriter::finish() {
  if (!writing_.valid()) return {};
  if (auto written = writing_.get(); !written) return written;
  const int index = written_++;
  watch_.report(double(written_) / count_);
  if (on_frame_) on_frame_(index, picture_);
  return {};
}

Result<void> FrameWriter::check() {
  if (!watch_.cancelled()) return {};
  if (auto done = finish(); !done) return done;
  return fail(Fault::cancelled, fmt::format("stopped after {} of {} frames", written_, count_));
}

}  // namespace gridshell::render
