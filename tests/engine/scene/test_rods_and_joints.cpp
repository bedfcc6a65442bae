// Sizes of a scene's joints, which follow its rods.
#include "tests/engine/simulate/run.h"

using namespace gridshell;

TEST_CASE("a rod with a diameter of its own is hollow by the wall of all, or refused") {
  preset::Preset p = circle(6, 60, 50);
  p.rod.diameter_mm = 2, p.rod.wall_mm = 0.5;
  p.rod_table = {{0, 1, 1.1}};
  CHECK(scene_of(p).has_value());
  p.rod_table = {{0, 1, 1}};
  const auto scene = scene_of(p);
  REQUIRE_FALSE(scene);
  CHECK_THAT(scene.error().message,
             Catch::Contains("wall_mm") && Catch::Contains("u-rod 1 of 1 mm diameter"));
}

TEST_CASE("joints without a size of their own are the paper's, or as large as their rods need") {
  preset::Preset p = circle(6, 60, 50);
  const auto size = [&] {
    const Scene scene = value_of(scene_of(p));
    return std::pair(scene.joint_diameter_mm, scene.joint_height_mm);
  };
  CHECK(size() == std::pair(3.0, 5.0));
  p.rod.diameter_mm = 3;
  CHECK(size() == std::pair(4.5, 5.0));
  p.rod.diameter_mm = 10;
  CHECK(size() == std::pair(15.0, 15.0));
  p.joints.height_mm = 0;
  CHECK(size() == std::pair(15.0, 0.0));
  p.joints.height_mm.reset();
  // joints of laths follow the smaller side of the section
  p.rod.width_mm = 8, p.rod.thickness_mm = 4, p.rod.shear_GPa = 30;
  CHECK(size() == std::pair(6.0, 6.0));
}
