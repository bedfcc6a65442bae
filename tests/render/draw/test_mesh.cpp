#include "render/draw/mesh.h"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <numbers>

using namespace gridshell::render;

namespace {

constexpr double pi = std::numbers::pi;

/// Signed volume: positive when all triangles turn outwards.
double volume(const Mesh& mesh) {
  double sum = 0;
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3) {
    const auto corner = [&](int c) -> Eigen::Vector3d {
      return mesh.vertices[mesh.indices[k + c]].position.cast<double>();
    };
    sum += corner(0).dot(corner(1).cross(corner(2))) / 6;
  }
  return sum;
}

/// Whether every edge is shared by exactly two triangles that run along it in opposite senses.
bool watertight(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (std::size_t k = 0; k < mesh.indices.size(); k += 3)
    for (int c = 0; c < 3; ++c) {
      const auto a = mesh.indices[k + c], b = mesh.indices[k + (c + 1) % 3];
      balance[std::minmax(a, b)] += a < b ? 1 : -1;
    }
  for (const auto& [edge, count] : balance)
    if (count != 0) return false;
  return true;
}

double polygon_area(int sides, double radius) {
  return 0.5 * sides * radius * radius * std::sin(2 * pi / sides);
}

}  // namespace

TEST_CASE("a straight tube holds its volume and closes", "[mesh]") {
  std::vector<Eigen::Vector3f> points;
  for (int k = 0; k <= 10; ++k) points.emplace_back(2 * k, 0, 0);
  const std::vector<Eigen::Vector4f> colours(points.size(), {1, 1, 1, 1});
  Mesh mesh;
  add_tube(mesh, {points, colours, 0.5f, 8, false});
  CHECK(watertight(mesh));
  const double area = polygon_area(8, 0.5);
  CHECK(volume(mesh) > 20 * area);                       // the tube alone
  CHECK(volume(mesh) < 20 * area + 4 * pi / 3 * 0.125);  // with a ball's worth of caps
}

TEST_CASE("a closed tube in space is a torus without seam or twist", "[mesh]") {
  std::vector<Eigen::Vector3f> points;
  const int n = 120;
  for (int k = 0; k < n; ++k) {
    const double a = 2 * pi * k / n;
    // not planar, so that the transported frame does not return by itself
    points.push_back(
        Eigen::Vector3d(50 * std::cos(a), 50 * std::sin(a), 8 * std::sin(3 * a)).cast<float>());
  }
  const std::vector<Eigen::Vector4f> colours(points.size(), {1, 1, 1, 1});
  Mesh mesh;
  add_tube(mesh, {points, colours, 1, 6, true});
  CHECK(watertight(mesh));
  double length = 0;
  for (int k = 0; k < n; ++k) length += (points[(k + 1) % n] - points[k]).norm();
  CHECK(volume(mesh) == Approx(length * polygon_area(6, 1)).epsilon(2e-3));
  // every side is about as long as the tube's edge: a seam's sides would cut across
  for (int k = 0; k < 6; ++k) {
    const auto& last = mesh.vertices[6 * (n - 1) + k].position;
    CHECK((mesh.vertices[k].position - last).norm() < 1.2 * length / n);
  }
}

TEST_CASE("normals are unit vectors at right angles to the rod", "[mesh]") {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {10, 0, 0}, {17, 7, 0}};
  const std::vector<Eigen::Vector4f> colours(3, {0.5f, 0.25f, 1, 1});
  Mesh mesh;
  add_tube(mesh, {points, colours, 1, 8, false});
  for (int k = 0; k < 8; ++k) {
    const auto& vertex = mesh.vertices[k];
    const Eigen::Vector3f normal(vertex.normal[0], vertex.normal[1], vertex.normal[2]);
    CHECK(normal.norm() / 32767 == Approx(1).margin(1e-4));
    CHECK(std::abs(normal.x()) / 32767 < 1e-4);
    CHECK(vertex.colour[1] == 16384);
  }
}

TEST_CASE("points that coincide or turn back give a finite tube", "[mesh]") {
  const std::vector<Eigen::Vector3f> points{{0, 0, 0}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const std::vector<Eigen::Vector4f> colours(4, {1, 1, 1, 1});
  Mesh mesh;
  add_tube(mesh, {points, colours, 1, 6, false});
  for (const Vertex& vertex : mesh.vertices) CHECK(vertex.position.allFinite());
}

TEST_CASE("a joint's button closes and turns outwards", "[mesh]") {
  Mesh mesh;
  add_button(mesh, {1, 2, 3}, Eigen::Vector3f(1, 2, 2) / 3, 1.5f, 0.9f, 24, {1, 0, 0, 1});
  CHECK(watertight(mesh));
  const double whole = polygon_area(24, 1.5) * 1.8;
  CHECK(volume(mesh) < whole);
  CHECK(volume(mesh) > 0.8 * whole);
}
