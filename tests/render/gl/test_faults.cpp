// The metric on real pictures: it must report everything that a person would call broken, and no
// differences that another machine makes to a good picture.
#include <algorithm>
#include <functional>
#include <map>
#include <random>

#include "render/gl/image.h"
#include "render/gl/renderer.h"
#include "render/movie/stage.h"
#include "tests/render/gl/picture.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

/// What a picture is made of, to be spoiled before it is drawn.
struct Subject {
  record::Trajectory run = synthetic::dome(9, 4);
  MovieStyle style;
  std::function<void(Drawing&, Camera&)> spoil = [](Drawing&, Camera&) {};
  int at = 7;

  Subject() {
    // on the near side
    const auto& joints = run.layout.joints;
    const auto pushed = std::find_if(joints.begin(), joints.end(), [](const record::Joint& joint) {
      return joint.i == 2 && joint.j == 1;
    });
    run.layout.loaded_joints = {{int(pushed - joints.begin()), -Eigen::Vector3d::UnitZ()}};
    run.frames.edit()[3].negative_pivots = 1;
    style.size = {480, 270};
    style.title = "Dome";
    style.scale_bar_mm = 20;
  }
};

class Easel {
 public:
  Easel() : studio_(value_of(test::studio())) {}
  Image operator()(const Subject& subject) {
    const Stage stage(subject.run, subject.style);
    const record::Frame& frame = subject.run.frames[std::size_t(subject.at)];
    Drawing drawing = stage.drawing(frame);
    Camera camera = stage.camera(subject.at);
    subject.spoil(drawing, camera);
    auto picture = value_of(studio_.renderer->draw(drawing, camera, draw_quality(subject.style),
                                                   subject.style.width(), subject.style.height()));
    stage.finish(picture, {frame, subject.at});
    return picture;
  }

 private:
  test::Studio studio_;
};

using Change = std::function<void(Subject&)>;
Change drawing(std::function<void(Drawing&)> change) {
  return [change](Subject& s) { s.spoil = [change](Drawing& d, Camera&) { change(d); }; };
}
Change camera(std::function<void(Camera&)> change) {
  return [change](Subject& s) { s.spoil = [change](Drawing&, Camera& c) { change(c); }; };
}

const std::map<std::string, Change>& errors() {
  static const std::map<std::string, Change> all{
      {"a lost rod", [](Subject& s) { s.run.layout.rods.erase(s.run.layout.rods.begin() + 5); }},
      {"a lost cell", drawing([](Drawing& d) { d.cell_colours[40].a = 0; })},
      {"a wrong cell colour", drawing([](Drawing& d) {
         d.cell_colours[40] = {0.2f, 0.7f, 0.3f, 0.93f};
       })},
      {"a wrong rod colour", drawing([](Drawing& d) {
         d.rod_colour = {0.1f, 0.1f, 0.6f, 1};
       })},
      {"a wrong joint colour", drawing([](Drawing& d) {
         d.joint_colour = {0.75f, 0.4f, 0.1f, 1};
       })},
      {"no ring", drawing([](Drawing& d) { d.rings.pop_back(); })},
      {"no original boundary", drawing([](Drawing& d) { d.rings.erase(d.rings.begin()); })},
      {"no shadow", [](Subject& s) { s.style.look.shadow = false; }},
      {"no floor", drawing([](Drawing& d) { d.ground = false; })},
      {"half a pixel to the right", camera([](Camera& c) {
         c.target += c.half_extent_mm / 270 * Eigen::Vector3d(-0.64, 0.77, 0);
       })},
      {"half a pixel up", camera([](Camera& c) { c.target.z() -= c.half_extent_mm / 270; })},
      {"a wrong digit",
       [](Subject& s) {
         s.run.frames.edit()[7].boundary_radius_mm += 0.3;
         s.run.frames.edit()[7].height_mm += 0.5;
       }},
      {"a wrong letter", [](Subject& s) { s.style.title = "Dome."; }},
      {"no colour bar", [](Subject& s) { s.style.legends = false; }},
      {"another colour map", [](Subject& s) { s.style.look.map = grey; }},
      {"another colour range",
       [](Subject& s) {
         s.style.look.range = {-0.3, 0.3};
       }},
      {"no top view", [](Subject& s) { s.style.inset = false; }},
      {"no mark on the timeline", [](Subject& s) { s.run.frames.edit()[3].negative_pivots = 0; }},
      {"no scale bar", [](Subject& s) { s.style.scale_bar_mm = 0; }},
      {"no arrow", drawing([](Drawing& d) { d.arrows.clear(); })},
      {"no mark at the joint", drawing([](Drawing& d) { d.marks.clear(); })},
      {"thicker rods", drawing([](Drawing& d) { d.rod_diameter_mm *= 1.5; })},
      {"the frame before", [](Subject& s) { s.at = 6; }},
      {"the camera a degree off", camera([](Camera& c) { c.azimuth_deg += 1; })},
  };
  return all;
}

// round-off and other processors: numbers a little off
Change perturbed(double size_mm, int seed) {
  return [=](Subject& s) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::uniform_real_distribution<double> off(-size_mm, size_mm);
    for (record::Frame& frame : s.run.frames.edit())
      for (long k = 0; k < frame.nodes.size(); ++k) frame.nodes.data()[k] += off(random);
  };
}

}  // namespace

TEST_CASE("the metric catches every injected error", "[image][standard]") {
  Easel paint;
  const Image good = paint(Subject());
  CHECK(errors().size() >= 20);
  for (const auto& [name, change] : errors()) {
    Subject subject;
    change(subject);
    const auto worst = value_of(compare(good, paint(subject)));
    INFO(name << ": " << worst.difference);
    CHECK_FALSE(worst.same());
  }
}

TEST_CASE("the metric catches a single lost joint", "[image]") {
  Easel paint;
  Subject subject;
  const Image good = paint(subject);
  drawing([](Drawing& d) { d.joint_diameter_mm = 0; })(subject);
  const Image bare = paint(subject);
  // the picture with the joints, but for one
  const Stage stage(subject.run, subject.style);
  const int node = subject.run.layout.joints[70].node;
  const Eigen::Vector2d at =
      to_pixel(stage.camera(7), 480, 270, subject.run.frames[7].nodes.col(node));
  Image spoiled = good;
  for (int y = int(at.y()) - 5; y <= int(at.y()) + 5; ++y)
    std::copy_n(bare.pixel(int(at.x()) - 5, y), 4 * 11, spoiled.pixel(int(at.x()) - 5, y));
  const auto worst = value_of(compare(good, spoiled));
  CAPTURE(worst.difference);
  CHECK_FALSE(worst.same());
}

TEST_CASE("the metric passes every harmless variation", "[image][standard]") {
  Easel paint;
  const Image good = paint(Subject());
  int variations = 0, changed = 0;
  const auto check = [&](const Image& other) {
    const auto worst = value_of(compare(good, other));
    INFO("variation " << variations << ": " << worst.difference);
    CHECK(worst.same());
    ++variations;
    changed += good.rgba != other.rgba;
  };
  for (const double size : {1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 5e-3})
    for (int seed = 1; seed <= 2; ++seed) {
      Subject subject;
      perturbed(size, seed)(subject);
      check(paint(subject));
    }
  // a grey level more or less here and there, as other rounding gives
  for (int seed = 1; seed <= 6; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    Image noisy = good;
    for (std::size_t k = 0; k < noisy.rgba.size(); ++k)
      if (k % 4 != 3)
        noisy.rgba[k] = std::uint8_t(std::clamp(noisy.rgba[k] + int(random() % 3) - 1, 0, 255));
    check(noisy);
  }
  // the same things in another order
  Subject reversed;
  std::reverse(reversed.run.layout.rods.begin(), reversed.run.layout.rods.end());
  check(paint(reversed));
  check(paint(Subject()));
  CHECK(variations >= 20);
  CHECK(changed >= 10);
}
