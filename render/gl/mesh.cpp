#include "render/gl/mesh.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gridshell::render {
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
    // after an edge without length or a reversal the direction of the point before is used
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
  // truncated, since rounding would cost a call for each of a hundred thousand vertices
  for (int k = 0; k < 3; ++k) v.normal[k] = std::int16_t(32767 * std::clamp(normal[k], -1.f, 1.f));
  vertices.push_back(v);
  return std::uint32_t(vertices.size() - 1);
}

void Mesh::triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  indices.insert(indices.end(), {a, b, c});
}

namespace {

std::int16_t stored_radius(float radius) {
  const float root = std::sqrt(std::max(radius, 0.f) / widest_radius_mm);
  return std::int16_t(std::clamp(std::round(32767 * root), 1.f, 32767.f));
}

constexpr int most_steps = 4;  // pieces along a cell's side

/// The position of a node: index `at` in rod `rod`.
struct RodPosition {
  int rod = 0, at = 0;
};

/// The positions of every node.
class RodPositions {
 public:
  RodPositions(const record::Layout& layout, std::size_t nodes) : first_(nodes + 1) {
    for (const std::vector<int>& rod : layout.rods)
      for (const int node : rod) ++first_[std::size_t(node) + 1];
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    all_.resize(first_.back());
    std::vector<std::size_t> next = first_;
    for (int r = 0; r < int(layout.rods.size()); ++r)
      for (int k = 0; k < int(layout.rods[r].size()); ++k)
        all_[next[std::size_t(layout.rods[r][k])]++] = {r, k};
  }
  std::span<const RodPosition> operator[](int node) const {
    return std::span(all_).subspan(first_[node], first_[node + 1] - first_[node]);
  }

 private:
  std::vector<std::size_t> first_;  // into all_, of each node
  std::vector<RodPosition> all_;
};

/// The nodes from `a` to `b` along their common rod; `a` and `b` alone if there is none.
std::vector<int> side(const record::Layout& layout, const RodPositions& where, int a, int b) {
  for (const RodPosition& from : where[a])
    for (const RodPosition& to : where[b]) {
      if (from.rod != to.rod) continue;
      const int step = from.at <= to.at ? 1 : -1;
      std::vector<int> result;
      for (int k = from.at; k != to.at + step; k += step)
        result.push_back(layout.rods[from.rod][k]);
      return result;
    }
  return {a, b};
}

/// `steps` + 1 points along a side, at equal steps of the nodes' index.
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
};

/// Whether the nodes are within the tolerance of points that divide the chord from the first to the
/// last into equal parts.
bool straight(const Eigen::Matrix3Xd& nodes, const std::vector<int>& side, float tolerance) {
  const Eigen::Vector3d from = nodes.col(side.front()), to = nodes.col(side.back());
  const double last = double(side.size() - 1);
  for (std::size_t k = 1; k + 1 < side.size(); ++k)
    if ((nodes.col(side[k]) - from - double(k) / last * (to - from)).norm() > double(tolerance))
      return false;
  return true;
}

/// The patch of a cell; its four corners alone if no side is further from its chord than half the
/// tolerance.
Patch coons_patch(const record::Layout& layout, const Eigen::Matrix3Xd& nodes,
                  const RodPositions& where, const record::Cell& cell, float tolerance) {
  std::array<int, 4> corner;
  for (int k = 0; k < 4; ++k) corner[k] = layout.joints[cell.joints[k]].node;
  const std::array<std::vector<int>, 4> sides = {
      side(layout, where, corner[0], corner[1]), side(layout, where, corner[3], corner[2]),
      side(layout, where, corner[0], corner[3]), side(layout, where, corner[1], corner[2])};
  if (std::ranges::all_of(sides,
                          [&](const auto& s) { return straight(nodes, s, tolerance / 2); })) {
    Patch flat{1, {}};
    for (const int k : {0, 1, 3, 2}) flat.points.push_back(nodes.col(corner[k]).cast<float>());
    return flat;
  }
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

/// Largest distance of the patch's points from the coarser grid of every `stride`-th point.
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

/// The stride of the coarsest grid within the tolerance.
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
      mesh.add(patch.at(i * stride, j * stride), Eigen::Vector3f::Zero(), packed);
  std::vector<std::uint32_t> indices;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const std::uint32_t a = first + j * (n + 1) + i, b = a + 1, c = b + n + 1, d = a + n + 1;
      indices.insert(indices.end(), {a, b, c, a, c, d});
    }
  return indices;
}

}  // namespace

std::uint32_t add_ribbon(Mesh& mesh, const Ribbon& ribbon) {
  const auto first = std::uint32_t(mesh.vertices.size());
  const auto t = tangents(ribbon.points, ribbon.closed);
  for (std::size_t k = 0; k < ribbon.points.size(); ++k) {
    const PackedColour colour = pack(ribbon.colours[k]);
    const std::int16_t side = stored_radius(ribbon.radii[std::min(k, ribbon.radii.size() - 1)]);
    for (const std::int16_t signed_side : {side, std::int16_t(-side)}) {
      mesh.add(ribbon.points[k], t[k], colour);
      mesh.vertices.back().normal[3] = signed_side;
    }
  }
  return first;
}

int longest_straight_piece(const Ribbon& ribbon, int from, int last, float tolerance_mm) {
  constexpr float colour_step = 0.004f, least_cosine = 0.98f;
  const auto count = int(ribbon.points.size());
  // a strip that is oblique to the tangents at its ends would be too narrow, so it ends at corners
  const auto goes_along = [&](int edge, const Eigen::Vector3f& along) {
    if (!ribbon.closed && (edge < 0 || edge + 1 >= count)) return true;
    const Eigen::Vector3f step =
        ribbon.points[(edge + 1) % count] - ribbon.points[(edge + count) % count];
    return step.dot(along) >= least_cosine * step.norm() * along.norm();
  };
  const auto within = [&](int to) {
    const Eigen::Vector3f &a = ribbon.points[from], &b = ribbon.points[to % count];
    const Eigen::Vector4f &first = ribbon.colours[from], &second = ribbon.colours[to % count];
    const Eigen::Vector3f along = b - a;
    const float length2 = along.squaredNorm();
    if (length2 == 0 || !goes_along(from - 1, along) || !goes_along(to, along)) return false;
    for (int k = from + 1; k < to; ++k) {
      const Eigen::Vector3f off = ribbon.points[k % count] - a;
      const float part = off.dot(along) / length2;
      if ((off - part * along).squaredNorm() > tolerance_mm * tolerance_mm) return false;
      const Eigen::Vector4f mixed = first + part * (second - first);
      if ((ribbon.colours[k % count] - mixed).cwiseAbs().maxCoeff() > colour_step) return false;
    }
    return true;
  };
  int to = from + 1;
  while (to < last && within(to + 1)) ++to;
  return to;
}

void add_strip_quad(std::vector<std::uint32_t>& indices, std::uint32_t first, int k, int l) {
  const std::uint32_t a = first + 2 * std::uint32_t(k), b = first + 2 * std::uint32_t(l);
  indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
}

std::vector<std::uint32_t> add_bead(Mesh& mesh, const Eigen::Vector3f& centre,
                                    const Eigen::Vector3f& axis, float radius, BeadShape shape,
                                    const Eigen::Vector4f& colour) {
  const auto first = std::uint32_t(mesh.vertices.size());
  const std::int16_t side = stored_radius(radius);
  PackedColour packed = pack(colour);
  for (const int up : {0, 1})
    for (const std::int16_t right : {std::int16_t(-side), side}) {
      // 21845 is a third of 65535: bit 0 the side, bit 1 the shape
      packed[3] = std::uint16_t(21845 * (up + (shape == BeadShape::ball ? 2 : 0)));
      mesh.add(centre, axis, packed);
      mesh.vertices.back().normal[3] = right;
    }
  return {first, first + 1, first + 3, first, first + 3, first + 2};
}

std::vector<CellPatch> add_cell_patches(Mesh& mesh, const record::Layout& layout,
                                        const Eigen::Matrix3Xd& nodes,
                                        std::span<const Eigen::Vector4f> colours,
                                        float tolerance_mm) {
  const RodPositions where(layout, std::size_t(nodes.cols()));
  std::vector<CellPatch> patches;
  for (int c = 0; c < int(layout.cells.size()); ++c)
    if (colours[c].w() > 0)
      patches.push_back(
          {c, add_patch(mesh, coons_patch(layout, nodes, where, layout.cells[c], tolerance_mm),
                        colours[c], tolerance_mm)});
  return patches;
}

}  // namespace gridshell::render
