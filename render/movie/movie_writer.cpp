#include "render/movie/movie_writer.h"

#include <chrono>
#include <memory>

#include "engine/core/atomic_file.h"
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

Result<MovieReport> write_movie(const FrameSource& source, Survey survey, const MovieStyle& style,
                                const std::optional<ColourBar>& bar, Renderer& renderer,
                                const std::filesystem::path& folder, Watch& watch,
                                const OnFrame& on_frame) {
  if (auto sized = check_size(style); !sized) return tl::unexpected(sized.error());
  if (source.count < 1) return fail(Fault::bad_input, "the run has no frame to show");
  if (auto coloured = check_coloured(survey, style); !coloured)
    return tl::unexpected(coloured.error());
  if (auto made = make_folder(folder); !made) return tl::unexpected(made.error());
  const Stage stage(*source.layout, std::move(survey), style, bar);
  FrameWriter writer(folder, source.count, watch, on_frame);
  MovieReport report;
  for (int k = 0; k < source.count; ++k) {
    if (auto wanted = writer.check(); !wanted) return tl::unexpected(wanted.error());
    auto time = Clock::now();
    auto read = source.at(k);
    if (!read) return tl::unexpected(read.error());
    const auto frame = std::make_shared<const record::Frame>(std::move(*read));
    if (auto good = check_frame(*source.layout, *frame, k, style); !good)
      return tl::unexpected(good.error());
    auto picture = stage.draw_views(renderer, {*frame, k});
    if (!picture) return tl::unexpected(picture.error());
    time = lap(time, report.seconds_draw);
    const auto overlay = [&stage, frame, k](Image& image) { stage.finish(image, {*frame, k}); };
    if (auto put = writer.put(std::move(*picture), overlay); !put)
      return tl::unexpected(put.error());
    lap(time, report.seconds_write);
  }
  auto time = Clock::now();
  if (auto done = writer.finish(); !done) return tl::unexpected(done.error());
  lap(time, report.seconds_write);
  report.frames = writer.written();
  return report;
}

Result<MovieReport> write_movie(const record::Trajectory& run, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const OnFrame& on_frame) {
  if (auto showable = check_showable(run, style); !showable)
    return tl::unexpected(showable.error());
  return write_movie(source_of(run), survey_of(run), style, {}, renderer, folder, watch, on_frame);
}

}  // namespace gridshell::render
