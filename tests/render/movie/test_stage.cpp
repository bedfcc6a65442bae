#include <algorithm>
#include <catch2/catch.hpp>
#include <limits>

#include "render/gl/renderer.h"
#include "render/movie/frame_overlay.h"
#include "render/movie/run_summary.h"
#include "render/movie/stage.h"
#include "tests/render/canvas/ink.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

MovieStyle titled(int width, int height) {
  MovieStyle style;
  style.width = width;
  style.height = height;
  style.scale_bar_mm = 20;
  style.title =
      "Actuation of a circular_gridshell with a title that is long enough to need cutting "
      "somewhere before its end in most of the sizes";
  return style;
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
    std::vector<Box> boxes;
    std::vector<std::string> texts;
    const Image image = draw_picture(width, height, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
      stage.draw_overlay(canvas, {run.frames[8], 8});
      boxes = canvas.text_boxes();
      texts = canvas.texts();
    });
    INFO(width << " x " << height);
    CHECK(test::rim_is_white(image));
    for (std::size_t a = 0; a < boxes.size(); ++a) {
      INFO(texts[a]);
      CHECK(Box{0, 0, double(width), double(height)}.contains(boxes[a]));
      CHECK_FALSE(boxes[a].overlaps(stage.layout().view));
      for (std::size_t b = a + 1; b < boxes.size(); ++b) {
        INFO(texts[b]);
        CHECK_FALSE(boxes[a].overlaps(boxes[b]));
      }
    }
  }
}

TEST_CASE("a frame says what it is") {
  const record::Trajectory run = synthetic::dome(12, 2);
  MovieStyle style = titled(1280, 720);
  style.title = "Movie_S1 *really*";
  const Stage stage(run, style);
  const auto texts_of = [&](int index) {
    std::vector<std::string> texts;
    draw_picture(1280, 720, 1, {}, [&](Canvas& canvas) {
      stage.draw_overlay(canvas, {run.frames[std::size_t(index)], index});
      texts = canvas.texts();
    });
    return texts;
  };
  const auto has = [](const std::vector<std::string>& texts, const std::string& text) {
    return std::find(texts.begin(), texts.end(), text) != texts.end();
  };
  const auto last = texts_of(11);
  for (const std::string text :
       {"Movie_S1 *really*", "Ra = 94.5 mm", "height 66.0 mm", "frame 12 / 12",
        "residual < 1 × 10−6 N, stable", "K□ (rad)", "20 mm"}) {
    INFO(text);
    CHECK(has(last, text));
  }
  // an event is told by its own frame alone; the timeline keeps that there was one
  for (int k : {7, 8, 9}) {
    CHECK(has(texts_of(k), "snap at a radius of 104.9 mm") == (k == 8));
    CHECK(has(texts_of(k), "snap") == (k >= 8));
  }
}

TEST_CASE("captions name only what is known") {
  record::Frame frame;
  frame.height_mm = 12.34;
  CHECK(state_captions(frame) == std::vector<std::string>{"height 12.3 mm"});
  frame.boundary_radius_mm = 115.9;
  frame.depth_mm = 7.5;
  frame.force_N = 0.2137;
  // of a pushed shell the depth says more than the boundary where it stands still
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
    std::vector<std::string> texts;
    draw_picture(1280, 720, 1, {}, [&](Canvas& canvas) {
      stage.draw_overlay(canvas, {run.frames[std::size_t(k)], k});
      texts = canvas.texts();
    });
    int unstable = 0, stable = 0, sign = 0;
    for (const std::string& text : texts) {
      unstable += text.starts_with("unstable: ");
      stable += text.ends_with(", stable");
      sign += text == "unstable";
    }
    INFO("frame " << k);
    CHECK(unstable == (k == 4 || k == 5));
    CHECK(stable == !(k == 4 || k == 5));
    CHECK(sign == (k >= 4));  // of the timeline
  }
  record::Frame silent;
  silent.negative_pivots = 1;
  CHECK(event_caption(silent) == "unstable: 1 negative pivot");
  silent.residual_N = 1.5e-5;
  CHECK(equilibrium_caption(silent) == "residual < 1 × 10^{−4} N");
  silent.residual_N = 1.5e-8;
  CHECK(equilibrium_caption(silent) == "residual < 1 × 10^{−6} N");
}

TEST_CASE("a pushed joint wears a mark and an arrow that points at it, a pulled one away") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.layout.loaded_joints = {{3, -Eigen::Vector3d::UnitZ()}};
  const Eigen::Vector3d at = run.frames[2].nodes.col(run.layout.joints[3].node);
  const Drawing push = Stage(run, MovieStyle{}).drawing(run.frames[2]);
  REQUIRE(push.arrows.size() == 1);
  REQUIRE(push.marks.size() == 1);
  CHECK((push.marks[0].at - at).norm() < 1e-9);
  CHECK((push.arrows[0].to - at).norm() < 4);
  CHECK(push.arrows[0].from.z() > at.z() + 20);
  run.layout.loaded_joints[0].direction *= -1;
  const Drawing pull = Stage(run, MovieStyle{}).drawing(run.frames[2]);
  CHECK((pull.arrows[0].from - at).norm() < 4);
  CHECK(pull.arrows[0].to.z() > at.z() + 20);
}

TEST_CASE("a push of a step wears its arrow in the frames that it holds alone") {
  record::Trajectory run = synthetic::dome(3, 2);
  const int node = run.layout.joints[3].node;
  run.layout.loaded_joints = {{3, -Eigen::Vector3d::UnitZ(), true}};
  run.layout.supports = {run.layout.joints[0].node, node};
  record::Frame frame = run.frames[2];
  const Stage stage(run, MovieStyle{});
  frame.reactions_N = Eigen::Matrix3Xd::Zero(3, 2);
  CHECK(stage.drawing(frame).arrows.empty());
  CHECK(stage.drawing(frame).marks.empty());
  frame.reactions_N.col(0).setOnes();
  CHECK(stage.drawing(frame).arrows.empty());
  frame.reactions_N(2, 1) = -1e-12;
  CHECK(stage.drawing(frame).arrows.size() == 1);
  // what the frame does not know it does not hide
  frame.reactions_N.resize(3, 0);
  CHECK(stage.drawing(frame).arrows.size() == 1);
}

TEST_CASE("zoom is about the shell's own panel, and nothing of the shell leaves it") {
  const record::Trajectory run = synthetic::dome(3, 2);
  for (const double zoom : {1.0, 2.5}) {
    MovieStyle style = titled(640, 360);
    style.zoom = zoom;
    style.target_mm = Eigen::Vector3d(10, 20, 30);
    const Stage stage(run, style);
    const Box& view = stage.layout().view;
    const Eigen::Vector2d at = to_pixel(stage.camera(1), 640, 360, *style.target_mm);
    CHECK(at.x() == Approx(view.middle().x).margin(0.01));
    CHECK(at.y() == Approx(view.middle().y).margin(0.01));
    test::FakeRenderer renderer;
    const auto picture = stage.draw_views(renderer, {run.frames[2], 2});
    REQUIRE(picture);
    for (int y = 0; y < 360; ++y)
      for (int x = 0; x < 640; ++x)
        if (!view.inset(-1).contains({double(x), double(y), 1, 1}))
          REQUIRE(picture->pixel(x, y)[0] != 40);
  }
}

TEST_CASE("several views stand beside one another") {
  const record::Trajectory run = synthetic::dome(3, 2);
  MovieStyle style = titled(900, 400);
  style.views = {{-90, 0}, {-90, 90}};
  test::FakeRenderer renderer;
  const auto picture = Stage(run, style).draw(renderer, {run.frames[2], 2});
  REQUIRE(picture);
  CHECK(renderer.drawn == 3);
  CHECK(renderer.outside == 0);
  CHECK(picture->width == 900);
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
  CHECK(stage.colour_bar()->beyond_high == (largest > scale.high));
  // however many frames sample the path
  const record::Trajectory fine = synthetic::dome(31, 2);
  CHECK(Stage(fine, MovieStyle{}).colour_bar()->scale.high == scale.high);
  // the same K has the same colour in any frame
  const Drawing last = stage.drawing(run.frames[5]);
  REQUIRE(last.cell_colours.size() == run.layout.cells.size());
  CHECK(last.cell_colours[7].r == scale(run.frames[5].cell_K[7]).r);

  MovieStyle bare;
  bare.colour_by = ColourBy::none;
  const Stage uncoloured(run, bare);
  CHECK_FALSE(uncoloured.colour_bar());
  CHECK(uncoloured.drawing(run.frames[5]).cell_colours.empty());
}

TEST_CASE("the drawing shows both boundaries, thick enough rods and a ground below everything") {
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
  // a shell that hangs below its boundary keeps its ground below
  record::Trajectory hanging = run;
  for (record::Frame& frame : hanging.frames.edit()) frame.nodes.row(2) *= -1;
  CHECK(Stage(hanging, MovieStyle{}).drawing(hanging.frames[0]).ground_z_mm < -65);
}

TEST_CASE("the top view shows cells, rods and joints where they are") {
  const record::Trajectory run = synthetic::dome(3, 4);
  const Image image = draw_picture(300, 300, 1, {1, 1, 1, 1}, [&](Canvas& canvas) {
    draw_top_view(canvas, {0, 0, 300, 300}, run.layout, run.frames[2], {0, 0, 126}, {});
  });
  const auto redness = [&](double x_mm, double y_mm) {
    const double scale = 300.0 / 2 / 131;  // the box less the joints' radius, about
    const std::uint8_t* p = image.pixel(int(150 + scale * x_mm), int(150 - scale * y_mm));
    return int(p[0]) - int(p[1]);
  };
  const double s = 0.75 * 10;  // joints at 10, 30, 50 mm drawn in to three quarters
  CHECK(redness(s, s) > 60);
  CHECK(redness(5 * s, s) > 60);
  CHECK(redness(2 * s, 2 * s) < 10);
}

TEST_CASE("the boundary moves evenly from the original to the actuated one") {
  const record::Layout layout = synthetic::dome(1, 1).layout;
  CHECK((boundary_at(layout, 0) - layout.original_boundary).norm() == 0);
  CHECK((boundary_at(layout, 1) - layout.actuated_boundary).norm() < 1e-9);
  CHECK(boundary_at(layout, 0.5).col(7).norm() == Approx((126 + 94.5) / 2));
}

TEST_CASE("a run that cannot be shown is refused with its reason") {
  const auto message = [](const record::Trajectory& run, const MovieStyle& style) {
    const auto checked = check_showable(run, style);
    REQUIRE_FALSE(checked);
    CHECK(checked.error().fault == Fault::bad_input);
    return checked.error().message;
  };
  record::Trajectory run = synthetic::dome(3, 2);
  CHECK(check_showable(run, {}));
  MovieStyle style;
  style.width = 8;
  CHECK(message(run, style) ==
        "a picture of 8 x 720 pixels cannot be made: both sides must be 16 to 16384");
  run.frames[1].nodes(2, 5) = std::numeric_limits<double>::quiet_NaN();
  CHECK(message(run, {}).find("frame 1 of the run has") == 0);
  run = synthetic::dome(3, 2);
  run.frames[2].cell_K.resize(5);
  CHECK(message(run, {}) == "frame 2 of the run has K of 5 cells instead of 97");
  run.frames = {};
  CHECK(message(run, {}) == "the run has no frame to show");
}

TEST_CASE("what no frame knows cannot be what is coloured") {
  record::Trajectory run = synthetic::dome(3, 2);
  const auto lacks = [&](ColourBy by) {
    MovieStyle style;
    style.colour_by = by;
    const auto checked = check_showable(run, style);
    CHECK(bool(check_coloured(summarise_run(run), style)) == bool(checked));
    return checked ? "" : checked.error().message;
  };
  CHECK(lacks(ColourBy::axial_force).find("[movie] colour_by = \"axial_force\": no frame") == 0);
  CHECK(lacks(ColourBy::energy).find("bending energy") != std::string::npos);
  CHECK(lacks(ColourBy::deviation).find("no net") != std::string::npos);
  run.layout.net_nodes = run.frames[0].nodes;
  CHECK(lacks(ColourBy::deviation).empty());
  run.frames[2].axial_force_N.setConstant(record::edges_of_rods(run.layout), -0.1);
  CHECK(lacks(ColourBy::axial_force).empty());
}

TEST_CASE("rods are coloured by their forces, grey where a frame does not know them") {
  record::Trajectory run = synthetic::dome(3, 2);
  record::Frame& last = run.frames.edit()[2];
  last.axial_force_N.setConstant(record::edges_of_rods(run.layout), -0.1);
  last.axial_force_N.head(4).setConstant(0.1);
  MovieStyle style;
  style.colour_by = ColourBy::axial_force;
  const Stage stage(run, style);
  const Drawing known = stage.drawing(run.frames[2]), unknown = stage.drawing(run.frames[1]);
  REQUIRE(long(known.node_colours.size()) == last.nodes.cols());
  CHECK(known.cell_colours.empty());
  const Colour pulled = known.node_colours[std::size_t(run.layout.rods[0][0])],
               pressed = known.node_colours[std::size_t(run.layout.rods[5][0])];
  CHECK(pulled.r > pulled.b);
  CHECK(pressed.b > pressed.r);
  for (const Colour& grey : unknown.node_colours) CHECK(grey == stage.colour_bar()->scale(NAN));
  CHECK(unknown.rod_diameter_mm == known.rod_diameter_mm);
  // joints are not as red as tension, unless they are wished so
  CHECK(known.joint_colour == style.look.rod);
}

TEST_CASE("cells are coloured by how far they lie off the net") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.layout.net_nodes = run.frames[2].nodes;
  run.layout.net_nodes.leftCols(60).row(2).array() += 2;
  MovieStyle style;
  style.colour_by = ColourBy::deviation;
  const Stage stage(run, style);
  const Drawing drawing = stage.drawing(run.frames[2]);
  REQUIRE(drawing.cell_colours.size() == run.layout.cells.size());
  CHECK(drawing.node_colours.empty());
  CHECK(drawing.cell_colours.front().r < drawing.cell_colours.back().r);
}
