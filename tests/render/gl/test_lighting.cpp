#include "render/gl/lighting.h"

#include <catch2/catch.hpp>

using namespace gridshell::render;

namespace {

/// Mean irradiance on a surface of unit normal n.
double light_on(const std::vector<Lighting>& passes, const Eigen::Vector3d& n) {
  double sum = 0;
  for (const Lighting& l : passes)
    sum += l.key * std::max(0.0, n.dot(l.direction)) + l.sky * 0.5 * (1 + n.z()) +
           l.bounce * 0.5 * (1 - n.z());
  return sum / double(passes.size());
}

}  // namespace

TEST_CASE("level ground in the open receives 1", "[lighting]") {
  for (int passes : {1, 2, 7, 64})
    CHECK(light_on(lighting_passes({}, passes), Eigen::Vector3d::UnitZ()) ==
          Approx(1).epsilon(1e-12));
}

TEST_CASE("many passes tend to the light of a single one", "[lighting]") {
  const auto one = lighting_passes({}, 1), many = lighting_passes({}, 512);
  for (const Eigen::Vector3d& n :
       {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0), Eigen::Vector3d(0.6, 0, 0.8),
        Eigen::Vector3d(0, -0.8, 0.6), Eigen::Vector3d(0, 0, -1)})
    CHECK(light_on(many, n) == Approx(light_on(one, n)).margin(0.04));
  for (const Lighting& l : many) {
    CHECK(l.direction.norm() == Approx(1));
    CHECK(l.direction.z() > 0);
    CHECK(l.pixel_shift.cwiseAbs().maxCoeff() <= 0.5);
  }
}

TEST_CASE("the light turns with the camera", "[lighting]") {
  Camera camera;
  camera.azimuth_deg = 0;
  const auto a = lighting_passes(camera, 1)[0].direction;
  camera.azimuth_deg = 90;
  const auto b = lighting_passes(camera, 1)[0].direction;
  CHECK(b.isApprox(Eigen::Vector3d(-a.y(), a.x(), a.z()), 1e-12));
}
