// Nets that are marched over meshes, compared with nets of the surfaces on which the vertices are.
#include "engine/geometry/marched_net.h"

#include <cmath>

#include "engine/geometry/surface.h"
#include "tests/engine/geometry/dome_mesh.h"
#include "tests/engine/geometry/net_checks.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

constexpr double d = 20, h = d / 8, degree = M_PI / 180;

/// A mesh, its smooth surface and its lines.
struct Fitted {
  std::shared_ptr<const TriangleMesh> mesh;
  std::shared_ptr<const MeshSurface> smooth;
  std::shared_ptr<const Barriers> lines;

  explicit Fitted(const DomeMesh& dome)
      : mesh(std::make_shared<TriangleMesh>(
            value_of(TriangleMesh::make(dome.vertices, dome.triangles)))),
        smooth(std::make_shared<MeshSurface>(value_of(MeshSurface::fit(*mesh, d)))),
        lines(std::make_shared<Barriers>(*mesh)) {}

  Surface surface() const {
    return {[s = smooth](const Eigen::Vector3d& p) { return s->at(p); }, d};
  }
  /// Upright at (x, y), the u-axis along x.
  NetPose place(double x, double y) const {
    const Surface on = surface();
    const Eigen::Vector3d apex = value_of(on.nearest({x, y, highest_at(*mesh, x, y).value()}));
    Eigen::Vector3d up = on.gradient(apex).normalized();
    if (up.z() < 0) up = -up;
    return {apex, (Eigen::Vector3d::UnitX() - up.x() * up).normalized(), up,
            [](const Eigen::Vector3d&) { return -1.0; }};
  }
  MarchedNet net(double least_angle = 30 * degree, double x = 0, double y = 0) const {
    return value_of(MarchedNet::make(surface(), place(x, y), lines, least_angle, h, 150));
  }
};

/// z = height(x, y) over a disk, triangles of about `edge_mm`.
template <class Height>
DomeMesh mesh_of(double radius, double edge_mm, const Height& height) {
  // the rings of a flat dome
  DomeMesh mesh = ellipsoid_mesh({1, 1, radius}, edge_mm, 1);
  for (auto p : mesh.vertices.colwise()) {
    const double r = radius * std::acos(std::clamp(p.z() / radius, -1.0, 1.0)),
                 around = std::atan2(p.y(), p.x());
    p = Eigen::Vector3d(r * std::cos(around), r * std::sin(around), 0);
    p.z() = height(p.x(), p.y());
  }
  return mesh;
}

/// Largest distance of a net from another, over the points that both reach and whose z is at least
/// `least_z`.
template <class Net>
double off(const MarchedNet& net, const Net& exact, double least_z) {
  double largest = 0;
  int compared = 0;
  for (double u = -120; u <= 120; u += 9.7)
    for (double v = -120; v <= 120; v += 9.7) {
      const auto there = exact.at(u, v);
      if (!there || there->position.z() < least_z) continue;
      const auto here = net.reached(u, v);
      if (!here) continue;
      ++compared;
      largest = std::max(largest, (here->position - there->position).norm());
    }
  CHECK(compared > 100);
  return largest;
}

Surface by_expression(const std::string& text) {
  const Expression F = Expression::parse(text).value();
  return {[F](const Eigen::Vector3d& p) { return F.at(p); }, d};
}

SurfaceNet exact_net(const std::string& text, const Eigen::Vector3d& apex, double radius) {
  return value_of(SurfaceNet::make(
      by_expression(text),
      {apex, Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(),
       [radius](const Eigen::Vector3d& p) { return std::hypot(p.x(), p.y()) - radius; }},
      h));
}

}  // namespace

TEST_CASE("marched chords have the given length, on the surface, and cross at the least angle") {
  const Fitted roof(mesh_of(110, 9, [](double x, double y) {
    return 60 - (x * x + 1.6 * y * y) / 260 + 3 * std::sin(x / 25) * std::cos(y / 31);
  }));
  const Surface surface = roof.surface();
  const MarchedGrid grid(surface, roof.place(12, -8), *roof.lines, 50 * degree, h, 150);
  int chords = 0;
  for (int j = -150; j <= 150; ++j)
    for (int i = -150; i <= 150; ++i) {
      if (!grid.known(i, j)) continue;
      CHECK(std::abs(surface.at(grid.at(i, j).p)) < 1e-9 * d);
      for (const auto& [a, b] : {std::array{1, 0}, {0, 1}}) {
        if (!grid.joined(i, j, a, b)) continue;
        ++chords;
        CHECK(std::abs((grid.at(i + a, j + b).p - grid.at(i, j).p).norm() - h) < 1e-9 * d);
      }
      if (!grid.joined(i, j, -1, 0) || !grid.joined(i, j, 0, -1) || i < 1 || j < 1) continue;
      const Eigen::Vector3d a = grid.at(i, j).p - grid.at(i - 1, j).p,
                            b = grid.at(i, j).p - grid.at(i, j - 1).p;
      CHECK(std::atan2(a.cross(b).norm(), std::abs(a.dot(b))) > 50 * degree);
    }
  CHECK(chords > 5000);
}

TEST_CASE("a marched net has rods of unit speed and obeys Hazzidakis' formula") {
  const Fitted dome(ellipsoid_mesh({140, 110, 90}, 6));
  const MarchedNet net = dome.net();
  CHECK(unit_residual(net, 37, -31) < 1e-6);
  // the angles at the corners, and the curvature between them
  const double u0 = -35, u1 = 45, v0 = -40, v1 = 30;
  constexpr int parts = 40;
  double integral = 0;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; j < parts; ++j) {
      const NetPoint p =
          point_of(net, u0 + (i + 0.5) * (u1 - u0) / parts, v0 + (j + 0.5) * (v1 - v0) / parts);
      integral += p.K * std::sin(p.omega) * (u1 - u0) * (v1 - v0) / (parts * parts);
    }
  const auto omega = [&](double u, double v) { return point_of(net, u, v).omega; };
  const double corners = omega(u1, v1) - omega(u1, v0) - omega(u0, v1) + omega(u0, v0);
  CHECK(integral > 0.2);
  CHECK(corners == Approx(-integral).epsilon(1e-3));
}

TEST_CASE(
    "meshes of 1 000 to 100 000 triangles have the hemisphere's net to less than their triangles "
    "lie off it",
    "[standard]") {
  constexpr double rho = 120;
  for (const double edge : {15.0, 5.0, 1.46}) {
    const Fitted ball(ellipsoid_mesh({rho, rho, rho}, edge));
    CHECK(off(ball.net(), SphereNet(rho), 0) < edge * edge / (8 * rho));
  }
}

TEST_CASE("meshes of other surfaces have their nets to less than their triangles lie off them",
          "[standard]") {
  const auto check = [](const DomeMesh& mesh, const SurfaceNet& exact, double edge, double radius) {
    CHECK(off(Fitted(mesh).net(), exact, -1e9) < edge * edge / (8 * radius));
  };
  // the smallest radius of curvature of each
  for (const double edge : {9.0, 3.0}) {
    check(mesh_of(100, edge, [](double x, double y) { return 80 - (x * x + y * y) / 200; }),
          exact_net("z - 80 + (x^2 + y^2)/200", {0, 0, 80}, 95), edge, 100);
    check(mesh_of(100, edge, [](double x, double y) { return (x * x - y * y) / 300; }),
          exact_net("z - (x^2 - y^2)/300", {0, 0, 0}, 95), edge, 150);
    check(ellipsoid_mesh({140, 110, 90}, edge, 1),
          exact_net("(x/140)^2 + (y/110)^2 + (z/90)^2 - 1", {0, 0, 90}, 85), edge, 90);
  }
}

TEST_CASE("rods on a barrel's mesh are the barrel's") {
  // r = 90 - s^2/400 about x, the upper part
  const auto r = [](double x) { return 90 - x * x / 400; };
  const Fitted barrel(
      mesh_of(80, 6, [&](double x, double y) { return std::sqrt(r(x) * r(x) - y * y); }));
  const auto exact = exact_net("z - sqrt((90 - x^2/400)^2 - y^2)", {0, 0, 90}, 75);
  CHECK(off(barrel.net(), exact, 0) < 6. * 6 / (8 * 45));
}

TEST_CASE("rods end at a hole and continue next to it") {
  DomeMesh dome = mesh_of(100, 6, [](double x, double y) { return 40 - (x * x + y * y) / 250; });
  std::erase_if(dome.triangles, [&](const auto& t) {
    return (dome.vertices.col(t[0]).template head<2>() - Eigen::Vector2d(40, 20)).norm() < 20;
  });
  const Fitted roof(dome);
  CHECK(std::ranges::count(roof.mesh->lines(), LineKind::hole, &MeshLine::kind) == 1);
  const MarchedNet net = roof.net();
  CHECK(net.reached(35, 18) == std::nullopt);
  CHECK(net.reached(40, -15));
  // behind the hole as seen from the apex
  int behind = 0;
  std::vector<std::array<int, 2>> around;
  for (int j = -150; j <= 150; ++j)
    for (int i = -150; i <= 150; ++i) {
      const Eigen::Vector3d& p = net.grid().at(i, j).p;
      if (!net.grid().known(i, j)) continue;
      CHECK((p.head<2>() - Eigen::Vector2d(40, 20)).norm() > 13);
      behind += (p.head<2>() - Eigen::Vector2d(72, 36)).norm() < 8;
      if ((p.head<2>() - Eigen::Vector2d(72, 36)).norm() < 30) around.push_back({i, j});
    }
  CHECK(behind > 20);
  // the parts of the net that pass the hole on both sides do not overlap behind it
  for (const auto& [i, j] : around)
    for (const auto& [a, b] : around)
      if (std::max(std::abs(a - i), std::abs(b - j)) > 2)
        REQUIRE((net.grid().at(i, j).p - net.grid().at(a, b).p).norm() > 0.6 * net.chord());
}

TEST_CASE("rods end at a crease, whose two sides keep their surfaces, and pass its end") {
  // two slopes that meet at x = 0 and flatten out towards y = 20
  const auto height = [](double x, double y) {
    const double fold = std::max(0.0, 20 - y) / 110;
    return 50 - fold * std::abs(x) - x * x / 500;
  };
  const Fitted roof(grid_mesh(40, [&](int i, int j) {
    const double x = 4 * (i - 20), y = 4 * (j - 20);
    return Eigen::Vector3d(x, y, height(x, y));
  }));
  CHECK(std::ranges::count(roof.mesh->lines(), LineKind::crease, &MeshLine::kind) == 1);
  CHECK(std::abs(roof.smooth->at({-3, -50, height(-3, -50)})) < 0.05);
  CHECK(std::abs(roof.smooth->at({3, -50, height(3, -50)})) < 0.05);
  const MarchedNet net = roof.net(30 * degree, -30, 10);
  const MarchedGrid& grid = net.grid();
  bool across = false;
  for (int j = -150; j <= 150; ++j)
    for (int i = -150; i <= 150; ++i)
      for (const auto& [a, b] : {std::array{1, 0}, {0, 1}}) {
        if (!grid.joined(i, j, a, b)) continue;
        const Eigen::Vector3d &p = grid.at(i, j).p, &q = grid.at(i + a, j + b).p;
        if ((p.x() < 0) == (q.x() < 0)) continue;
        across = true;
        // the fold becomes flatter along y; where it turns by about 20 degrees the crease ends
        CHECK(p.y() > -6);
      }
  CHECK(across);
}
