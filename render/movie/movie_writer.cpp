#include "render/movie/movie_writer.h"

#include <fmt/format.h>

#include <chrono>

#include "engine/core/atomic_file.h"
#include "render/image/png.h"
#include "render/movie/stage.h"

namespace gridshell::render {
namespace {

using Clock = std::chrono::steady_clock;

// adds the time since `since` to `total` and returns now
Clock::time_point lap(Clock::time_point since, double& total) {
  const auto now = Clock::now();
  total += std::chrono::duration<double>(now - since).count();
  return now;
}

}  // namespace

std::string frame_name(int index) { return fmt::format("frame_{:05d}.png", index); }

Result<MovieReport> write_movie(const record::Trajectory& run, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const OnFrame& on_frame) {
  if (auto showable = check_showable(run, style); !showable)
    return tl::unexpected(showable.error());
  if (auto made = make_folder(folder); !made) return tl::unexpected(made.error());
  const Stage stage(run, style);
  const DrawQuality quality = draw_quality(style.quality);
  MovieReport report;
  for (int k = 0; k < stage.frames(); ++k) {
    if (watch.cancelled())
      return fail(Fault::cancelled,
                  fmt::format("stopped after {} of {} frames", k, stage.frames()));
    auto time = Clock::now();
    Result<Image> picture =
        renderer.draw(stage.drawing(k), stage.camera(k), quality, style.width, style.height);
    if (!picture) return tl::unexpected(picture.error());
    time = lap(time, report.seconds_draw);
    stage.finish(*picture, k);
    time = lap(time, report.seconds_overlay);
    if (auto written = write_png(*picture, folder / frame_name(k)); !written)
      return tl::unexpected(written.error());
    lap(time, report.seconds_write);
    ++report.frames;
    watch.report(double(k + 1) / stage.frames());
    if (on_frame) on_frame(k, *picture);
  }
  return report;
}

}  // namespace gridshell::render
