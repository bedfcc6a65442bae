#include "engine/geometry/chord_grid.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace gridshell {
namespace {

constexpr double exact = 1e-13;  // of a chord: corrections this small end an iteration
constexpr double astray = 0.5;   // of a chord: so far from its guess no point is the one wanted

/// The point of the surface near `guess` where two more conditions hold: `rest` fills the last two
/// rows of the residual and of its slope. The surface's slope at the guess serves all iterations.
template <class Rest>
std::optional<Eigen::Vector3d> solved(const Surface& surface, const Eigen::Vector3d& guess,
                                      double chord, const Rest& rest) {
  constexpr int most_iterations = 25;
  Eigen::Vector3d p = guess, residual;
  Eigen::Matrix3d slope;
  slope.row(0) = surface.gradient(guess);
  const double scale = slope.row(0).norm();
  slope.row(0) /= scale;
  for (int k = 0; k < most_iterations; ++k) {
    residual[0] = surface.at(p) / scale;
    rest(p, residual, slope);
    const Eigen::Vector3d step = slope.partialPivLu().solve(residual);
    p -= step;
    if (!((p - guess).norm() < astray * chord)) return std::nullopt;
    if (step.norm() <= exact * chord + 1e-15 * p.norm()) return p;
  }
  return std::nullopt;
}

}  // namespace

/// A geodesic from the apex, which is its first point; where the surface ends, so does it, with a
/// last point that is none of the surface.
struct ChordGrid::Axis {
  std::vector<Eigen::Vector3d> points;
  bool ends = false;
};

/// In equal chords, until it is `margin` chords outside.
Result<ChordGrid::Axis> ChordGrid::geodesic(const Surface& surface, const NetPlace& place,
                                            Eigen::Vector3d along, double chord, int margin,
                                            int most) {
  Axis axis{{place.apex}};
  std::vector<Eigen::Vector3d>& points = axis.points;
  for (int out = 0; out < margin && int(points.size()) <= most;) {
    const Eigen::Vector3d here = points.back();
    const Eigen::Vector3d sideways = surface.gradient(here).cross(along).normalized();
    const auto next = solved(surface, here + chord * along, chord,
                             [&](const auto& p, auto& residual, auto& slope) {
                               const Eigen::Vector3d way = p - here;
                               residual[1] = (way.squaredNorm() / chord - chord) / 2;
                               residual[2] = sideways.dot(way);
                               slope.row(1) = way / chord;
                               slope.row(2) = sideways;
                             });
    if (!next) {
      // whether that is too early, whoever asks for the net will say
      points.push_back(here + chord * along);
      axis.ends = true;
      return axis;
    }
    along = (*next - here).normalized();
    points.push_back(*next);
    out = place.outside(*next) < 0 ? 0 : out + 1;
  }
  if (int(points.size()) <= most) return axis;
  const Eigen::Vector3d& last = points.back();
  return fail(Fault::bad_input,
              fmt::format("the boundary does not cross the net's axes within {:g} mm of the apex: "
                          "at ({:.4g}, {:.4g}, {:.4g}) mm an axis is still inside",
                          most * chord, last.x(), last.y(), last.z()));
}

void ChordGrid::put_axis(const Axis& axis, int step_u, int step_v) {
  const int last = int(axis.points.size()) - 1;
  for (int k = 0; k <= last; ++k) {
    points_[place(k * step_u, k * step_v)] = axis.points[std::size_t(k)];
    nodes_[place(k * step_u, k * step_v)] = axis.ends && k == last ? Node::lost : Node::known;
  }
}

Result<ChordGrid> ChordGrid::make(const Surface& surface, const NetPlace& place, double chord_mm,
                                  int margin, int most) {
  const Eigen::Vector3d along_v = place.up.cross(place.along_u);
  const std::array<Eigen::Vector3d, 4> ways{place.along_u, along_v, -place.along_u, -along_v};
  std::array<Axis, 4> axes;
  for (std::size_t k = 0; k < 4; ++k) {
    auto axis = geodesic(surface, place, ways[k], chord_mm, margin, most);
    if (!axis) return tl::unexpected(axis.error());
    axes[k] = std::move(*axis);
  }
  ChordGrid grid;
  grid.chord_ = chord_mm;
  grid.before_u_ = int(axes[2].points.size()) - 1, grid.before_v_ = int(axes[3].points.size()) - 1;
  grid.columns_ = grid.before_u_ + int(axes[0].points.size());
  grid.rows_ = grid.before_v_ + int(axes[1].points.size());
  const std::size_t count = std::size_t(grid.columns_) * std::size_t(grid.rows_);
  grid.points_.assign(count, Eigen::Vector3d::Zero());
  grid.nodes_.assign(count, Node::unasked);
  grid.put_axis(axes[0], 1, 0);
  grid.put_axis(axes[1], 0, 1);
  grid.put_axis(axes[2], -1, 0);
  grid.put_axis(axes[3], 0, -1);
  for (const int sign_u : {1, -1})
    for (const int sign_v : {1, -1}) grid.fill(surface, place, margin, sign_u, sign_v);
  grid.join_inside(place);
  return grid;
}

/// One quadrant, row by row away from the axes.
void ChordGrid::fill(const Surface& surface, const NetPlace& place, int margin, int sign_u,
                     int sign_v) {
  const int most_u = sign_u > 0 ? last_u() : -first_u(),
            most_v = sign_v > 0 ? last_v() : -first_v();
  // how many nodes outside, of this row and the one before
  std::vector<int> out(std::size_t(most_u) + 1), before(out.size());
  const auto depth = [&](int i, int j, int least) {
    return place.outside(at(i, j)) < 0 ? 0 : least + 1;
  };
  for (int i = 1; i <= most_u; ++i)
    out[std::size_t(i)] = depth(sign_u * i, 0, out[std::size_t(i) - 1]);
  for (int j = 1; j <= most_v; ++j) {
    std::swap(out, before);
    out[0] = depth(0, sign_v * j, before[0]);
    for (int i = 1; i <= most_u; ++i) {
      const int a = sign_u * i, b = sign_v * j;
      int& here = out[std::size_t(i)];
      here = margin;
      const int least = std::min(before[std::size_t(i)], out[std::size_t(i) - 1]);
      Node& state = nodes_[this->place(a, b)];
      // beyond where the net has ended it does not begin again
      for (const Node one : {node(a - sign_u, b), node(a, b - sign_v)})
        if (one == Node::folded || one == Node::lost) state = one;
      if (state != Node::unasked || least >= margin || node(a - sign_u, b) != Node::known ||
          node(a, b - sign_v) != Node::known)
        continue;
      const Eigen::Vector3d &A = at(a - sign_u, b), &B = at(a, b - sign_v);
      const auto p = solved(surface, A + B - at(a - sign_u, b - sign_v), chord_,
                            [&](const auto& x, auto& residual, auto& slope) {
                              residual[1] = ((x - A).squaredNorm() / chord_ - chord_) / 2;
                              residual[2] = ((x - B).squaredNorm() / chord_ - chord_) / 2;
                              slope.row(1) = (x - A) / chord_;
                              slope.row(2) = (x - B) / chord_;
                            });
      state = Node::lost;
      if (!p) continue;
      state = Node::folded;
      if ((*p - A).cross(*p - B).norm() < least_sine * chord_ * chord_) continue;
      state = Node::known;
      points_[this->place(a, b)] = *p;
      here = depth(a, b, least);
    }
  }
}

void ChordGrid::join_inside(const NetPlace& place) {
  inside_.assign(points_.size(), 0);
  std::vector<std::array<int, 2>> open{{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (node(i, j) != Node::known || inside(i, j) || !(place.outside(at(i, j)) < 0)) continue;
    inside_[this->place(i, j)] = 1;
    for (const auto& next : {std::array{i + 1, j}, {i - 1, j}, {i, j + 1}, {i, j - 1}})
      open.push_back(next);
  }
}

}  // namespace gridshell
