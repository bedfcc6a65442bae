#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "render/gl/renderer.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "tests/presets.h"
#include "tests/render/canvas/ink.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

MovieStyle titled(int width, int height) {
  MovieStyle style;
  style.size = {width, height};
  style.scale_bar_mm = 20;
  style.title =
      "Actuation of a circular_gridshell with a title that is long enough to need cutting "
      "somewhere before its end in most of the sizes";
  return style;
}

MovieStyle coloured(ColourBy by) {
  MovieStyle style;
  style.colour_by = by;
  return style;
}

/// The texts drawn over frame k.
std::vector<std::string> texts_of(const Stage& stage, const record::Trajectory& run, int k) {
  std::vector<std::string> texts;
  (void)draw_picture(1280, 720, 1, {}, [&](Canvas& canvas) {
    stage.draw_overlay(canvas, {run.frames[std::size_t(k)], k});
    texts = canvas.texts();
  });
  return texts;
}

}  // namespace

TEST_CASE("captions, legends and view of a finished frame neither overlap nor leave the picture") {
  record::Trajectory run = synthetic::dome(12, 2);
  run.frames.edit()[8].depth_mm = 12.3;
  run.frames.edit()[8].force_N = -0.214;
  run.frames.edit()[8].negative_pivots = 12;
  for (const auto& [width, height] :
       {std::pair{320, 240}, {640, 360}, {1280, 720}, {3840, 2160}, {720, 1280}, {500, 500}}) {
    const Stage stage(run, titled(width, height));
    INFO(width << " x " << height);
    const Image image = *draw_picture(width, height, 1, white, [&](Canvas& canvas) {
      stage.draw_overlay(canvas, {run.frames[8], 8});
      test::check_apart(canvas);
      for (const Box& text : canvas.text_boxes()) CHECK_FALSE(text.overlaps(stage.layout().view));
    });
    CHECK(test::rim_is_white(image));
  }
}

TEST_CASE("a frame says what it is") {
  const record::Trajectory run = synthetic::dome(12, 2);
  MovieStyle style = titled(1280, 720);
  style.title = "Movie_S1 *really*";
  const Stage stage(run, style);
  const auto last = texts_of(stage, run, 11);
  for (const std::string text : {"Movie_S1 *really*", "Ra = 94.5 mm", "height 66.0 mm",
                                 "Ra = 126.0", "94.5 mm", "K□ (rad)", "20 mm"}) {
    INFO(text);
    CHECK(test::has(last, text));
  }
  // neither frames nor the solver's numbers
  for (const std::string& text : last)
    CHECK_FALSE((text.starts_with("frame ") || text.starts_with("residual")));
  // an event is reported by its own frame alone; the timeline keeps that there was one
  for (int k : {7, 8, 9}) {
    CHECK(test::has(texts_of(stage, run, k), "snap at a radius of 104.9 mm") == (k == 8));
    CHECK(test::has(texts_of(stage, run, k), "snap") == (k >= 8));
  }
}

TEST_CASE("an event too long for one line has two") {
  record::Trajectory run = synthetic::dome(12, 2);
  const std::string snap = "snap at depth 33.851 mm;",
                    touch = "joints (-1, -1) and (0, 0) touch at depth 33.41 mm ± 0.04 mm";
  run.frames.edit()[8].event = snap + " " + touch;
  CHECK(test::has(texts_of(Stage(run, titled(1920, 1080)), run, 8), snap + " " + touch));
  const auto two = texts_of(Stage(run, titled(800, 600)), run, 8);
  CHECK(test::has(two, snap));
  CHECK(test::has(two, touch));
  run.frames.edit()[8].event = "one event of many words " + touch + " " + touch;
  const auto words = texts_of(Stage(run, titled(800, 600)), run, 8);
  CHECK(std::ranges::count_if(words, [](const std::string& text) {
          return text.starts_with("one event of many words") && !text.ends_with("…");
        }) == 1);
}

TEST_CASE("captions name only what is known") {
  record::Frame frame;
  frame.height_mm = 12.34;
  CHECK(state_captions(frame) == std::vector<std::string>{"height 12.3 mm"});
  frame.boundary_radius_mm = 115.9;
  frame.depth_mm = 7.5;
  frame.force_N = 0.2137;
  // if the boundary does not move, captions of a push name the depth instead of the radius
  frame.actuation = 0.8;
  CHECK(state_captions(frame)[2] == "*R*_{a} = 115.9 mm");
  frame.actuation = 1;
  CHECK(state_captions(frame) ==
        std::vector<std::string>{"*δ* = 7.50 mm", "*F* = 0.214 N", "height 12.3 mm"});
  frame.depth_mm = frame.force_N = record::unknown;
  CHECK(state_captions(frame) == std::vector<std::string>{"*R*_{a} = 115.9 mm", "height 12.3 mm"});
}

TEST_CASE("an unstable frame says so once, a stable one never") {
  record::Trajectory run = synthetic::dome(12, 2);
  for (int k : {4, 5}) {
    run.frames.edit()[std::size_t(k)].negative_pivots = 2;
    run.frames.edit()[std::size_t(k)].event = "unstable: 2 negative pivots";
  }
  const Stage stage(run, titled(1280, 720));
  for (int k = 0; k < 12; ++k) {
    int unstable = 0, sign = 0;
    for (const std::string& text : texts_of(stage, run, k)) {
      unstable += text == "unstable equilibrium";
      sign += text == "unstable";
    }
    INFO("frame " << k);
    CHECK(unstable == (k == 4 || k == 5));
    CHECK(sign == (k >= 4));  // of the timeline
  }
  record::Frame silent;
  silent.negative_pivots = 1;
  CHECK(event_caption(silent) == "unstable equilibrium");
}

TEST_CASE(
    "the bar is of the radius, the depth or the camera's angle where these are monotonic, else of "
    "frames") {
  record::Trajectory run = synthetic::dome(5, 2);
  const ProgressAxis radius = summarise_run(run).progress();
  CHECK(radius.name == "*R*_{a}");
  CHECK(radius.first == Approx(126));
  CHECK(radius.last == Approx(94.5));
  CHECK(radius.positions[2] == Approx((126 - run.frames[2].boundary_radius_mm) / (126 - 94.5)));
  for (int k = 0; k < 5; ++k) {
    run.frames.edit()[std::size_t(k)].depth_mm = k * k;
    run.frames.edit()[std::size_t(k)].boundary_radius_mm = 94.5;
  }
  const ProgressAxis depth = summarise_run(run).progress();
  CHECK(depth.name == "*δ*");
  CHECK(depth.positions[2] == Approx(0.25));
  run.frames.edit()[4].depth_mm = 1;  // released again
  const ProgressAxis frames = summarise_run(run).progress();
  CHECK(frames.name.empty());
  CHECK(frames.positions[2] == Approx(0.5));
  // around a state alone it is the camera's angle
  RunSummary once_around = summarise_run(run);
  once_around.turn_deg = 288;
  const ProgressAxis angle = once_around.progress();
  CHECK((angle.name == "angle" && angle.first == 0 && angle.last == 288 && angle.unit == "°"));
  CHECK(angle.positions[2] == Approx(0.5));
}

TEST_CASE("a pushed shell is seen over its first state, with the push in the picture's plane") {
  record::Trajectory run = synthetic::dome(3, 2);
  for (record::Frame& frame : run.frames.edit()) frame.actuation = 1;
  MovieStyle style = titled(640, 480);
  style.turn_deg = 30;
  const auto drawing = Stage(run, style).drawing(run.frames[2]);
  REQUIRE(drawing.ghosts.size() == 1);
  CHECK(drawing.ghosts[0].nodes == run.frames[0].nodes);
  // seen from above, the ghost does not cover the colours of parts that moved down
  CHECK(drawing.ghosts[0].behind_mm >= summarise_run(run).largest_move_mm);
  CHECK(Stage(run, style).drawing(run.frames[0]).ghosts.empty());
  // named where no event is
  CHECK(test::has(texts_of(Stage(run, style), run, 1), "grey: first state"));
  run.frames.edit()[1].depth_mm = 1;
  CHECK(test::has(texts_of(Stage(run, style), run, 1), "grey: unloaded"));
  style.look.ghost = false;
  CHECK_FALSE(test::has(texts_of(Stage(run, style), run, 1), "grey: unloaded"));

  run.layout.loaded_joints = {{0, Eigen::Vector3d(-1, -1, -1).normalized()}};
  style.view = preset::View::push;
  for (const double azimuth : {30.0, 200.0, -90.0}) {
    style.azimuth_deg = azimuth;
    const Camera camera = Stage(run, style).camera(2);
    CHECK(std::abs(camera_axes(camera).forward.dot(Eigen::Vector3d(1, 1, 0))) < 1e-9);
    CHECK(std::abs(camera.azimuth_deg - azimuth) <= 90);
  }
}

TEST_CASE("what touches has a mark, and words next to the bar and as the event") {
  record::Trajectory run = synthetic::dome(4, 2);
  run.layout.joint_diameter_mm = 3;
  for (int k : {2, 3}) {
    // a joint that lies on another
    record::Frame& frame = run.frames.edit()[std::size_t(k)];
    frame.nodes.col(run.layout.joints[0].node) = frame.nodes.col(run.layout.joints[1].node);
    frame.contacts = 1;
    frame.event.clear();
  }
  const Stage stage(run, titled(1280, 720));
  for (int k = 0; k < 4; ++k) {
    INFO("frame " << k);
    const Drawing drawing = stage.drawing(run.frames[std::size_t(k)]);
    const auto texts = texts_of(stage, run, k);
    CHECK(std::ranges::count(texts, "interpenetration") == (k >= 2));
    CHECK(std::ranges::count(texts, "1 interpenetration (contact not modelled)") == (k >= 2));
    // without the marks of supports
    REQUIRE(std::ranges::none_of(drawing.marks, &PointMark::over) == (k < 2));
    if (k < 2) continue;
    const Eigen::Vector3d at = run.frames[std::size_t(k)].nodes.col(run.layout.joints[1].node);
    CHECK(std::ranges::any_of(drawing.marks, [&](const PointMark& mark) {
      return (mark.at - at).norm() < 3 && mark.colour.r == contact_ink.r;
    }));
  }
}

TEST_CASE("loads are arrows as long as they are large, braces are bars, and a key says how large") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.layout.supports = {run.layout.joints[0].node, run.layout.joints[3].node};
  record::Frame& frame = run.frames.edit()[2];
  frame.loads_N = Eigen::Matrix3Xd::Zero(3, 2);
  frame.loads_N.row(2) << -1.5, -0.5;
  frame.brace_force_N =
      Eigen::VectorXd::Constant(2 * Eigen::Index(run.layout.cells.size()), record::unknown);
  frame.brace_force_N[2] = 0;  // slack
  MovieStyle style;
  const Stage stage(run, style);
  const Drawing drawing = stage.drawing(run.frames[2]);
  REQUIRE(drawing.arrows.size() == 2);
  const auto length = [](const Arrow& arrow) { return (arrow.to - arrow.from).norm(); };
  CHECK(length(drawing.arrows[0]) == Approx(longest_force(run.layout)));
  CHECK(length(drawing.arrows[0]) == Approx(3 * length(drawing.arrows[1])));
  REQUIRE(drawing.ghosts.size() == 1);
  const auto& joints = run.layout.cells[1].joints;
  CHECK(drawing.ghosts[0].rods ==
        std::vector<std::vector<int>>{{run.layout.joints[std::size_t(joints[0])].node,
                                       run.layout.joints[std::size_t(joints[2])].node}});
  REQUIRE(stage.arrow_key());
  CHECK(stage.arrow_key()->name == "1 N");
  CHECK(stage.arrow_key()->length_mm == Approx(longest_force(run.layout) / 1.5));
  CHECK(load_caption(run.frames[2]) == "loads 2 N");
  CHECK_FALSE(stage.layout().arrow_key.empty());
  style.look.loads = style.look.braces = false;
  const Stage bare(run, style);
  CHECK(bare.drawing(run.frames[2]).arrows.empty());
  CHECK(bare.drawing(run.frames[2]).ghosts.empty());
  CHECK_FALSE(bare.arrow_key());
}

TEST_CASE("a line goes through the supports of a network that move, and through no others") {
  const auto ringed = [](const std::string& name, auto change) {
    preset::Preset p = shipped(name);
    change(p);
    return movie_style(p).look.rings;
  };
  const auto as_is = [](preset::Preset&) {};
  CHECK(ringed("network_space", as_is));     // scaled
  CHECK(ringed("network_triaxial", as_is));  // each to its position
  CHECK(ringed("fig1_actuation", as_is));
  CHECK_FALSE(ringed("lit_xshell_lens", as_is));
  CHECK(ringed("lit_xshell_lens",
               [](preset::Preset& p) { p.step.front().kind = preset::StepKind::move; }));
  CHECK(
      ringed("lit_xshell_lens", [](preset::Preset& p) { p.style.rings = preset::Visibility::on; }));
}

TEST_CASE("a push of a step has its arrow only in the frames in which it acts") {
  record::Trajectory run = synthetic::dome(3, 2);
  const int node = run.layout.joints[3].node;
  run.layout.loaded_joints = {{3, -Eigen::Vector3d::UnitZ(), true}};
  run.layout.supports = {run.layout.joints[0].node, node};
  record::Frame frame = run.frames[2];
  const Stage stage(run, MovieStyle{});
  frame.reactions_N = Eigen::Matrix3Xd::Zero(3, 2);
  CHECK(stage.drawing(frame).arrows.empty());
  CHECK(std::ranges::none_of(stage.drawing(frame).marks, &PointMark::over));
  frame.reactions_N.col(0).setOnes();
  CHECK(stage.drawing(frame).arrows.empty());
  frame.reactions_N(2, 1) = -1e-12;
  CHECK(stage.drawing(frame).arrows.size() == 1);
  // without reactions in the frame no arrow is hidden
  frame.reactions_N.resize(3, 0);
  CHECK(stage.drawing(frame).arrows.size() == 1);
}

TEST_CASE("zoom is about the shell's own panel, and nothing of the shell leaves it") {
  const record::Trajectory run = synthetic::dome(3, 2);
  for (const double zoom : {1.0, 2.5}) {
    MovieStyle style = titled(640, 360);
    style.zoom = zoom;
    style.target_mm = {10, 20, 30};
    const Stage stage(run, style);
    const Box& view = stage.layout().view;
    const Eigen::Vector2d at = to_pixel(stage.camera(1), 640, 360, Eigen::Vector3d(10, 20, 30));
    CHECK(at.x() == Approx(view.middle().x).margin(0.01));
    CHECK(at.y() == Approx(view.middle().y).margin(0.01));
    test::FakeRenderer renderer;
    const auto picture = value_of(stage.draw_views(renderer, {run.frames[2], 2}));
    for (int y = 0; y < 360; ++y)
      for (int x = 0; x < 640; ++x)
        if (!view.inset(-1).contains({double(x), double(y), 1, 1}))
          REQUIRE(picture.pixel(x, y)[0] != 40);
  }
}

TEST_CASE("several views are next to one another") {
  const record::Trajectory run = synthetic::dome(3, 2);
  MovieStyle style = titled(900, 400);
  style.views = {{-90, 0}, {-90, 90}};
  test::FakeRenderer renderer;
  const auto picture = value_of(Stage(run, style).draw(renderer, {run.frames[2], 2}));
  CHECK(renderer.drawn == 3);
  CHECK(renderer.outside == 0);
  CHECK(picture.width == 900);
}

TEST_CASE("the colour range is fixed over the movie and symmetric") {
  const record::Trajectory run = synthetic::dome(6, 2);
  const Stage stage(run, MovieStyle{});
  REQUIRE(stage.colour_bar());
  const ColourScale scale = stage.colour_bar()->scale;
  CHECK(scale.high == -scale.low);
  double largest = 0;
  for (const record::Frame& frame : run.frames)
    largest = std::max(largest, frame.cell_K.cwiseAbs().maxCoeff());
  CHECK(scale.high > 0.5 * largest);
  CHECK(scale.high < 2 * largest);
  CHECK(stage.colour_bar()->above_scale == (largest > scale.high));
  // however many frames sample the path
  const record::Trajectory fine = synthetic::dome(31, 2);
  CHECK(Stage(fine, MovieStyle{}).colour_bar()->scale.high == scale.high);
  // the same K has the same colour in any frame
  const Drawing last = stage.drawing(run.frames[5]);
  REQUIRE(last.cell_colours.size() == run.layout.cells.size());
  CHECK(last.cell_colours[7].r == scale(run.frames[5].cell_K[7]).r);

  const Stage uncoloured(run, coloured(ColourBy::none));
  CHECK_FALSE(uncoloured.colour_bar());
  CHECK(uncoloured.drawing(run.frames[5]).cell_colours.empty());
}

TEST_CASE("the drawing shows both boundaries, thick enough rods and a ground below them") {
  const record::Trajectory run = synthetic::dome(6, 2);
  for (const auto& [width, height] : {std::pair{1280, 720}, {320, 240}, {3840, 2160}}) {
    const Stage stage(run, titled(width, height));
    const Drawing drawing = stage.drawing(run.frames[3]);
    CHECK(drawing.rod_diameter_mm * stage.pixels_per_mm() > 1.09);
    CHECK(drawing.rod_diameter_mm >= run.layout.rod_diameter_mm);
    CHECK(drawing.joint_diameter_mm >= 3);
    REQUIRE(drawing.rings.size() == 2);
    CHECK(drawing.rings[0].points.col(0).norm() == Approx(126));
    CHECK(drawing.rings[1].points.col(0).norm() == Approx(run.frames[3].boundary_radius_mm));
    for (int k = 0; k < stage.frames(); ++k) {
      CHECK(stage.drawing(run.frames[std::size_t(k)]).ground_z_mm == drawing.ground_z_mm);
      CHECK(drawing.ground_z_mm < run.frames[std::size_t(k)].nodes.row(2).minCoeff());
    }
  }
  // the supports are on it where rods dip a little below them
  record::Trajectory dips = run;
  for (record::Frame& frame : dips.frames.edit()) frame.nodes.row(2).array() -= 10;
  CHECK(Stage(dips, MovieStyle{}).drawing(dips.frames[0]).ground_z_mm == Approx(-0.7));
  // a shell that hangs below its boundary keeps its ground below
  record::Trajectory hanging = run;
  for (record::Frame& frame : hanging.frames.edit()) frame.nodes.row(2) *= -1;
  CHECK(Stage(hanging, MovieStyle{}).drawing(hanging.frames[0]).ground_z_mm < -65);
}

TEST_CASE("the boundary moves evenly from the original to the actuated one") {
  const record::Layout layout = synthetic::dome(1, 1).layout;
  CHECK((boundary_at(layout, 0) - layout.original_boundary).norm() == 0);
  CHECK((boundary_at(layout, 1) - layout.actuated_boundary).norm() < 1e-9);
  CHECK(boundary_at(layout, 0.5).col(7).norm() == Approx((126 + 94.5) / 2));
}

TEST_CASE("a run that cannot be shown is refused with its reason") {
  const auto message = [](const record::Trajectory& run, const MovieStyle& style) {
    return refusal(check_showable(run, style));
  };
  record::Trajectory run = synthetic::dome(3, 2);
  CHECK(check_showable(run, {}));
  MovieStyle style;
  style.size[0] = 8;
  CHECK(message(run, style) == "size: got 8 x 720 pixels, expected 16 to 16384 for both");
  run.frames.edit()[1].nodes(2, 5) = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(run, {}).find("frame 1 of the run: got") == 0);
  run = synthetic::dome(3, 2);
  run.frames.edit()[2].cell_K.resize(5);
  CHECK(message(run, {}) == "frame 2 of the run: got K of 5 cells, expected 97");
  run.frames = {};
  CHECK(message(run, {}) == "the run has no frame to show");
}
