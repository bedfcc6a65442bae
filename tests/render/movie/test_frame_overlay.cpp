#include "render/movie/frame_overlay.h"

#include <vector>

#include "render/gl/scene.h"
#include "render/movie/stage.h"
#include "tests/presets.h"
#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("parts of a frame lie inside it and never overlap, at any size and aspect") {
  const ColourBar bar{"*K*_{□} (rad)", {diverging, -0.08, 0.08}, true, true};
  const std::vector<std::pair<int, int>> sizes = {
      {320, 240},  {640, 360}, {640, 480}, {1280, 720},  {1920, 1080}, {3840, 2160},
      {720, 1280}, {500, 500}, {800, 700}, {3840, 240},  {320, 2160},  {1000, 100},
      {100, 1000}, {64, 48},   {16, 16},   {1150, 1000}, {1149, 1000}};
  for (const auto& [width, height] : sizes)
    for (int options = 0; options < 32; ++options) {
      MovieStyle style;
      style.size = {width, height};
      style.captions = options & 1;
      style.inset = options & 2;
      style.scale_bar_mm = options & 4 ? 20 : 0;
      const FrameLayout layout =
          lay_out_frame(style, options & 8 ? &bar : nullptr,
                        {(options & 16) != 0, (options & 16) != 0, (options & 16) != 0});
      INFO(width << " x " << height << " options " << options);
      const std::vector<Box> parts = layout.parts();
      for (std::size_t a = 0; a < parts.size(); ++a) {
        if (parts[a].empty()) continue;
        CHECK(Box{0, 0, double(width), double(height)}.contains(parts[a]));
        for (std::size_t b = a + 1; b < parts.size(); ++b) CHECK_FALSE(parts[a].overlaps(parts[b]));
      }
      // nearly half of the picture is for the shell
      if (width >= 320 && height >= 240)
        CHECK(layout.view.width * layout.view.height > 0.48 * width * height);
      else
        CHECK_FALSE(layout.view.empty());
    }
}

TEST_CASE("at the usual sizes nothing is left out, and text grows with the picture") {
  const ColourBar bar{"*K*_{□} (rad)", {diverging, -0.08, 0.08}};
  double before = 0;
  for (const auto& [width, height] :
       {std::pair{320, 240}, {640, 480}, {1280, 720}, {1920, 1080}, {3840, 2160}}) {
    MovieStyle style;
    style.size = {width, height};
    style.scale_bar_mm = 20;
    const FrameLayout layout = lay_out_frame(style, &bar);
    INFO(width << " x " << height);
    for (const Box& part : {layout.title, layout.state, layout.event, layout.timeline,
                            layout.colour_bar, layout.inset, layout.scale_bar, layout.view})
      CHECK_FALSE(part.empty());
    CHECK(layout.plot.empty());  // not requested
    CHECK(layout.font_size > before);
    before = layout.font_size;
  }
}

TEST_CASE("what is switched off takes no room") {
  MovieStyle style;
  style.captions = style.inset = false;
  const FrameLayout layout = lay_out_frame(style, nullptr);
  CHECK(layout.view.width > 0.95 * 1280);
  CHECK(layout.view.height > 0.9 * 720);
}

TEST_CASE("a flat grid has a ball at every support of the run, and none at a free end") {
  record::Trajectory run = synthetic::dome(3, 2);
  run.layout.supports = run.layout.edge_points;
  const auto count = Eigen::Index(run.layout.supports.size());
  auto& frames = run.frames.edit();
  for (record::Frame& frame : frames) frame.reactions_N = Eigen::Matrix3Xd::Zero(3, count);
  frames[0].reactions_N(0, 4) = 1e-17;  // round-off
  frames[2].reactions_N.rightCols(count - 1).setOnes();
  const Stage stage(run, MovieStyle{});
  for (const auto& frame : run.frames) CHECK(long(stage.drawing(frame).marks.size()) == count - 1);
}

TEST_CASE("a joint that is fixed has a ball, one that is pushed has none") {
  record::Trajectory run = synthetic::dome(3, 2);
  const record::Joint &fixed = run.layout.joints[0], &pushed = run.layout.joints[1];
  run.layout.supports = {fixed.node, pushed.node};
  run.layout.loaded_joints = {{1}};
  for (record::Frame& frame : run.frames.edit()) frame.reactions_N = Eigen::Matrix3Xd::Ones(3, 2);
  const record::Frame& frame = run.frames[1];
  std::set<int> supported{fixed.node, pushed.node};
  Drawing drawing;
  drawing.joint_diameter_mm = 3;
  put_supports(run.layout, frame, supported, Appearance{}, drawing);
  REQUIRE(drawing.marks.size() == 1);
  CHECK(drawing.marks[0].at == frame.nodes.col(fixed.node));
}

TEST_CASE("a support on a spring is where its spring pulls from, with the spring up to the rod") {
  record::Trajectory run = synthetic::dome(2, 2);
  const int node = run.layout.edge_points[2];
  run.layout.supports = {node};
  run.layout.sprung = {node};
  run.layout.spring_N_per_mm = Eigen::Vector3d(0.005, 0.01, 0);
  for (record::Frame& frame : run.frames.edit()) frame.reactions_N = Eigen::Vector3d(0.5, -0.2, 0);
  const Drawing drawing = Stage(run, MovieStyle{}).drawing(run.frames[1]);
  const Eigen::Vector3d rod = run.frames[1].nodes.col(node),
                        support = rod + Eigen::Vector3d(100, -20, 0);
  REQUIRE(drawing.marks.size() == 1);
  CHECK((drawing.marks[0].at - support).norm() < 1e-9);
  REQUIRE(drawing.ghosts.size() == 1);
  const auto& spring = drawing.ghosts[0].nodes;
  CHECK((spring.leftCols(1) - rod).norm() < 1e-9);
  CHECK((spring.rightCols(1) - support).norm() < 1e-9);
  CHECK(spring.cols() > 6);
  // in the unloaded grid the spring has no length
  record::Frame flat = run.frames[0];
  flat.reactions_N.setZero();
  const Drawing unloaded = Stage(run, MovieStyle{}).drawing(flat);
  CHECK(drawing_error(unloaded).empty());
  REQUIRE(unloaded.marks.size() == 1);
  CHECK((unloaded.marks[0].at - flat.nodes.col(node)).norm() == 0);
  // one that is stiff, and so short, is longer than its ball
  run.layout.spring_N_per_mm *= 100;
  const Drawing stiff = Stage(run, MovieStyle{}).drawing(run.frames[1]);
  CHECK((stiff.ghosts[0].nodes.rightCols(1) - rod).norm() ==
        Approx(3 * stiff.marks[0].diameter_mm));
  CHECK((stiff.marks[0].at - stiff.ghosts[0].nodes.rightCols(1)).norm() < 1e-9);
  // the direction of one without force would be that of round-off
  for (record::Frame& frame : run.frames.edit()) frame.reactions_N.setZero();
  const Drawing idle = Stage(run, MovieStyle{}).drawing(run.frames[1]);
  CHECK(idle.ghosts.empty());
  CHECK(idle.marks[0].at == rod);
}

TEST_CASE("the caption of loads names what is distributed") {
  record::Frame weighed;
  weighed.loads_N = Eigen::Vector3d(0, 0, -1).replicate(1, 30);
  CHECK(load_caption(weighed) == "loads 30 N, distributed (arrows not to scale)");
  weighed.loads_N(2, 0) = -29;
  CHECK(load_caption(weighed) == "loads 58 N (50 % distributed)");
  // a couple has no resultant
  weighed.loads_N.setZero();
  weighed.loads_N.col(0) = Eigen::Vector3d(3, 0, 0);
  weighed.loads_N.col(1) = Eigen::Vector3d(-3, 0, 0);
  CHECK(load_caption(weighed).starts_with("loads with a resultant of 0 N"));
}
