#include "engine/geometry/surface_net.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/try.h"

namespace gridshell {
namespace {

constexpr double exact = 1e-13;  // correction, over a chord, that ends an iteration
constexpr double astray = 0.5;   // largest distance from the guess, over a chord

/// The point of the surface near `guess` that satisfies two more conditions: `rest` fills the last
/// two rows of the residual and of its derivative. The gradient at the guess is used in all
/// iterations.
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
    const Eigen::Vector3d step = solution(slope, residual);
    p -= step;
    if (!((p - guess).norm() < astray * chord)) return std::nullopt;
    if (step.norm() <= exact * chord + 1e-15 * p.norm()) return p;
  }
  return std::nullopt;
}

constexpr int reach = net_reach;
constexpr int coarse_margin = 8;  // nodes of the coarser grid around the part that is used
constexpr int most_nodes = 600;   // largest number of nodes from the apex to an end of an axis

/// Lagrange weights of the nodes -2 ... 3 for the value, the first and the second derivative at t
/// in [0, 1].
struct Weights {
  std::array<double, 2 * reach> value{}, slope{}, second{};

  explicit Weights(double t) {
    for (int a = 0; a < 2 * reach; ++a) {
      // the polynomial and its first two derivatives by the product rule
      double p = 1, dp = 0, ddp = 0;
      for (int b = 0; b < 2 * reach; ++b) {
        if (b == a) continue;
        const double factor = (t - (b + 1 - reach)) / (a - b), rate = 1.0 / (a - b);
        ddp = ddp * factor + 2 * dp * rate;
        dp = dp * factor + p * rate;
        p *= factor;
      }
      value[std::size_t(a)] = p, slope[std::size_t(a)] = dp, second[std::size_t(a)] = ddp;
    }
  }
};

std::string help() {
  return "; a smaller part of the surface, turned axes ([net] axis_deg) or building blocks may "
         "help";
}

}  // namespace

std::optional<Eigen::Vector3d> geodesic_chord(const Surface& surface, const Eigen::Vector3d& here,
                                              const Eigen::Vector3d& along, double chord) {
  const Eigen::Vector3d sideways = surface.gradient(here).cross(along).normalized();
  return solved(surface, here + chord * along, chord,
                [&](const auto& p, auto& residual, auto& slope) {
                  const Eigen::Vector3d offset = p - here;
                  residual[1] = (offset.squaredNorm() / chord - chord) / 2;
                  residual[2] = sideways.dot(offset);
                  slope.row(1) = offset / chord;
                  slope.row(2) = sideways;
                });
}

std::optional<Eigen::Vector3d> chord_corner(const Surface& surface, const Eigen::Vector3d& guess,
                                            const Eigen::Vector3d& A, const Eigen::Vector3d& B,
                                            double chord) {
  return solved(surface, guess, chord, [&](const auto& x, auto& residual, auto& slope) {
    residual[1] = ((x - A).squaredNorm() / chord - chord) / 2;
    residual[2] = ((x - B).squaredNorm() / chord - chord) / 2;
    slope.row(1) = (x - A) / chord;
    slope.row(2) = (x - B) / chord;
  });
}

tl::unexpected<Error> ended_before(double u, double v) {
  return invalid("the net of the surface ends before (u, v) = ({:g}, {:g}) mm", u, v);
}

NetPoint net_point(const NetNodes& nodes, double t_u, double t_v, double chord) {
  const Weights along_u(t_u), along_v(t_v);
  const double H = chord;
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), C_u = position, C_v = position,
                  C_uu = position, C_uv = position, C_vv = position;
  for (std::size_t b = 0; b < 2 * reach; ++b) {
    Eigen::Vector3d value = Eigen::Vector3d::Zero(), slope = value, second = value;
    for (std::size_t a = 0; a < 2 * reach; ++a) {
      const Eigen::Vector3d& p = nodes[b * 2 * reach + a];
      value += along_u.value[a] * p;
      slope += along_u.slope[a] * p;
      second += along_u.second[a] * p;
    }
    position += along_v.value[b] * value;
    C_u += along_v.value[b] * slope / H;
    C_v += along_v.slope[b] * value / H;
    C_uu += along_v.value[b] * second / (H * H);
    C_uv += along_v.slope[b] * slope / (H * H);
    C_vv += along_v.second[b] * value / (H * H);
  }
  NetPoint found;
  found.position = position;
  found.tangent_u = C_u.normalized();
  found.tangent_v = C_v.normalized();
  const Eigen::Vector3d across = found.tangent_u.cross(found.tangent_v);
  found.omega = std::atan2(across.norm(), found.tangent_u.dot(found.tangent_v));
  // determinant of the second fundamental form over that of the first
  const Eigen::Vector3d normal = across.normalized();
  const double M = normal.dot(C_uv);
  found.K = (normal.dot(C_uu) * normal.dot(C_vv) - M * M) / across.squaredNorm();
  return found;
}

/// A geodesic from the apex, which is its first point. If the surface ends (`ends`), the last point
/// is not on the surface.
struct ChordGrid::Axis {
  std::vector<Eigen::Vector3d> points;
  bool ends = false;
};

/// Computes a geodesic in equal chords, until it is `margin` chords outside the part that is used.
Result<ChordGrid::Axis> ChordGrid::geodesic(const Surface& surface, const NetPose& pose,
                                            Eigen::Vector3d along, double chord, int margin,
                                            int most) {
  Axis axis{{pose.apex}};
  std::vector<Eigen::Vector3d>& points = axis.points;
  for (int out = 0; out < margin && int(points.size()) <= most;) {
    const Eigen::Vector3d here = points.back();
    const auto next = geodesic_chord(surface, here, along, chord);
    if (!next) {
      // check_whole() reports an error if this is too early
      points.push_back(here + chord * along);
      axis.ends = true;
      return axis;
    }
    along = (*next - here).normalized();
    points.push_back(*next);
    out = pose.outside(*next) < 0 ? 0 : out + 1;
  }
  if (int(points.size()) <= most) return axis;
  const Eigen::Vector3d& last = points.back();
  return invalid(
      "the boundary does not cross the net's axes within {:g} mm of the apex: at ({:.4g}, "
      "{:.4g}, {:.4g}) mm an axis is still inside",
      most * chord, last.x(), last.y(), last.z());
}

void ChordGrid::put_axis(const Axis& axis, int step_u, int step_v) {
  const int last = int(axis.points.size()) - 1;
  for (int k = 0; k <= last; ++k) {
    points_[index(k * step_u, k * step_v)] = axis.points[std::size_t(k)];
    nodes_[index(k * step_u, k * step_v)] = axis.ends && k == last ? Node::lost : Node::known;
  }
}

Result<ChordGrid> ChordGrid::make(const Surface& surface, const NetPose& pose, double chord_mm,
                                  int margin, int most) {
  const Eigen::Vector3d along_v = pose.up.cross(pose.along_u);
  const std::array<Eigen::Vector3d, 4> directions{pose.along_u, along_v, -pose.along_u, -along_v};
  std::array<Axis, 4> axes;
  for (std::size_t k = 0; k < 4; ++k) {
    TRY(axis, geodesic(surface, pose, directions[k], chord_mm, margin, most));
    axes[k] = std::move(*axis);
  }
  ChordGrid grid;
  grid.chord_ = chord_mm;
  grid.before_u_ = int(axes[2].points.size()) - 1, grid.before_v_ = int(axes[3].points.size()) - 1;
  grid.columns_ = grid.before_u_ + int(axes[0].points.size());
  grid.rows_ = grid.before_v_ + int(axes[1].points.size());
  const std::size_t count = std::size_t(grid.columns_) * std::size_t(grid.rows_);
  grid.points_.assign(count, Eigen::Vector3d::Zero());
  grid.nodes_.assign(count, Node::uncomputed);
  grid.put_axis(axes[0], 1, 0);
  grid.put_axis(axes[1], 0, 1);
  grid.put_axis(axes[2], -1, 0);
  grid.put_axis(axes[3], 0, -1);
  for (const int sign_u : {1, -1})
    for (const int sign_v : {1, -1}) grid.fill(surface, pose, margin, sign_u, sign_v);
  grid.join_inside(pose);
  return grid;
}

/// Computes one quadrant, row by row away from the axes.
void ChordGrid::fill(const Surface& surface, const NetPose& pose, int margin, int sign_u,
                     int sign_v) {
  const int most_u = sign_u > 0 ? last_u() : -first_u(),
            most_v = sign_v > 0 ? last_v() : -first_v();
  // number of nodes outside the part that is used, for this row and the row before
  std::vector<int> out(std::size_t(most_u) + 1), before(out.size());
  const auto depth = [&](int i, int j, int least) {
    return pose.outside(at(i, j)) < 0 ? 0 : least + 1;
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
      Node& state = nodes_[index(a, b)];
      // nodes past a folded or lost node are not computed
      for (const Node one : {node(a - sign_u, b), node(a, b - sign_v)})
        if (one == Node::folded || one == Node::lost) state = one;
      if (state != Node::uncomputed || least >= margin || node(a - sign_u, b) != Node::known ||
          node(a, b - sign_v) != Node::known)
        continue;
      const Eigen::Vector3d &A = at(a - sign_u, b), &B = at(a, b - sign_v);
      const auto p = chord_corner(surface, A + B - at(a - sign_u, b - sign_v), A, B, chord_);
      state = Node::lost;
      if (!p) continue;
      state = Node::folded;
      if ((*p - A).cross(*p - B).norm() < least_sine * chord_ * chord_) continue;
      state = Node::known;
      points_[index(a, b)] = *p;
      here = depth(a, b, least);
    }
  }
}

void ChordGrid::join_inside(const NetPose& pose) {
  inside_.assign(points_.size(), 0);
  std::vector<std::array<int, 2>> open{{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    if (node(i, j) != Node::known || inside(i, j) || !(pose.outside(at(i, j)) < 0)) continue;
    inside_[index(i, j)] = 1;
    for (const auto& next : {std::array{i + 1, j}, {i - 1, j}, {i, j + 1}, {i, j - 1}})
      open.push_back(next);
  }
}

Result<SurfaceNet> SurfaceNet::make(const Surface& surface, const NetPose& pose, double chord_mm,
                                    PartialNet* so_far) {
  TRY(coarse, ChordGrid::make(surface, pose, chord_mm, coarse_margin, most_nodes));
  TRY(fine, ChordGrid::make(surface, pose, chord_mm / 2, 2 * coarse_margin, 2 * most_nodes));
  std::vector<Eigen::Vector3d> points;
  for (int j = coarse->first_v(); j <= coarse->last_v(); ++j)
    for (int i = coarse->first_u(); i <= coarse->last_u(); ++i) {
      const bool known = coarse->node(i, j) == ChordGrid::Node::known;
      if (known && fine->node(2 * i, 2 * j) == ChordGrid::Node::known) {
        points.push_back(richardson(fine->at(2 * i, 2 * j), coarse->at(i, j)));
        continue;
      }
      points.emplace_back(Eigen::Vector3d::Zero());
      if (known) coarse->forget(i, j);
    }
  SurfaceNet net(std::move(*coarse), std::move(points));
  TRY_DO(net.check_whole(so_far));
  return net;
}

bool SurfaceNet::known_about(int i, int j) const {
  for (int b = j + 1 - reach; b <= j + reach; ++b)
    for (int a = i + 1 - reach; a <= i + reach; ++a)
      if (grid_.node(a, b) != ChordGrid::Node::known) return false;
  return true;
}

void SurfaceNet::report_to(PartialNet& so_far) const {
  constexpr int every = 4;
  constexpr double narrow = 0.3;  // sine
  const auto here = [&](int i, int j) {
    return inside(i, j) && grid_.node(i, j) == ChordGrid::Node::known;
  };
  std::vector<Eigen::Vector3d> line, close;
  const auto end_line = [&] {
    if (line.size() > 1)
      so_far.lines.push_back(
          Eigen::Map<const Eigen::Matrix3Xd>(line.front().data(), 3, Eigen::Index(line.size())));
    line.clear();
  };
  const auto go = [&](int i, int j) {
    if (here(i, j))
      line.push_back(point(i, j));
    else
      end_line();
  };
  for (int j = first_v(); j <= last_v(); ++j, end_line())
    for (int i = first_u(); i <= last_u() && j % every == 0; ++i) go(i, j);
  for (int i = first_u(); i <= last_u(); ++i, end_line())
    for (int j = first_v(); j <= last_v() && i % every == 0; ++j) go(i, j);
  for (int j = first_v() + 1; j <= last_v(); ++j)
    for (int i = first_u() + 1; i <= last_u(); ++i) {
      if (!here(i, j) || !here(i - 1, j) || !here(i, j - 1)) continue;
      const Eigen::Vector3d a = (point(i, j) - point(i - 1, j)).normalized(),
                            b = (point(i, j) - point(i, j - 1)).normalized();
      if (a.cross(b).norm() < narrow) close.push_back(point(i, j));
    }
  so_far.narrow.resize(3, Eigen::Index(close.size()));
  for (std::size_t k = 0; k < close.size(); ++k) so_far.narrow.col(Eigen::Index(k)) = close[k];
}

/// Checks that all nodes exist that interpolation around a used node needs.
Result<void> SurfaceNet::check_whole(PartialNet* so_far) const {
  for (int j = first_v(); j <= last_v(); ++j)
    for (int i = first_u(); i <= last_u(); ++i) {
      if (!inside(i, j)) continue;
      for (int b = j - reach; b <= j + reach; ++b)
        for (int a = i - reach; a <= i + reach; ++a) {
          if (grid_.node(a, b) == ChordGrid::Node::known) continue;
          // past the end of an axis the reason is that of its last node
          const auto node =
              grid_.node(std::clamp(a, first_u(), last_u()), std::clamp(b, first_v(), last_v()));
          const Eigen::Vector3d& p = point(i, j);
          if (so_far) {
            report_to(*so_far);
            so_far->end = p;
          }
          const char* why =
              node == ChordGrid::Node::folded ? "the net folds, its rods become "
                                                "parallel,"
              : node == ChordGrid::Node::lost
                  ? "the surface ends, or bends too sharply for the net,"
                  : "the boundary comes back towards the net's axes, past their ends,";
          return invalid(
              "{} near ({:.4g}, {:.4g}, {:.4g}) mm, (u, v) = ({:.4g}, {:.4g}) mm, inside "
              "the boundary or next to it{}",
              why, p.x(), p.y(), p.z(), i * chord(), j * chord(), help());
        }
    }
  return {};
}

Result<NetPoint> SurfaceNet::at(double u, double v) const {
  const double H = chord();
  const int i = int(std::floor(u / H)), j = int(std::floor(v / H));
  if (!(std::abs(u) < most_nodes * H && std::abs(v) < most_nodes * H) || !known_about(i, j))
    return ended_before(u, v);
  NetNodes nodes;
  for (int b = 0; b < 2 * reach; ++b)
    for (int a = 0; a < 2 * reach; ++a)
      nodes[std::size_t(b * 2 * reach + a)] = point(i + 1 - reach + a, j + 1 - reach + b);
  return net_point(nodes, u / H - i, v / H - j, H);
}

}  // namespace gridshell
