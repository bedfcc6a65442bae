#include "render/movie/movie_writer.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <system_error>

#include "engine/core/file_io.h"
#include "engine/core/try.h"
#include "render/canvas/canvas.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/run_figures.h"
#include "render/movie/stage.h"

namespace gridshell::render {

Worker::Worker() {
  try {
    thread_ = std::thread([this] { loop(); });
  } catch (const std::system_error&) {
    // without a thread begin() runs the job itself
  }
}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Worker::loop() {
  std::unique_lock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this] { return job_.valid() || over_; });
    if (!job_.valid()) return;
    auto job = std::move(job_);
    lock.unlock();
    job();
    lock.lock();
  }
}

void Worker::begin(const Job& job) {
  std::packaged_task<Result<void>()> task(job);
  running_ = task.get_future();
  if (!thread_.joinable()) return task();
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(task);
  }
  changed_.notify_all();
}

Result<void> Worker::wait() { return running_.valid() ? running_.get() : Result<void>{}; }

std::string frame_name(int index) { return fmt::format("frame_{:05d}.png", index); }

Result<void> FrameWriter::put(Image picture, DrawOverPicture over) {
  return finish().and_then([&] { return check(); }).map([&] {
    picture_ = std::move(picture);
    worker_.begin([this, over = std::move(over), index = begun_++] {
      if (over) over(picture_);
      return write_png(picture_, folder_ / frame_name(index)).map([&] {
        watch_.report(double(index + 1) / count_);
        if (on_frame_) on_frame_(index, picture_);
      });
    });
  });
}

Result<void> FrameWriter::finish() {
  TRY_DO(worker_.wait());
  written_ = begun_;
  return {};
}

Result<void> FrameWriter::check() {
  if (!watch_.cancelled()) return {};
  TRY_DO(finish());
  return fail(Fault::cancelled, "stopped after {} of {} frames", written_, count_);
}

namespace {

/// A picture, and the function that draws captions over it while the next picture is rendered.
struct DrawnFrame {
  Image picture;
  DrawOverPicture over = {};
};
using DrawFrame = std::function<Result<DrawnFrame>(int at)>;

Result<void> write_frames(int count, const DrawFrame& draw, const std::filesystem::path& folder,
                          Watch& watch, const FrameCallback& on_frame) {
  FrameWriter writer(folder, count, watch, on_frame);
  for (int k = 0; k < count; ++k) {
    TRY_DO(writer.check());
    TRY(frame, draw(k));
    TRY_DO(writer.put(std::move(frame->picture), std::move(frame->over)));
  }
  return writer.finish();
}

// the style of one run's part of the picture, without text of its own
MovieStyle without_captions(MovieStyle style) {
  style.captions = style.inset = style.bins = style.legends = false;
  style.scale_bar_mm = 0;
  // a shadow would end at the edge of its part
  style.look.floor = false;
  return style;
}

class SideBySideMovie {
 public:
  SideBySideMovie(const std::vector<NamedRun>& runs, const MovieStyle& style)
      : runs_(runs), style_(style) {
    em_ = style.font_scale *
          std::max(7.5, 0.024 * std::min<double>(style.height(), 0.72 * style.width()));
    MovieStyle part = without_captions(style);
    std::vector<RunSummary> surveys;
    std::vector<const RunSummary*> all;
    for (const NamedRun& one : runs) surveys.push_back(summarise_run(*one.run));
    for (const RunSummary& survey : surveys) all.push_back(&survey);
    bar_ = colour_bar_of(all, style);
    legend_ = bar_ ? colour_bar_width(*bar_, 0.95 * em_) + em_ : 0;
    const int count = int(runs.size()), rows = count > in_one_row ? 2 : 1;
    columns_ = (count + rows - 1) / rows;
    part.size = {
        std::max(16, int((style.width() - legend_ - 2 * em_) / columns_)),
        std::max(16, int((style.height() - title() - last_line()) / rows - above() - below()))};
    // shells are about as high as wide; the remaining height shows the forces of pushes
    const int high = int(0.92 * part.size[0]);
    const bool pushed = std::ranges::any_of(
        runs, [](const NamedRun& one) { return std::isfinite(one.run->frames.back().force_N); });
    if (style.captions && pushed && rows == 1 && part.size[1] - high > 8 * em_) {
      spare_ = part.size[1] - high;
      part.size[1] = high;
      std::vector<NamedRun> named;
      for (const NamedRun& one : runs) named.push_back({one.run, plain(one.name)});
      forces_ = force_plot(named);
      forces_.font_size = 0.9 * em_;
      for (Series& series : forces_.series) series.marker = Marker::none;
    }
    for (std::size_t k = 0; k < runs.size(); ++k)
      stages_.push_back(
          std::make_unique<Stage>(runs[k].run->layout, std::move(surveys[k]), part, bar_));
    // one timeline for all runs if they have the same axis and no marks
    const ProgressAxis& first = stages_.front()->progress();
    one_bar_ = std::ranges::all_of(stages_, [&](const auto& stage) {
      const ProgressAxis& axis = stage->progress();
      return stage->survey().marks.empty() && axis.name == first.name &&
             std::abs(axis.first - first.first) + std::abs(axis.last - first.last) < 0.05 &&
             axis.positions.size() == first.positions.size();
    });
  }

  int frames() const {
    int most = 0;
    for (const auto& stage : stages_) most = std::max(most, stage->frames());
    return most;
  }

  Result<Image> draw(int index, Renderer& renderer) const {
    std::vector<Image> parts;
    for (std::size_t run = 0; run < stages_.size(); ++run) {
      const int k = at(*stages_[run], index);
      TRY(part, stages_[run]->draw_views(renderer, {frame(run, k), k}));
      parts.push_back(std::move(*part));
    }
    return draw_picture(style_.width(), style_.height(), 1, style_.look.background,
                        [&](Canvas& canvas) {
                          for (std::size_t k = 0; k < parts.size(); ++k)
                            draw_part(canvas, k, parts[k], index);
                          draw_text(canvas, index);
                        });
  }

 private:
  static constexpr int in_one_row = 3;

  // heights of the title, of the last line, and of the texts above and below each row of parts
  double title() const { return style_.captions ? 2.4 * em_ : 0; }
  double last_line() const { return style_.captions ? 2 * em_ : 0; }
  double above() const { return style_.captions ? 3.8 * em_ : 0; }
  double below() const { return style_.captions ? 2.6 * em_ : 0; }
  /// Draws the forces over the depths, with a mark for the current state of each run.
  void draw_forces(Canvas& canvas, int index) const {
    Plot plot = forces_;
    for (std::size_t k = 0; k < runs_.size(); ++k) {
      const record::Frame& now = frame(k, at(*stages_[k], index));
      Series mark = mark_series("", series_colour(k), Marker::circle, 0.6 * em_);
      mark.add(now.depth_mm, now.force_N);
      plot.series.push_back(std::move(mark));
    }
    // between the timelines and the last line
    const double height = spare_ - 0.8 * em_, y = style_.height() - 2.2 * em_ - height;
    draw_plot(canvas, {em_, y, style_.width() - legend_ - 2 * em_, height}, plot);
  }

  const record::Frame& frame(std::size_t run, int k) const {
    return runs_[run].run->frames[std::size_t(k)];
  }
  static int at(const Stage& stage, int index) { return std::min(index, stage.frames() - 1); }

  void draw_part(Canvas& canvas, std::size_t k, const Image& part, int index) const {
    const auto columns = std::size_t(columns_), at_row = k / columns;
    const double row = double(at_row), column = double(k % columns);
    const Box box{em_ + column * part.width,
                  title() + above() + row * (above() + part.height + below()), double(part.width),
                  double(part.height)};
    canvas.picture(part, box);
    if (!style_.captions) return;
    const int now = at(*stages_[k], index);
    const record::Frame& shown = frame(k, now);
    TextStyle text{.size = em_, .bold = true, .align_x = AlignX::centre, .align_y = AlignY::middle};
    const double x = box.middle().x, width = box.width - em_;
    const TextStyle name = canvas.fitted(plain(runs_[k].name), width, text, 0.7);
    canvas.text(plain(canvas.shortened(runs_[k].name, width, name)), {x, box.y - 2.9 * em_}, name);
    text.bold = false;
    std::string state;
    for (const std::string& caption : state_captions(shown)) {
      // captions in the order of their importance, as many as fit
      const std::string longer = state.empty() ? caption : state + "    " + caption;
      if (canvas.measure(longer, text).width <= width) state = longer;
    }
    canvas.text(state, {x, box.y - 1.4 * em_}, text);
    std::string what = stages_[k]->ghost_caption(shown);
    if (const std::string event = event_caption(shown); !event.empty()) {
      what = event;
      text.colour = event_ink;
    }
    canvas.text(plain(canvas.shortened(what, width, text)), {x, box.bottom() + 0.8 * em_}, text);
    if (one_bar_) return;
    const double length = std::min(width, 18 * em_);
    draw_timeline(canvas, {x - length / 2, box.bottom() + 1.7 * em_, length, 0.9 * em_},
                  stages_[k]->survey().marks, stages_[k]->progress(), now, em_);
  }

  void draw_text(Canvas& canvas, int index) const {
    if (bar_) {
      const double width = legend_ - em_, height = std::min(20 * em_, 0.6 * style_.height());
      draw_colour_bar(canvas, {style_.width() - em_ - width, title() + above(), width, height},
                      *bar_, 0.95 * em_);
    }
    if (!style_.captions) return;
    if (spare_ > 0) draw_forces(canvas, index);
    constexpr double least = 0.7;
    const double room = style_.width() - 2 * em_;
    const TextStyle title =
        canvas.fitted(plain(style_.title), room,
                      {.size = 1.15 * em_, .bold = true, .align_y = AlignY::middle}, least);
    canvas.text(plain(canvas.shortened(style_.title, room, title)), {em_, 1.5 * em_}, title);
    if (one_bar_)
      draw_timeline(canvas, {em_, style_.height() - 1.8 * em_, room - legend_, 1.2 * em_}, {},
                    stages_.front()->progress(), at(*stages_.front(), index), em_);
  }

  const std::vector<NamedRun>& runs_;
  MovieStyle style_;
  int columns_ = 1;
  bool one_bar_ = false;
  double em_ = 0, legend_ = 0;  // of the font; of the colour bar's column
  double spare_ = 0;            // height below the parts for the forces; 0: there is none
  Plot forces_;
  std::optional<ColourBar> bar_;
  std::vector<std::unique_ptr<Stage>> stages_;
};

}  // namespace

Result<void> write_movie(const FrameSource& source, RunSummary survey, const MovieStyle& style,
                         const std::optional<ColourBar>& bar, Renderer& renderer,
                         const std::filesystem::path& folder, Watch& watch,
                         const FrameCallback& on_frame) {
  TRY_DO(check_size(style));
  if (source.count < 1) return invalid("the run has no frame to show");
  TRY_DO(check_coloured(survey, style));
  TRY_DO(make_folder(folder));
  const Stage stage(*source.layout, std::move(survey), style, bar);
  const auto draw = [&](int k) -> Result<DrawnFrame> {
    TRY(read, source.at(k));
    const auto frame = std::make_shared<const record::Frame>(std::move(*read));
    TRY_DO(check_frame(*source.layout, *frame, k, style));
    TRY(picture, stage.draw_views(renderer, {*frame, k}));
    return DrawnFrame{std::move(*picture), [&stage, frame, k](Image& image) {
                        stage.finish(image, {*frame, k});
                      }};
  };
  return write_frames(source.count, draw, folder, watch, on_frame);
}

Result<void> write_side_by_side(const std::vector<NamedRun>& runs, const MovieStyle& style,
                                Renderer& renderer, const std::filesystem::path& folder,
                                Watch& watch, const FrameCallback& on_frame) {
  if (runs.empty()) return invalid("there is no run to show");
  for (const NamedRun& one : runs) TRY_DO(check_showable(*one.run, style));
  TRY_DO(make_folder(folder));
  const SideBySideMovie movie(runs, style);
  const auto draw = [&](int k) {
    return movie.draw(k, renderer).map([](Image&& picture) {
      return DrawnFrame{std::move(picture)};
    });
  };
  return write_frames(movie.frames(), draw, folder, watch, on_frame);
}

}  // namespace gridshell::render
