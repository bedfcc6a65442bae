#include "engine/geometry/surface_net.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

namespace gridshell {
namespace {

constexpr int reach = 3;          // nodes to each side that a value between two nodes takes
constexpr int coarse_margin = 8;  // of the coarser grid around what is wanted
constexpr int most_nodes = 600;   // from the apex to an end of an axis

/// Lagrange's weights of the nodes -2 ... 3 at t in [0, 1], of the value, its slope and its second
/// derivative by t.
struct Weights {
  std::array<double, 2 * reach> value{}, slope{}, second{};

  explicit Weights(double t) {
    for (int a = 0; a < 2 * reach; ++a) {
      // coefficients by product rule: the polynomial, once and twice derived
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

Result<SurfaceNet> SurfaceNet::make(const Surface& surface, const NetPlace& place, double chord_mm,
                                    NetSoFar* so_far) {
  auto coarse = ChordGrid::make(surface, place, chord_mm, coarse_margin, most_nodes);
  if (!coarse) return tl::unexpected(coarse.error());
  const auto fine =
      ChordGrid::make(surface, place, chord_mm / 2, 2 * coarse_margin, 2 * most_nodes);
  if (!fine) return tl::unexpected(fine.error());
  std::vector<Eigen::Vector3d> points;
  for (int j = coarse->first_v(); j <= coarse->last_v(); ++j)
    for (int i = coarse->first_u(); i <= coarse->last_u(); ++i) {
      const bool known = coarse->node(i, j) == ChordGrid::Node::known;
      if (known && fine->node(2 * i, 2 * j) == ChordGrid::Node::known) {
        points.push_back((4 * fine->at(2 * i, 2 * j) - coarse->at(i, j)) / 3);
        continue;
      }
      points.emplace_back(Eigen::Vector3d::Zero());
      if (known) coarse->forget(i, j);
    }
  SurfaceNet net(std::move(*coarse), std::move(points));
  if (auto whole = net.check_whole(so_far); !whole) return tl::unexpected(whole.error());
  return net;
}

bool SurfaceNet::known_about(int i, int j) const {
  for (int b = j + 1 - reach; b <= j + reach; ++b)
    for (int a = i + 1 - reach; a <= i + reach; ++a)
      if (grid_.node(a, b) != ChordGrid::Node::known) return false;
  return true;
}

void SurfaceNet::tell(NetSoFar& so_far) const {
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

/// Around every node that is wanted there must be all that values near it take.
Result<void> SurfaceNet::check_whole(NetSoFar* so_far) const {
  for (int j = first_v(); j <= last_v(); ++j)
    for (int i = first_u(); i <= last_u(); ++i) {
      if (!inside(i, j)) continue;
      for (int b = j - reach; b <= j + reach; ++b)
        for (int a = i - reach; a <= i + reach; ++a) {
          if (grid_.node(a, b) == ChordGrid::Node::known) continue;
          // beyond the end of an axis the reason is that end's
          const auto node =
              grid_.node(std::clamp(a, first_u(), last_u()), std::clamp(b, first_v(), last_v()));
          const Eigen::Vector3d& p = point(i, j);
          if (so_far) {
            tell(*so_far);
            so_far->end = p;
          }
          const char* why = node == ChordGrid::Node::folded ? "the net folds, its rods become "
                                                              "parallel,"
                            : node == ChordGrid::Node::lost
                                ? "the surface ends, or bends too sharply for the net,"
                                : "the boundary turns back towards the net's axes, beyond their "
                                  "ends,";
          return fail(Fault::bad_input,
                      fmt::format("{} near ({:.4g}, {:.4g}, {:.4g}) mm, (u, v) = ({:.4g}, {:.4g}) "
                                  "mm, inside the boundary or next to it{}",
                                  why, p.x(), p.y(), p.z(), i * chord(), j * chord(), help()));
        }
    }
  return {};
}

Result<NetPoint> SurfaceNet::at(double u, double v) const {
  const double H = chord();
  const int i = int(std::floor(u / H)), j = int(std::floor(v / H));
  if (!(std::abs(u) < most_nodes * H && std::abs(v) < most_nodes * H) || !known_about(i, j))
    return fail(Fault::bad_input,
                fmt::format("the net of the surface ends before (u, v) = ({:g}, {:g}) mm", u, v));
  const Weights along_u(u / H - i), along_v(v / H - j);
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), C_u = position, C_v = position,
                  C_uu = position, C_uv = position, C_vv = position;
  for (std::size_t b = 0; b < 2 * reach; ++b) {
    Eigen::Vector3d value = Eigen::Vector3d::Zero(), slope = value, second = value;
    for (std::size_t a = 0; a < 2 * reach; ++a) {
      const Eigen::Vector3d& p = point(i + 1 - reach + int(a), j + 1 - reach + int(b));
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
  // second form over first form
  const Eigen::Vector3d normal = across.normalized();
  const double M = normal.dot(C_uv);
  found.K = (normal.dot(C_uu) * normal.dot(C_vv) - M * M) / across.squaredNorm();
  return found;
}

}  // namespace gridshell
