#include "app/pictures.h"

#include <algorithm>
#include <cstdlib>

#include "render/movie/encode.h"
#include "render/movie/movie_writer.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;

render::MovieStyle style_of(const preset::Preset& preset, Pictures pictures) {
  const auto& movie = preset.movie;
  render::MovieStyle style;
  style.width = movie.size[0];
  style.height = movie.size[1];
  style.fps = movie.fps;
  style.quality = same_word<render::Quality>(movie.quality);
  style.colour_by = same_word<render::ColourBy>(movie.colour_by);
  style.azimuth_deg = movie.azimuth_deg;
  style.elevation_deg = movie.elevation_deg;
  style.turn_deg = movie.turn_deg;
  style.zoom = movie.zoom;
  style.inset = movie.inset;
  style.bins = movie.bins;
  style.captions = movie.captions;
  style.scale_bar_mm = pictures == Pictures::stills ? preset.figure.scale_bar_mm : 0;
  style.title = preset.title;
  return style;
}

Result<Artist> Artist::create(const std::string& context, int threads) {
  const auto kind = find_word<render::ContextKind>(context);
  if (!kind) return fail(Fault::bad_input, "--context " + context + ": no such context");
  // the software rasteriser reads this when its context is made
  if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  auto made = render::Context::create(*kind);
  if (!made) return tl::unexpected(made.error());
  auto renderer = render::Renderer::create(**made);
  if (!renderer) return tl::unexpected(renderer.error());
  return Artist(std::move(*made), std::move(*renderer));
}

Result<void> Artist::draw(Pictures pictures, const preset::Preset& preset,
                          const record::Trajectory& run, const fs::path& folder, Watch& watch) {
  return draw_pictures(pictures, preset, run, folder, watch).and_then([&]() -> Result<void> {
    // a frame that could not be read was drawn empty
    if (run.frames.fault()) return tl::unexpected(*run.frames.fault());
    return {};
  });
}

Result<void> Artist::draw_pictures(Pictures pictures, const preset::Preset& preset,
                                   const record::Trajectory& run, const fs::path& folder,
                                   Watch& watch) {
  const auto style = style_of(preset, pictures);
  if (pictures == Pictures::stills) {
    const auto stem = folder / fs::path(preset.name).filename();
    return render::write_stills(run, style, *renderer_, stem, watch).map([](const auto&) {});
  }
  return render::write_movie(run, style, *renderer_, folder / "frames", watch)
      .and_then([&](const auto&) {
        return render::encode_movie(folder / "frames", style.fps, folder / "movie.mp4", watch);
      })
      .map([](const auto&) {});
}

double expected_seconds(Pictures pictures, const preset::Preset& preset) {
  if (pictures == Pictures::none) return 0;
  const auto& movie = preset.movie;
  // a megapixel on two cores of a software rasteriser; captions and PNG are in it
  const double megapixel_seconds = movie.quality == preset::Quality::draft   ? 0.1
                                   : movie.quality == preset::Quality::movie ? 0.35
                                                                             : 15;
  const double count = pictures == Pictures::movie
                           ? movie.frames
                           : std::max(1.0, double(preset.figure.radii_mm.size()));
  return count * 1e-6 * movie.size[0] * movie.size[1] * megapixel_seconds;
}

std::string how_to_make_movie(const fs::path& folder, const preset::Preset& preset) {
  std::error_code error;
  const auto frames = folder / "frames", movie = folder / "movie.mp4";
  if (!fs::exists(frames, error) || fs::exists(movie, error)) return "";
  const auto line = render::shell_line(render::encode_arguments(frames, preset.movie.fps, movie));
  return "no ffmpeg on the PATH; this makes the movie:\n  " + line + "\n";
}

}  // namespace gridshell::app
