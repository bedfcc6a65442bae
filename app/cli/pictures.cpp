#include "app/cli/pictures.h"

#include <fmt/format.h>
#include <algorithm>

#include "engine/core/try.h"
#include "render/gl/image.h"
#include "render/movie/encode.h"
#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "render/movie/stills.h"

namespace gridshell::app {
namespace fs = std::filesystem;

render::MovieStyle style_of(const preset::Preset& preset, Pictures pictures) {
  return pictures == Pictures::stills ? render::figure_style(preset) : render::movie_style(preset);
}

Eigen::Matrix3Xd scan_of(const preset::Preset& preset) {
  const preset::Points& points = preset.figure.scan;
  Eigen::Matrix3Xd scan(3, points.size());
  for (Eigen::Index k = 0; k < scan.cols(); ++k)
    for (int axis = 0; axis < 3; ++axis)
      scan(axis, k) = points[std::size_t(k)].at(std::size_t(axis));
  return scan;
}

Result<PictureMaker> PictureMaker::create(const std::string& context, const std::string& font) {
  TRY_DO(render::use_font(font));
  return create(context);
}

Result<PictureMaker> PictureMaker::create(const std::string& context) {
  const auto kind = find_word<render::ContextKind>(context);
  if (!kind) return invalid("--context " + context + ": no such context");
  TRY(made, render::Context::create(*kind));
  TRY(renderer, render::Renderer::create(**made));
  return PictureMaker(std::move(*made), std::move(*renderer));
}

namespace {

/// What a step did, as text for the caption of its still: "joint (1, −2) pushed".
std::string done_by(const preset::Step& step) {
  using enum preset::StepKind;
  const auto joint = [&](const char* done) {
    if (step.joint.size() < 2) return std::string("joints ") + done;
    std::string at = fmt::format("joint ({}, {}) {}", step.joint[0], step.joint[1], done);
    for (std::size_t k = 0; (k = at.find("-", k)) != at.npos;) at.replace(k, 1, "−");
    return at;
  };
  switch (step.kind) {
    case move:
      return "boundary moved";
    case push:
      return joint("pushed");
    case hold:
      return joint("fixed");
    case release:
      return step.what == preset::Released::joints ? joint("released")
                                                   : fmt::format("{} removed", word_of(step.what));
    case load:
      return step.load_case.empty() ? "loads changed" : "load case " + step.load_case;
    case rest:
      return "in equilibrium";
    case jitter:
      return "perturbed";
    case tighten:
      return "joints tightened";
    case brace:
      return "cells braced";
    case open:
      return "joints opened";
  }
  return "";
}

/// Captions that name the step whose end a still shows; empty if the stills are not ends of steps.
std::vector<std::string> captions_of(const preset::Preset& preset, const record::Trajectory& run) {
  std::vector<std::string> captions;
  if (preset.step.empty() || run.frames.size() != preset.step.size() + 1) return captions;
  captions.push_back(render::frame_state_caption(run.frames.front()));
  for (std::size_t k = 0; k < preset.step.size(); ++k) {
    const preset::Step& step = preset.step[k];
    const record::Frame& frame = run.frames[k + 1];
    // a depth belongs to the push that made it, not to what was done while the joint is prescribed
    const bool pushes = step.kind == preset::StepKind::push;
    captions.push_back(
        done_by(step) + ": " +
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
  return {};
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
  // the frames between them are for the curve of the force
  constexpr std::size_t most_steps = 8;
  const bool ends = run.preset.indentation.requested() || run.preset.step.size() > most_steps;
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

record::Frame moved_by(const record::Trajectory& state, const Eigen::Matrix3Xd& shape, double part,
                       int index) {
  const record::Frame& rest = state.frames.back();
  record::Frame frame;
  frame.index = index;
  frame.actuation = rest.actuation;
  frame.depth_mm = drawn_move_mm(state.layout);
  frame.nodes = rest.nodes + part * frame.depth_mm * shape;
  frame.cell_K = rest.cell_K;
  frame.brace_force_N = rest.brace_force_N;
  frame.negative_pivots = -1;
  return frame;
}

const render::ColourBar bar_of_moves{.label = "|*u*| / max |*u*|",
                                     .scale = {render::sequential, 0, 1, 0.2},
                                     .words = "displacement over the largest"};

Result<void> make_movie(const fs::path& folder, const preset::Preset& preset,
                        render::MovieStyle style, int frames, Watch& watch,
                        const DrawFrames& draw) {
  const fs::path pictures = folder / "frames";
  style.frames = frames;
  TRY_DO(make_folder(pictures));
  if (style.title_s > 0) {
    TRY(card, render::title_card(style));
    TRY_DO(render::write_png(*card, folder / "title.png"));
  }
  TRY(movie, render::MovieEncoder::begin(pictures, style, folder / "movie.mp4"));
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
  for (const auto& [requested, kind] :
       {std::pair(preset.movie.webm, "movie.webm"), {preset.movie.gif, "movie.gif"}})
    if (requested) TRY_DO(render::encode_movie(pictures, style, folder / kind, watch));
  return {};
}

std::vector<SharedColourBar> shared_bars(const std::vector<Run>& runs) {
  std::vector<render::RunSummary> surveys;
  for (const Run& run : runs) surveys.push_back(render::summarise_run(run.trajectory));
  std::vector<SharedColourBar> bars;
  for (const Run& run : runs) {
    // the runs that are coloured by the same quantity
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
  // measured with a software rasteriser on two cores, including captions and PNG
  const double megapixel_seconds = quality == preset::Quality::draft   ? 0.05
                                   : quality == preset::Quality::movie ? 0.085
                                                                       : 1.4;
  double count = movie.frames;
  if (stills) {
    // the stills, and the pictures of nets and pushes
    const bool push = preset.indentation.requested();
    count = std::max(push ? 2.0 : 1.0, double(preset.figure.radii_mm.size()));
    if (preset.jitter.requested()) count = preset.jitter.drawn;
    if (push)
      count += 1;
    else if (preset.on_net())
      count += 2;
  }
  const auto style = style_of(preset, pictures);
  return count * 1e-6 * style.width() * style.height() * megapixel_seconds;
}

std::string how_to_make_movie(const fs::path& folder, const preset::Preset& preset) {
  std::error_code error;
  const auto frames = folder / "frames", movie = folder / "movie.mp4";
  if (!fs::exists(frames, error) || fs::exists(movie, error)) return "";
  const auto line = render::shell_line(render::encode_arguments(frames, preset.movie, movie));
  return "no ffmpeg on the PATH; this makes the movie:\n  " + line + "\n";
}

}  // namespace gridshell::app
