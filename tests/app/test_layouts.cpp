// Texts in the pictures of every preset: none leaves its panel or overlaps another, at any size or
// zoom.
#include <mutex>
#include <utility>
#include <vector>

#include "app/cli/console.h"
#include "app/cli/pictures.h"
#include "app/cli/preset_library.h"
#include "app/cli/produce.h"
#include "render/movie/run_figures.h"
#include "render/movie/run_plots.h"
#include "render/movie/stage.h"
#include "render/movie/stills.h"
#include "tests/render/canvas/ink.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

// a run with everything that a caption can name: bins, a push, an unstable frame, events
record::Trajectory eventful(bool pushed) {
  record::Trajectory run = synthetic::dome(9, 1);
  for (std::size_t k = 0; k < run.frames.size(); ++k) {
    record::Frame& frame = run.frames.edit()[k];
    frame.K_bins.resize(5, 3);
    for (int bin = 0; bin < 5; ++bin) frame.K_bins.row(bin) << 0.03 + 0.004 * bin, 0.01, 20;
    if (!pushed) continue;
    frame.depth_mm = 1.5 * double(k);
    frame.force_N = -0.1234 * double(k);
  }
  if (pushed) run.layout.loaded_joints = {{50, -Eigen::Vector3d::UnitZ()}};
  run.frames.edit()[2].negative_pivots = 12;
  run.frames.edit()[4].event = "snap at depth 12.34 mm";
  run.frames.edit()[8].event = "locking";
  return run;
}

/// Draws, and checks that no text overlaps another or a marker, or leaves the picture.
void check_words(double width, double height, const DrawOn& draw) {
  (void)draw_picture(width, height, 1, {}, [&](Canvas& canvas) {
    draw(canvas);
    test::check_apart(canvas, true);
  });
}

using Sizes = std::vector<std::pair<int, int>>;

/// Checks the texts of every preset's frames and stills, in the preset's size and in others.
void check_words_of_all(const Sizes& sizes, const std::vector<double>& zooms,
                        const std::vector<int>& frames) {
  for (const auto& embedded : app::embedded_presets()) {
    const auto presets = value_of(app::load_preset(embedded.name, {}));
    for (const auto& one : app::runs_of(presets)) {
      const record::Trajectory run = eventful(one.preset.indentation.requested());
      for (const auto pictures : {app::Pictures::movie, app::Pictures::stills}) {
        MovieStyle style = app::style_of(one.preset, pictures);
        Sizes all = sizes;
        all.emplace_back(style.width(), style.height());
        for (const auto& [width, height] : all)
          for (const double zoom : zooms) {
            style.size = {width, height};
            style.zoom = zoom;
            const Stage stage(run, style);
            INFO(embedded.name << " " << one.name << " " << width << " x " << height);
            for (const int at : frames)
              check_words(width, height, [&](Canvas& canvas) {
                stage.draw_overlay(canvas, {run.frames[std::size_t(at)], at});
                if (stage.layout().title.empty()) return;
                for (const Box& box : canvas.text_boxes())
                  CHECK_FALSE(box.overlaps(stage.layout().view));
              });
          }
      }
    }
  }
}

}  // namespace

TEST_CASE("in every preset's frames and stills no text leaves the picture or meets another",
          "[standard]") {
  check_words_of_all({{320, 240}}, {1}, {2, 8});
}

TEST_CASE("no texts of tall and wide pictures and of close-ups overlap", "[full]") {
  check_words_of_all({{320, 240}, {720, 1280}, {1920, 500}}, {1, 3}, {0, 2, 4, 8});
}

TEST_CASE("a narrow still has its whole title, in two lines where one is too short") {
  int wrapped = 0;
  for (const auto& embedded : app::embedded_presets()) {
    const auto presets = value_of(app::load_preset(embedded.name, {}));
    MovieStyle style = still_style(app::style_of(presets.base, app::Pictures::stills));
    style.size = {302, 170};
    const record::Trajectory run = eventful(true);
    const Stage stage(run, style);
    INFO(embedded.name);
    check_words(style.width(), style.height(), [&](Canvas& canvas) {
      draw_still_labels(canvas, stage, {run.frames[2], 2},
                        "joint (−2, −2) pushed, far from its middle: *δ* = 10.00 mm");
    });
    std::string title;
    for (const std::string& line : stage.layout().title_lines)
      title += (title.empty() ? "" : " ") + line;
    CHECK(title == style.title);
    wrapped += stage.layout().title_lines.size() == 2;
  }
  CHECK(wrapped > 0);
}

TEST_CASE("in what `figure` and `movie` make of every preset no text meets another or a data point",
          "[full]") {
  for (const auto& embedded : app::embedded_presets())
    for (const auto pictures : {app::Pictures::stills, app::Pictures::movie}) {
      const bool states = app::load_preset(embedded.name, {})->base.jitter.requested();
      if (states && pictures == app::Pictures::movie) continue;  // states have no movie
      const TemporaryFolder folder;
      app::Options options;
      options.input = embedded.name;
      options.output = folder / "run";
      options.quiet = true;
      options.size.append(pictures == app::Pictures::movie ? "480x270" : "640x360");
      options.quality.append("draft");
      options.frames.append("2");
      options.set = {"accuracy.edges_per_segment=4"};  // one mesh, nothing is confirmed
      if (states)
        options.set.insert(options.set.end(), {"jitter.trials=3", "jitter.confined=3",
                                               "jitter.transitions=1", "jitter.drawn=2"});
      INFO(embedded.name << (pictures == app::Pictures::movie ? ", movie" : ", figure"));
      // movies write their texts on another thread, while this one checks nothing
      std::mutex mutex;
      std::size_t words = 0;
      {
        const test::CanvasObserver watch([&](const Canvas& canvas) {
          const std::lock_guard lock(mutex);
          test::check_apart(canvas, true);
          words += canvas.texts().size();
        });
        const int code = app::report(app::produce(options, pictures));
        // some paths end early on this coarse mesh, which does not matter for their texts
        CHECK(code <= app::ExitCode::failed);
      }
      CHECK(words > 5);
    }
}

TEST_CASE("words in plots of bins and forces do not overlap, however narrow") {
  const record::Trajectory run = eventful(true);
  const RunSummary survey = summarise_run(run);
  for (const double width : {150.0, 186.0, 260.0, 500.0}) {
    Plot bins = bins_plot(survey, long(run.layout.cells.size()), run.frames.back(), {}, 7.5);
    bins.title = "Inward at 45° latitude and longitude, a long name\nΣ*K*_{□} = 5.898 rad, −1.78 %";
    Plot force = force_plot({{&run, "the first of two long names that do not fit"},
                             {&run, "the second of two long names that do not fit"}});
    for (const Plot& plot : {bins, force}) {
      INFO(width);
      const Box box{3, 3, width - 6, 184};
      check_words(width, 190, [&](Canvas& canvas) { draw_plot(canvas, box, plot); });
    }
  }
}
