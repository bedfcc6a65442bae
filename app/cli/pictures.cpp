#include "app/cli/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/try.h"
#include "engine/gridshell.h"
#include "render/gl/image.h"
#include "render/movie/colour_by.h"
#include "render/movie/encode.h"
#include "render/movie/movie_style.h"
#include "render/movie/movie_writer.h"
#include "render/movie/shell_lines.h"
#include "render/movie/stage.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;

namespace {

// "#rrggbb", which the preset's reader has looked at
render::Colour colour_of(const std::string& text) {
  return render::hex_colour(std::strtol(text.c_str() + 1, nullptr, 16));
}

void choose(render::Colour& colour, const std::string& wish) {
  if (wish == "transparent")
    colour.a = 0;
  else if (!wish.empty())
    colour = colour_of(wish);
}
void choose(double& width, double wish) {
  if (wish > 0) width = wish;
}
void choose(bool& flag, preset::Visibility wish) {
  if (wish != preset::Visibility::automatic) flag = wish == preset::Visibility::on;
}

std::optional<std::array<double, 2>> range_of(const std::vector<double>& range) {
  if (range.empty()) return std::nullopt;
  return std::array{range[0], range[1]};
}

std::optional<render::ColourMap> map_of(preset::ColourMap map) {
  switch (map) {
    case preset::ColourMap::automatic:
      return std::nullopt;
    case preset::ColourMap::diverging:
      return render::ColourMap::diverging;
    case preset::ColourMap::sequential:
      return render::ColourMap::sequential;
    case preset::ColourMap::grey:
      return render::ColourMap::grey;
  }
  return std::nullopt;
}

render::Appearance look_of(const preset::Style& style) {
  render::Appearance look =
      style.theme == preset::Theme::paper ? render::paper_appearance() : render::Appearance{};
  choose(look.rod_mm, style.rod_width_mm);
  choose(look.joint_mm, style.joint_width_mm);
  choose(look.ring_mm, style.ring_width_mm);
  choose(look.rod, style.rod_colour);
  choose(look.joint, style.joint_colour);
  choose(look.ring, style.ring_colour);
  choose(look.background, style.background);
  choose(look.cells, style.cells);
  choose(look.rings, style.rings);
  choose(look.floor, style.floor);
  choose(look.shadow, style.shadow);
  if (style.joints == preset::Visibility::off) look.joint_mm = 0;
  if (style.joints == preset::Visibility::on && look.joint_mm == 0)
    look.joint_mm = render::Appearance{}.joint_mm;
  look.map = map_of(style.colour_map);
  look.range = range_of(style.range);
  look.far_fade = style.far_fade;
  look.letters = style.letters;
  return look;
}

// azimuth and elevation of a standard view
std::optional<render::ViewDirection> direction_of(preset::View view) {
  switch (view) {
    case preset::View::free:
      return std::nullopt;
    case preset::View::front:
      return render::ViewDirection{-90, 0};
    case preset::View::side:
      return render::ViewDirection{0, 0};
    case preset::View::top:
      return render::ViewDirection{-90, 90};
    case preset::View::corner:
      return render::ViewDirection{-45, 35.264};
  }
  return std::nullopt;
}

}  // namespace

render::MovieStyle style_of(const preset::Preset& preset, Pictures pictures) {
  const auto& movie = preset.movie;
  const bool stills = pictures == Pictures::stills;
  render::MovieStyle style;
  style.width = movie.size[0];
  style.height = movie.size[1];
  style.fps = movie.fps;
  style.quality = same_word<render::Quality>(stills ? preset.figure.quality : movie.quality);
  style.colour_by = same_word<render::ColourBy>(movie.colour_by);
  style.azimuth_deg = movie.azimuth_deg;
  style.elevation_deg = movie.elevation_deg;
  if (const auto standard = direction_of(movie.view)) {
    style.azimuth_deg = standard->azimuth_deg;
    style.elevation_deg = standard->elevation_deg;
  }
  style.turn_deg = movie.turn_deg;
  style.zoom = movie.zoom;
  if (!movie.target_mm.empty())
    style.target_mm = Eigen::Vector3d(movie.target_mm[0], movie.target_mm[1], movie.target_mm[2]);
  style.orthographic = movie.orthographic;
  for (const auto& view : movie.views) style.views.push_back({view[0], view[1]});
  style.inset = movie.inset;
  style.bins = movie.bins;
  style.bins_range = range_of(movie.bins_range);
  style.captions = movie.captions;
  style.scale_bar_mm = stills ? preset.figure.scale_bar_mm : 0;
  style.title = preset.title;
  style.source = preset.source;
  style.font_scale = preset.style.font_size;
  style.look = look_of(preset.style);
  style.vector = stills && preset.figure.vector;
  if (stills && preset.figure.width_mm > 0) {
    style.print = {preset.figure.width_mm, preset.figure.dpi};
    const double aspect = double(style.height) / style.width;
    style.width =
        std::clamp(int(std::lround(style.print.width_mm / 25.4 * style.print.dpi)), 16, 16384);
    style.height = std::clamp(int(std::lround(aspect * style.width)), 16, 16384);
  }
  style.seconds = movie.seconds;
  style.hold_s = movie.hold_s;
  style.title_s = movie.title_s;
  style.pace = same_word<render::Pace>(movie.pace);
  return style;
}

Eigen::Matrix3Xd scan_of(const preset::Preset& preset) {
  const preset::Points& points = preset.figure.scan;
  Eigen::Matrix3Xd scan(3, points.size());
  for (Eigen::Index k = 0; k < scan.cols(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      scan(axis, k) = points[std::size_t(k)].at(std::size_t(axis));
  return scan;
}

Result<PictureMaker> PictureMaker::create(const std::string& context, int threads,
                                          const std::string& font) {
  TRY_DO(render::use_font(font));
  // the software rasteriser reads this when its context is made
  if (threads > 0) setenv("LP_NUM_THREADS", std::to_string(threads).c_str(), 1);
  return create(context);
}

Result<PictureMaker> PictureMaker::create(const std::string& context) {
  const auto kind = find_word<render::ContextKind>(context);
  if (!kind) return fail(Fault::bad_input, "--context " + context + ": no such context");
  TRY(made, render::Context::create(*kind));
  TRY(renderer, render::Renderer::create(**made));
  return PictureMaker(std::move(*made), std::move(*renderer));
}

namespace {

// the last frame as lines
Result<void> write_lines(const record::Trajectory& run, render::MovieStyle style,
                         const fs::path& stem) {
  style.captions = style.inset = style.legends = false;
  style.turn_deg = 0;
  const render::Stage stage(run, style);
  const int last = stage.frames() - 1;
  const double points = style.print.width_pt(0.5 * style.width);
  const auto drawing = stage.drawing(run.frames.back());
  return render::write_figure(fs::path(stem) += "_lines", points,
                              points * style.height / style.width, style.title,
                              [&](render::Canvas& canvas) {
                                const render::Box page{0, 0, canvas.width(), canvas.height()};
                                render::draw_shell_lines(canvas, page, drawing, stage.camera(last));
                              });
}

/// Of stills that each show the end of a step: which; else what the stills say by themselves.
std::vector<std::string> captions_of(const preset::Preset& preset, const record::Trajectory& run) {
  std::vector<std::string> captions;
  if (preset.step.empty() || run.frames.size() != preset.step.size() + 1) return captions;
  captions.push_back(render::frame_state_caption(run.frames.front()));
  for (std::size_t k = 0; k < preset.step.size(); ++k) {
    const preset::Step& step = preset.step[k];
    const record::Frame& frame = run.frames[k + 1];
    // a depth belongs to the push that made it, not to what was done while it holds
    const bool pushes = step.kind == preset::StepKind::push;
    captions.push_back(
        experiment::text_of(step) + ": " +
        (pushes ? render::frame_state_caption(frame) : render::unpushed_caption(frame)));
  }
  return captions;
}

/// The first and last frame.
record::Trajectory ends_of(const record::Trajectory& run) {
  record::Trajectory ends;
  ends.layout = run.layout;
  ends.frames = {run.frames.front(), run.frames.back()};
  return ends;
}

Result<void> draw_stills(const preset::Preset& preset, const record::Trajectory& run,
                         const SharedColourBar& bar, render::Renderer& renderer,
                         const fs::path& folder, Watch& watch) {
  const auto style = style_of(preset, Pictures::stills);
  const auto stem = folder / fs::path(preset.name).filename();
  TRY_DO(render::write_stills(run, style, bar, renderer, stem, watch, captions_of(preset, run)));
  return style.vector ? write_lines(run, style, stem) : Result<void>{};
}

Result<void> draw_movie(const Run& run, const SharedColourBar& bar, render::Renderer& renderer,
                        const fs::path& folder, Watch& watch) {
  const auto style = style_of(run.preset, Pictures::movie);
  TRY_DO(render::check_showable(run.trajectory, style));
  return make_movie(folder, run.preset, style, int(run.trajectory.frames.size()), watch,
                    [&](const render::FrameCallback& seen) {
                      return render::write_movie(render::source_of(run.trajectory),
                                                 render::summarise_run(run.trajectory), style, bar,
                                                 renderer, folder / "frames", watch, seen);
                    });
}

}  // namespace

Result<void> draw_run(const Run& run, const SharedColourBar& bar, render::Renderer& renderer,
                      const fs::path& folder, Watch& watch) {
  // the other frames of a push are for the curve of its force
  constexpr std::size_t most_steps = 8;
  const bool ends = run.preset.indentation.wanted() || run.preset.step.size() > most_steps;
  if (run.pictures == Pictures::movie)
    TRY_DO(draw_movie(run, bar, renderer, folder, watch));
  else if (ends)
    TRY_DO(draw_stills(run.preset, ends_of(run.trajectory), bar, renderer, folder, watch));
  else
    TRY_DO(draw_stills(run.preset, run.trajectory, bar, renderer, folder, watch));
  // a frame that could not be read was drawn empty
  if (const auto& fault = run.trajectory.frames.fault()) return tl::unexpected(*fault);
  return {};
}

render::MovieTiming timing_of(const render::MovieStyle& style, int frames) {
  return {style.fps, frames, style.seconds, style.hold_s, style.pace, style.title_s};
}

Result<void> make_movie(const fs::path& folder, const preset::Preset& preset,
                        const render::MovieStyle& style, int frames, Watch& watch,
                        const DrawFrames& draw) {
  const fs::path pictures = folder / "frames";
  const render::MovieTiming timing = timing_of(style, frames);
  TRY_DO(make_folder(pictures));
  if (style.title_s > 0)
    TRY_DO(render::write_png(render::title_card(style), pictures / "title.png"));
  TRY(movie, render::MovieEncoder::begin(pictures, timing, style.width, style.height,
                                         folder / "movie.mp4"));
  TRY_DO(draw([&](int, const render::Image& picture) {
    if (*movie) (*movie)->put(picture, watch);
  }));
  if (*movie) TRY_DO((*movie)->finish(watch));
  if (preset.movie.poster) {
    std::error_code error;
    fs::copy_file(pictures / render::frame_name(frames - 1), folder / "poster.png",
                  fs::copy_options::overwrite_existing, error);
    if (error) return fail(Fault::io, "cannot write poster.png: " + error.message());
  }
  for (const auto& [wanted, kind] :
       {std::pair(preset.movie.webm, "movie.webm"), {preset.movie.gif, "movie.gif"}})
    if (wanted) TRY_DO(render::encode_movie(pictures, timing, folder / kind, watch));
  return {};
}

std::vector<SharedColourBar> shared_bars(const std::vector<Run>& runs) {
  std::vector<render::RunSummary> surveys;
  for (const Run& run : runs) surveys.push_back(render::summarise_run(run.trajectory));
  std::vector<SharedColourBar> bars;
  for (const Run& run : runs) {
    // what is coloured by something else has a bar of its own
    std::vector<const render::RunSummary*> alike;
    for (std::size_t k = 0; k < runs.size(); ++k)
      if (runs[k].preset.movie.colour_by == run.preset.movie.colour_by)
        alike.push_back(&surveys[k]);
    bars.push_back(render::colour_bar_of(alike, style_of(run.preset, run.pictures)));
  }
  return bars;
}

double expected_seconds(Pictures pictures, const preset::Preset& preset) {
  if (pictures == Pictures::none) return 0;
  const auto& movie = preset.movie;
  const bool stills = pictures == Pictures::stills;
  const auto quality = stills ? preset.figure.quality : movie.quality;
  // a megapixel on two cores of a software rasteriser; captions and PNG are in it
  const double megapixel_seconds = quality == preset::Quality::draft   ? 0.05
                                   : quality == preset::Quality::movie ? 0.085
                                                                       : 1.4;
  double count = movie.frames;
  if (stills) {
    // the stills, and what stands beside nets and loads
    const bool push = preset.indentation.wanted();
    count = std::max(push ? 2.0 : 1.0, double(preset.figure.radii_mm.size()));
    if (preset.jitter.wanted()) count = preset.jitter.drawn;
    if (push)
      count += 1;
    else if (preset.on_net())
      count += 2;
  }
  const auto style = style_of(preset, pictures);
  return count * 1e-6 * style.width * style.height * megapixel_seconds;
}

std::string how_to_make_movie(const fs::path& folder, const preset::Preset& preset) {
  std::error_code error;
  const auto frames = folder / "frames", movie = folder / "movie.mp4";
  if (!fs::exists(frames, error) || fs::exists(movie, error)) return "";
  const auto style = style_of(preset, Pictures::movie);
  const auto line = render::shell_line(
      render::encode_arguments(frames, timing_of(style, preset.movie.frames), movie));
  return "no ffmpeg on the PATH; this makes the movie:\n  " + line + "\n";
}

}  // namespace gridshell::app
