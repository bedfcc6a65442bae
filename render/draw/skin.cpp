#include "render/draw/skin.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <vector>

namespace gridshell::render {
namespace {

constexpr int most_steps = 4;  // along a cell's side

/// Where a node sits: its place `at` along rod `rod`.
struct Place {
  int rod = -1, at = 0;
};

/// The (at most two) rods through every node.
std::vector<std::array<Place, 2>> places(const record::Layout& layout, std::size_t nodes) {
  std::vector<std::array<Place, 2>> result(nodes);
  for (int r = 0; r < int(layout.rods.size()); ++r)
    for (int k = 0; k < int(layout.rods[r].size()); ++k) {
      auto& slots = result[layout.rods[r][k]];
      slots[slots[0].rod < 0 ? 0 : 1] = {r, k};
    }
  return result;
}

/// The nodes from `a` to `b` along the rod they share; the two alone when they share none.
std::vector<int> side(const record::Layout& layout, const std::vector<std::array<Place, 2>>& where,
                      int a, int b) {
  for (const Place& from : where[a])
    for (const Place& to : where[b]) {
      if (from.rod < 0 || from.rod != to.rod) continue;
      const int step = from.at <= to.at ? 1 : -1;
      std::vector<int> result;
      for (int k = from.at; k != to.at + step; k += step)
        result.push_back(layout.rods[from.rod][k]);
      return result;
    }
  return {a, b};
}

/// `steps` + 1 points along a side, evenly in its index.
std::vector<Eigen::Vector3f> resample(const Eigen::Matrix3Xd& nodes, const std::vector<int>& side,
                                      int steps) {
  std::vector<Eigen::Vector3f> result(steps + 1);
  const double edges = double(side.size() - 1);
  for (int k = 0; k <= steps; ++k) {
    const double at = edges * k / steps;
    const int before = std::min(int(at), int(side.size()) - 2);
    const double part = at - before;
    result[k] =
        ((1 - part) * nodes.col(side[before]) + part * nodes.col(side[before + 1])).cast<float>();
  }
  return result;
}

/// Points of a cell's patch on a square grid of (steps + 1)^2, u fastest.
struct Patch {
  int steps = 1;
  std::vector<Eigen::Vector3f> points;

  const Eigen::Vector3f& at(int u, int v) const { return points[v * (steps + 1) + u]; }
  Eigen::Vector3f normal(int u, int v) const {
    const Eigen::Vector3f along_u = at(std::min(u + 1, steps), v) - at(std::max(u - 1, 0), v);
    const Eigen::Vector3f along_v = at(u, std::min(v + 1, steps)) - at(u, std::max(v - 1, 0));
    return along_u.cross(along_v).stableNormalized();
  }
};

Patch coons_patch(const record::Layout& layout, const Eigen::Matrix3Xd& nodes,
                  const std::vector<std::array<Place, 2>>& where, const record::Cell& cell) {
  std::array<int, 4> corner;
  for (int k = 0; k < 4; ++k) corner[k] = layout.joints[cell.joints[k]].node;
  const std::array<std::vector<int>, 4> sides = {
      side(layout, where, corner[0], corner[1]), side(layout, where, corner[3], corner[2]),
      side(layout, where, corner[0], corner[3]), side(layout, where, corner[1], corner[2])};
  std::size_t edges = 1;
  for (const auto& s : sides) edges = std::max(edges, s.size() - 1);

  Patch patch{int(std::min<std::size_t>(edges, most_steps)), {}};
  const auto c0 = resample(nodes, sides[0], patch.steps);
  const auto c1 = resample(nodes, sides[1], patch.steps);
  const auto d0 = resample(nodes, sides[2], patch.steps);
  const auto d1 = resample(nodes, sides[3], patch.steps);
  const int n = patch.steps;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const float u = float(i) / n, v = float(j) / n;
      const Eigen::Vector3f bilinear =
          (1 - v) * ((1 - u) * c0[0] + u * c0[n]) + v * ((1 - u) * c1[0] + u * c1[n]);
      patch.points.push_back((1 - v) * c0[i] + v * c1[i] + (1 - u) * d0[j] + u * d1[j] - bilinear);
    }
  return patch;
}

/// How far the points that a grid of every `stride`-th leaves out lie off it, at most.
float left_out(const Patch& patch, int stride) {
  float most = 0;
  for (int v = 0; v <= patch.steps; ++v)
    for (int u = 0; u <= patch.steps; ++u) {
      const int u0 = u - u % stride, v0 = v - v % stride;
      const int u1 = std::min(u0 + stride, patch.steps), v1 = std::min(v0 + stride, patch.steps);
      const float a = float(u - u0) / float(stride), b = float(v - v0) / float(stride);
      const Eigen::Vector3f there = (1 - b) * ((1 - a) * patch.at(u0, v0) + a * patch.at(u1, v0)) +
                                    b * ((1 - a) * patch.at(u0, v1) + a * patch.at(u1, v1));
      most = std::max(most, (patch.at(u, v) - there).norm());
    }
  return most;
}

/// The coarsest grid within the tolerance.
int stride_of(const Patch& patch, float tolerance) {
  for (int stride = patch.steps; stride > 1; --stride)
    if (patch.steps % stride == 0 && left_out(patch, stride) <= tolerance) return stride;
  return 1;
}

std::vector<std::uint32_t> add_patch(Mesh& mesh, const Patch& patch, const Eigen::Vector4f& colour,
                                     float tolerance) {
  const int stride = stride_of(patch, tolerance), n = patch.steps / stride;
  const auto first = std::uint32_t(mesh.vertices.size());
  const PackedColour packed = pack(colour);
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i)
      mesh.add(patch.at(i * stride, j * stride), patch.normal(i * stride, j * stride), packed);
  std::vector<std::uint32_t> indices;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      indices.insert(indices.end(), {a, b, c, a, c, d});
    }
  return indices;
}

}  // namespace

std::vector<CellPatch> add_cells(Mesh& mesh, const record::Layout& layout,
                                 const Eigen::Matrix3Xd& nodes,
                                 std::span<const Eigen::Vector4f> colours, float tolerance_mm) {
  const auto where = places(layout, nodes.cols());
  std::vector<CellPatch> patches;
  for (int c = 0; c < int(layout.cells.size()); ++c)
    if (colours[c].w() > 0)
      patches.push_back({c, add_patch(mesh, coons_patch(layout, nodes, where, layout.cells[c]),
                                      colours[c], tolerance_mm)});
  return patches;
}

}  // namespace gridshell::render
