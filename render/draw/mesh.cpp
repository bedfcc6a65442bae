#include "render/draw/mesh.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace gridshell::render {
namespace {

/// A unit vector at right angles to the unit vector `t`.
Eigen::Vector3f any_normal(const Eigen::Vector3f& t) {
  int smallest = 0;
  t.cwiseAbs().minCoeff(&smallest);
  return t.cross(Eigen::Vector3f::Unit(smallest)).normalized();
}

/// Cosine and sine of the corners of a regular polygon.
std::vector<Eigen::Vector2f> corners(int sides) {
  std::vector<Eigen::Vector2f> result(sides);
  for (int k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    result[k] = Eigen::Vector2f(Eigen::Vector2d(std::cos(angle), std::sin(angle)).cast<float>());
  }
  return result;
}

/// Frame vectors at right angles to the tangents, carried from each to the next without twist.
std::vector<Eigen::Vector3f> transport(const std::vector<Eigen::Vector3f>& t) {
  std::vector<Eigen::Vector3f> normals(t.size());
  normals[0] = any_normal(t[0]);
  for (std::size_t i = 1; i < t.size(); ++i) {
    const Eigen::Quaternionf turn = Eigen::Quaternionf::FromTwoVectors(t[i - 1], t[i]);
    const Eigen::Vector3f carried = turn * normals[i - 1];
    normals[i] = (carried - carried.dot(t[i]) * t[i]).normalized();
  }
  return normals;
}

/// The angle by which a closed tube's last frame must turn to meet its first.
float closing_angle(const std::vector<Eigen::Vector3f>& t, const std::vector<Eigen::Vector3f>& n) {
  const Eigen::Vector3f arrived =
      Eigen::Quaternionf::FromTwoVectors(t.back(), t.front()) * n.back();
  return std::atan2(t.front().dot(arrived.cross(n.front())), arrived.dot(n.front()));
}

/// Joins two rings of vertices by a strip, seen from outside with `to` ahead along the axis.
void join_rings(Mesh& mesh, std::uint32_t from, std::uint32_t to, int sides) {
  for (int k = 0; k < sides; ++k) {
    const int l = (k + 1) % sides;
    mesh.triangle(from + k, from + l, to + l);
    mesh.triangle(from + k, to + l, to + k);
  }
}

/// A ring of vertices with normals leaning by `lean` (sine) along the axis.
std::uint32_t add_ring(Mesh& mesh, const std::vector<Eigen::Vector2f>& corner,
                       const Eigen::Vector3f& centre, const Eigen::Matrix3f& frame, float radius,
                       float lean, const PackedColour& colour) {
  const auto first = std::uint32_t(mesh.vertices.size());
  const float across = std::sqrt(std::max(0.f, 1 - lean * lean));
  for (const Eigen::Vector2f& c : corner) {
    const Eigen::Vector3f radial = frame.col(0) * c.x() + frame.col(1) * c.y();
    mesh.add(centre + radius * radial, across * radial + lean * frame.col(2), colour);
  }
  return first;
}

/// Closes a ring with a round cap; `sign` +1 at the end of the axis, -1 at its start.
void add_cap(Mesh& mesh, const std::vector<Eigen::Vector2f>& corner, std::uint32_t ring,
             const Eigen::Vector3f& centre, const Eigen::Matrix3f& frame, float radius, float sign,
             const PackedColour& colour) {
  const int sides = int(corner.size());
  const float half = std::numbers::sqrt2_v<float> / 2;
  const Eigen::Vector3f axis = sign * frame.col(2);
  const std::uint32_t rim = add_ring(mesh, corner, centre + half * radius * axis, frame,
                                     half * radius, sign * half, colour);
  const std::uint32_t tip = mesh.add(centre + radius * axis, axis, colour);
  if (sign > 0) {
    join_rings(mesh, ring, rim, sides);
    for (int k = 0; k < sides; ++k) mesh.triangle(rim + k, rim + (k + 1) % sides, tip);
  } else {
    join_rings(mesh, rim, ring, sides);
    for (int k = 0; k < sides; ++k) mesh.triangle(rim + (k + 1) % sides, rim + k, tip);
  }
}

Eigen::Matrix3f frame_of(const Eigen::Vector3f& axis, const Eigen::Vector3f& normal) {
  Eigen::Matrix3f frame;
  frame << normal, axis.cross(normal), axis;
  return frame;
}

}  // namespace

std::vector<Eigen::Vector3f> tangents(std::span<const Eigen::Vector3f> points, bool closed) {
  const std::size_t n = points.size();
  std::vector<Eigen::Vector3f> result(n, Eigen::Vector3f::Zero());
  for (std::size_t i = 0; i + (closed ? 0 : 1) < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const Eigen::Vector3f direction = (points[next] - points[i]).stableNormalized();
    result[i] += direction;
    result[next] += direction;
  }
  for (std::size_t i = 0; i < n; ++i) {
    // an edge without length, or one that turns back, keeps the direction before it
    if (result[i].norm() < 1e-6f) result[i] = i ? result[i - 1] : Eigen::Vector3f::UnitX();
    result[i].normalize();
  }
  return result;
}

void Mesh::clear() {
  vertices.clear();
  indices.clear();
}

PackedColour pack(const Eigen::Vector4f& linear) {
  PackedColour packed;
  for (int k = 0; k < 4; ++k)
    packed[k] = std::uint16_t(65535 * std::clamp(linear[k], 0.f, 1.f) + 0.5f);
  return packed;
}

std::uint32_t Mesh::add(const Eigen::Vector3f& position, const Eigen::Vector3f& normal,
                        const PackedColour& colour) {
  Vertex v{position, {}, colour};
  // towards zero: rounding would cost a call for each of a hundred thousand
  for (int k = 0; k < 3; ++k) v.normal[k] = std::int16_t(32767 * std::clamp(normal[k], -1.f, 1.f));
  vertices.push_back(v);
  return std::uint32_t(vertices.size() - 1);
}

void Mesh::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

void add_tube(Mesh& mesh, const Tube& tube) {
  const std::size_t n = tube.points.size();
  if (n < (tube.closed ? 3 : 2)) return;
  const auto corner = corners(tube.sides);
  const auto t = tangents(tube.points, tube.closed);
  const auto normals = transport(t);
  const float angle = tube.closed ? closing_angle(t, normals) : 0;

  std::uint32_t first = 0, before = 0;
  for (std::size_t i = 0; i < n; ++i) {
    // spread the closing turn evenly over a closed tube
    const Eigen::Vector3f normal =
        tube.closed ? Eigen::Vector3f(Eigen::AngleAxisf(angle * i / n, t[i]) * normals[i])
                    : normals[i];
    const std::uint32_t ring = add_ring(mesh, corner, tube.points[i], frame_of(t[i], normal),
                                        tube.radius, 0, pack(tube.colours[i]));
    if (i == 0)
      first = ring;
    else
      join_rings(mesh, before, ring, tube.sides);
    before = ring;
  }
  if (tube.closed) return join_rings(mesh, before, first, tube.sides);
  add_cap(mesh, corner, first, tube.points[0], frame_of(t[0], normals[0]), tube.radius, -1,
          pack(tube.colours[0]));
  add_cap(mesh, corner, before, tube.points[n - 1], frame_of(t[n - 1], normals[n - 1]), tube.radius,
          1, pack(tube.colours[n - 1]));
}

void add_button(Mesh& mesh, const Eigen::Vector3f& centre, const Eigen::Vector3f& axis,
                float radius, float half_height, int sides, const Eigen::Vector4f& colour) {
  const auto corner = corners(sides);
  const Eigen::Matrix3f frame = frame_of(axis, any_normal(axis));
  const PackedColour packed = pack(colour);
  const float rim = 0.3f * std::min(radius, half_height);
  const float inner = radius - rim, side_height = half_height - rim;
  // from the bottom up: flat face, rim, side, rim, flat face
  const std::array<Eigen::Vector3f, 4> rings = {
      Eigen::Vector3f{inner, -half_height, -1}, Eigen::Vector3f{radius, -side_height, 0},
      Eigen::Vector3f{radius, side_height, 0}, Eigen::Vector3f{inner, half_height, 1}};
  std::uint32_t before = 0;
  for (std::size_t k = 0; k < rings.size(); ++k) {
    const std::uint32_t ring = add_ring(mesh, corner, centre + rings[k][1] * axis, frame,
                                        rings[k][0], rings[k][2], packed);
    const bool bottom = k == 0, top = k + 1 == rings.size();
    if (!bottom) join_rings(mesh, before, ring, sides);
    for (int i = 1; i + 1 < sides && (bottom || top); ++i) {
      if (top)
        mesh.triangle(ring, ring + i, ring + i + 1);
      else
        mesh.triangle(ring, ring + i + 1, ring + i);
    }
    before = ring;
  }
}

void add_cone(Mesh& mesh, const Eigen::Vector3f& base, const Eigen::Vector3f& tip, float radius,
              int sides, const Eigen::Vector4f& colour) {
  const Eigen::Vector3f axis = (tip - base).stableNormalized();
  const Eigen::Matrix3f frame = frame_of(axis, any_normal(axis));
  const auto corner = corners(sides);
  const PackedColour packed = pack(colour);
  const float length = (tip - base).norm(), lean = radius / std::hypot(radius, length);
  const std::uint32_t bottom = add_ring(mesh, corner, base, frame, radius, -1, packed);
  const std::uint32_t side = add_ring(mesh, corner, base, frame, radius, lean, packed);
  const std::uint32_t top = add_ring(mesh, corner, tip, frame, 0, lean, packed);
  for (int k = 1; k + 1 < sides; ++k) mesh.triangle(bottom, bottom + k + 1, bottom + k);
  join_rings(mesh, side, top, sides);
}

void add_ball(Mesh& mesh, const Eigen::Vector3f& centre, float radius, int sides,
              const Eigen::Vector4f& colour) {
  const Eigen::Matrix3f frame = Eigen::Matrix3f::Identity();
  const auto corner = corners(sides);
  const PackedColour packed = pack(colour);
  const int rings = std::max(2, sides / 2);
  std::uint32_t before = 0;
  for (int k = 0; k <= rings; ++k) {
    const double angle = std::numbers::pi * (double(k) / rings - 0.5);
    const auto lean = float(std::sin(angle)), across = float(std::cos(angle));
    const Eigen::Vector3f at = centre + radius * lean * frame.col(2);
    const std::uint32_t ring =
        add_ring(mesh, corner, at, frame, radius * std::max(0.f, across), lean, packed);
    if (k > 0) join_rings(mesh, before, ring, sides);
    before = ring;
  }
}

}  // namespace gridshell::render
