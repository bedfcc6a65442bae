#include "render/gl/laths.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace gridshell::render {

void put_laths(std::vector<double> laths_mm, Drawing& drawing) {
  constexpr Colour wood{0.66f, 0.55f, 0.42f, 1};
  if (laths_mm.empty()) return;
  drawing.rod_colour = wood;
  if (drawing.joint_diameter_mm > 0) drawing.joint_diameter_mm = 0.5 * std::ranges::max(laths_mm);
  drawing.laths_mm = std::move(laths_mm);
}

std::vector<Eigen::Vector3f> shell_normals(const Drawing& drawing) {
  const auto count = std::size_t(drawing.nodes.cols());
  std::vector<Eigen::Vector3f> tangent(count, Eigen::Vector3f::Zero()), normal = tangent;
  for (const auto& rod : drawing.layout->rods)
    for (std::size_t k = 0; k < rod.size(); ++k) {
      const int before = rod[k ? k - 1 : 0], after = rod[std::min(k + 1, rod.size() - 1)];
      const Eigen::Vector3f t =
          (drawing.nodes.col(after) - drawing.nodes.col(before)).cast<float>().stableNormalized();
      normal[rod[k]] = tangent[rod[k]].cross(t);
      tangent[rod[k]] = t;
    }
  return normal;
}

Eigen::Vector2f lath_size(const Drawing& drawing, std::size_t rod) {
  const auto& sides = drawing.laths_mm;
  if (2 * rod + 1 >= sides.size()) return Eigen::Vector2f::Zero();
  return {float(sides[2 * rod]), float(sides[2 * rod + 1])};
}

std::vector<Eigen::Vector3f> lath_normals(const Drawing& drawing, std::size_t rod,
                                          const std::vector<Eigen::Vector3f>& shell_normals) {
  constexpr float least = 1e-4f;
  const auto& nodes = drawing.layout->rods[rod];
  std::vector<Eigen::Vector3f> points;
  for (const int node : nodes) points.push_back(drawing.nodes.col(node).cast<float>());
  std::vector<Eigen::Vector3f> normals(nodes.size(), Eigen::Vector3f::UnitZ());
  const auto along = tangents(points, false);
  std::size_t known = nodes.size();  // index of the last joint; nodes.size(): none yet
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Eigen::Vector3f normal = shell_normals[std::size_t(nodes[k])];
    if (normal.norm() < least) continue;
    normal.normalize();
    if (known < nodes.size() && normal.dot(normals[known]) < 0) normal = -normal;
    const std::size_t from = known < nodes.size() ? known : k;
    for (std::size_t n = from + 1; n < k; ++n)
      normals[n] = normals[from] + float(n - from) / float(k - from) * (normal - normals[from]);
    if (known == nodes.size()) std::fill_n(normals.begin(), k, normal);
    std::fill(normals.begin() + long(k), normals.end(), normal);
    known = k;
  }
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Eigen::Vector3f across = along[k].cross(normals[k]);
    if (across.norm() < least) across = along[k].unitOrthogonal();
    normals[k] = across.normalized().cross(along[k]);
  }
  return normals;
}

float apparent_width(const Eigen::Vector2f& size, const Eigen::Vector3f& tangent,
                     const Eigen::Vector3f& normal, const Eigen::Vector3f& sight) {
  const Eigen::Vector3f across = sight.cross(tangent).stableNormalized();
  return size.x() * std::abs(across.dot(tangent.cross(normal))) +
         size.y() * std::abs(across.dot(normal));
}

std::vector<std::uint32_t> add_lath(Mesh& mesh, const LathPiece& piece, const LathView& view) {
  const auto along = tangents(piece.points, false);
  std::vector<std::uint32_t> indices;
  // corners 0 to 3 around point k: upper right, upper left, lower left, lower right
  const auto corner = [&](std::size_t k, int c) -> Eigen::Vector3f {
    const Eigen::Vector3f across = along[k].cross(piece.normals[k]);
    const float right = c == 0 || c == 3 ? 0.5f : -0.5f, up = c < 2 ? 0.5f : -0.5f;
    return piece.points[k] + right * piece.size.x() * across +
           up * piece.size.y() * piece.normals[k];
  };
  const auto add_face = [&](const std::array<Eigen::Vector3f, 4>& at, const Eigen::Vector3f& out,
                            const Eigen::Vector4f& first, const Eigen::Vector4f& last) {
    const Eigen::Vector3f middle = 0.25f * (at[0] + at[1] + at[2] + at[3]);
    const Eigen::Vector3f sight = view.orthographic ? view.eye : view.eye - middle;
    if (out.dot(sight) <= 0) return;
    float lit = 1;
    if (view.light) {
      const float up = out.z();
      lit = float(view.light->key) * std::max(0.f, out.dot(view.light->direction.cast<float>())) +
            0.5f * float(view.light->sky) * (1 + up) + 0.5f * float(view.light->bounce) * (1 - up);
    }
    const auto shade = [&](Eigen::Vector4f colour) {
      colour.head<3>() *= lit;
      return pack(colour);
    };
    const std::uint32_t a = mesh.add(at[0], Eigen::Vector3f::Zero(), shade(first));
    mesh.add(at[1], Eigen::Vector3f::Zero(), shade(first));
    mesh.add(at[2], Eigen::Vector3f::Zero(), shade(last));
    mesh.add(at[3], Eigen::Vector3f::Zero(), shade(last));
    indices.insert(indices.end(), {a, a + 1, a + 2, a, a + 2, a + 3});
  };
  const std::size_t last = piece.points.size() - 1;
  for (std::size_t k = 0; k < last; ++k)
    for (int c = 0; c < 4; ++c) {
      const int next = (c + 1) % 4;
      // face c is between corners c and c + 1: up, left, down, right
      const Eigen::Vector3f normal = (piece.normals[k] + piece.normals[k + 1]).normalized();
      const Eigen::Vector3f across = (along[k] + along[k + 1]).normalized().cross(normal);
      const Eigen::Vector3f out = c == 0 ? normal : c == 2 ? -normal : c == 1 ? -across : across;
      add_face({corner(k, c), corner(k, next), corner(k + 1, next), corner(k + 1, c)}, out,
               piece.colours[k], piece.colours[k + 1]);
    }
  for (const std::size_t end : {std::size_t(0), last})
    add_face({corner(end, 0), corner(end, 1), corner(end, 2), corner(end, 3)},
             end == 0 ? Eigen::Vector3f(-along[end]) : along[end], piece.colours[end],
             piece.colours[end]);
  return indices;
}

}  // namespace gridshell::render
