#include "engine/geometry/marched_net.h"

#include <Eigen/Geometry>
#include <cmath>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/point_grid.h"
#include "engine/core/try.h"

namespace gridshell {
namespace {

RodStop stop_at(LineKind line) {
  switch (line) {
    case LineKind::rim:
      return RodStop::rim;
    case LineKind::hole:
      return RodStop::hole;
    case LineKind::crease:
      break;
  }
  return RodStop::crease;
}

int sign(int k) { return (k > 0) - (k < 0); }

double acute_angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  const double angle = angle_between(a, b);
  return std::min(angle, M_PI - angle);
}

}  // namespace

std::string text_of(RodStop stop) {
  switch (stop) {
    case RodStop::none:
      return "a region that no rod reaches";
    case RodStop::rim:
      return "the surface's rim";
    case RodStop::hole:
      return "a hole";
    case RodStop::crease:
      return "a crease";
    case RodStop::cut:
      return "the boundary of [net] cut_mm or within";
    case RodStop::angle:
      return "rods too close to parallel ([net] least_angle_deg)";
    case RodStop::surface:
      return "the surface bends too sharply";
    case RodStop::net:
      break;
  }
  return "another part of the net is there already";
}

MarchedGrid::MarchedGrid(double chord, int most) : chord_(chord), most_(most) {
  nodes_.resize(std::size_t(2 * most + 1) * std::size_t(2 * most + 1));
}

/// Computes the nodes of a grid outwards, in the order of |i| + |j|.
struct MarchedGrid::March {
  MarchedGrid& grid;
  const Surface& surface;
  const NetPose& pose;
  const Barriers* lines;    // lines of the mesh; null if `lead` is given
  const MarchedGrid* lead;  // grid of twice the chord that this one follows; or null
  double least_angle = 0;
  int margin = 0;  // nodes outside rims
  PointGrid taken{grid.chord_};
  std::vector<std::array<int, 2>> accepted{};  // (i, j) of the nodes in `taken`, by their numbers

  /// Whether the net already covers p with nodes that are not around (i, j). Almost every point of
  /// a net has a node within 0.75 chords. Nodes three steps away along the short diagonal are at
  /// least 6 sin(angle / 2) chords away, so a smaller distance is used if the least angle is small.
  bool is_taken(int i, int j, const Eigen::Vector3d& p) const {
    const double as_near = std::min(0.75, 4 * std::sin(0.5 * least_angle));
    return taken.any_near(p, [&](int k) {
      const auto [a, b] = accepted[std::size_t(k)];
      return std::max(std::abs(a - i), std::abs(b - j)) > 2 &&
             (grid.at(a, b).p - p).norm() < as_near * grid.chord_;
    });
  }

  RodStop stop_between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
    const auto line = lines->crossed(from, to);
    return line ? stop_at(*line) : RodStop::none;
  }

  void accept(int i, int j, const Eigen::Vector3d& p, bool by_u, bool by_v, int past_rim = 0) {
    Node& node = grid.node(i, j);
    node.p = p;
    node.known = past_rim == 0;
    node.past_rim = char(past_rim);
    node.by = by_u && by_v ? Node::corner : by_u ? Node::straight_u : Node::straight_v;
    Node &to_u = grid.node(std::min(i, i - sign(i)), j),
         &to_v = grid.node(i, std::min(j, j - sign(j)));
    if (by_u) to_u.on_u = true, to_u.to_u = node.known;
    if (by_v) to_v.on_v = true, to_v.to_v = node.known;
    if (!lines || !node.known) return;
    taken.add(int(accepted.size()), p);
    accepted.push_back({i, j});
  }

  /// The next point on the geodesic continuation of the rod through (a, b), away from the axes.
  std::optional<Eigen::Vector3d> straight(int a, int b, int step_u, int step_v) const {
    const Eigen::Vector3d& here = grid.at(a, b).p;
    if (a == 0 && b == 0)
      return geodesic_chord(
          surface, here, step_u != 0 ? step_u * pose.along_u : step_v * pose.up.cross(pose.along_u),
          grid.chord_);
    if (!grid.linked(a, b, -step_u, -step_v)) return std::nullopt;
    const Eigen::Vector3d last = (here - grid.at(a - step_u, b - step_v).p).normalized();
    Eigen::Vector3d along = last;
    // a rod that was no geodesic continues along its tangent at (a, b), extrapolated from the last
    // two chords, whose middles are half a chord and 1.5 chords away
    const auto by = grid.at(a, b).by;
    const bool bent = by != (step_u != 0 ? Node::straight_u : Node::straight_v);
    if (bent && grid.linked(a - step_u, b - step_v, -step_u, -step_v))
      along =
          (1.5 * last -
           0.5 * (grid.at(a - step_u, b - step_v).p - grid.at(a - 2 * step_u, b - 2 * step_v).p) /
               grid.chord_)
              .normalized();
    return geodesic_chord(surface, here, along, grid.chord_);
  }

  /// Computes a node as the geodesic continuation from its neighbour towards the axis. Returns the
  /// reason if that is not possible.
  RodStop go_straight(int i, int j, int step_u, int step_v) {
    const int a = i - step_u, b = j - step_v;
    const auto p = straight(a, b, step_u, step_v);
    if (!p) return RodStop::surface;
    if (lines) {
      const Eigen::Vector3d& here = grid.at(a, b).p;
      if (const RodStop stop = stop_between(here, *p); stop != RodStop::none) return stop;
      if (!(pose.outside(*p) < 0)) return RodStop::cut;
      if (is_taken(i, j, *p)) return RodStop::net;
    }
    accept(i, j, *p, step_u != 0, step_v != 0);
    return RodStop::none;
  }

  /// Whether the three other corners of the cell between (i, j) and the axes are connected: by
  /// rods, or, if not `rods`, also by continuations of rods.
  bool has_cell(int i, int j, bool rods) const {
    const int a = i - sign(i), b = j - sign(j);
    const auto to = [&](int step_u, int step_v) {
      return rods ? grid.joined(a, b, step_u, step_v) : grid.linked(a, b, step_u, step_v);
    };
    return i != 0 && j != 0 && to(0, sign(j)) && to(sign(i), 0);
  }

  std::optional<Eigen::Vector3d> corner(int i, int j, int su, int sv) const {
    const Eigen::Vector3d &A = grid.at(i - su, j).p, &B = grid.at(i, j - sv).p;
    return chord_corner(surface, A + B - grid.at(i - su, j - sv).p, A, B, grid.chord_);
  }

  RodStop march_to(int i, int j) {
    const int su = sign(i), sv = sign(j);
    const bool by_u = su != 0 && grid.known(i - su, j), by_v = sv != 0 && grid.known(i, j - sv);
    bool try_u = by_u, try_v = by_v;
    RodStop stop = RodStop::none;
    if (has_cell(i, j, true)) {
      const auto p = corner(i, j, su, sv);
      if (!p) return RodStop::surface;
      const Eigen::Vector3d &A = grid.at(i - su, j).p, &B = grid.at(i, j - sv).p;
      if (acute_angle(*p - A, *p - B) < least_angle) return RodStop::angle;
      const RodStop from_u = stop_between(A, *p), from_v = stop_between(B, *p);
      stop = from_u != RodStop::none ? from_u : from_v;
      if (stop == RodStop::none && !(pose.outside(*p) < 0)) return RodStop::cut;
      if (stop == RodStop::none && is_taken(i, j, *p)) return RodStop::net;
      if (stop == RodStop::none) {
        accept(i, j, *p, true, true);
        return RodStop::none;
      }
      try_u = from_u == RodStop::none, try_v = from_v == RodStop::none;
    }
    // next to a rod that ended because of its angle other rods do not continue
    if (try_u && sv != 0 && grid.at(i, j - sv).stop == RodStop::angle) return RodStop::angle;
    if (try_v && su != 0 && grid.at(i - su, j).stop == RodStop::angle) return RodStop::angle;
    if (try_u && (stop = go_straight(i, j, su, 0)) == RodStop::none) return stop;
    if (try_v && (stop = go_straight(i, j, 0, sv)) == RodStop::none) return stop;
    return stop;
  }

  /// Computes a node outside a rim from its neighbours towards the axes.
  void extend_past_rim(int i, int j) {
    constexpr double least_sine = 0.12;
    const int su = sign(i), sv = sign(j);
    const auto& A = grid.at(i - su, j);
    const auto& B = grid.at(i, j - sv);
    const bool by_u = su != 0 && grid.present(i - su, j), by_v = sv != 0 && grid.present(i, j - sv);
    const int past_rim = 1 + std::min(by_u ? A.past_rim : margin, by_v ? B.past_rim : margin);
    if (past_rim > margin) return;
    if (has_cell(i, j, false)) {
      const auto p = corner(i, j, su, sv);
      if (p && (*p - A.p).cross(*p - B.p).norm() > least_sine * grid.chord_ * grid.chord_)
        accept(i, j, *p, true, true, past_rim);
      return;
    }
    for (const bool along_u : {true, false}) {
      if (!(along_u ? by_u : by_v)) continue;
      const int step_u = along_u ? su : 0, step_v = along_u ? 0 : sv;
      if (const auto p = straight(i - step_u, j - step_v, step_u, step_v))
        return accept(i, j, *p, along_u, !along_u, past_rim);
    }
  }

  /// Computes a node of a grid that follows `lead`.
  void follow_to(int i, int j) {
    const int su = sign(i), sv = sign(j);
    // geodesic where the node of `lead` is one
    const bool on_u = j % 2 == 0, on_v = i % 2 == 0;
    const auto& next_u = lead->at((i + (on_v ? 0 : su)) / 2, j / 2);
    const auto& next_v = lead->at(i / 2, (j + (on_u ? 0 : sv)) / 2);
    const auto is = [](const Node& node, auto by) {
      return (node.known || node.past_rim > 0) && node.by == by;
    };
    if (su != 0 && on_u && is(next_u, Node::straight_u)) {
      if (grid.known(i - su, j)) go_straight(i, j, su, 0);
      return;
    }
    if (sv != 0 && on_v && is(next_v, Node::straight_v)) {
      if (grid.known(i, j - sv)) go_straight(i, j, 0, sv);
      return;
    }
    if (on_u && on_v && !lead->present(i / 2, j / 2)) return;
    if (!has_cell(i, j, false)) return;
    if (const auto p = corner(i, j, su, sv)) accept(i, j, *p, true, true);
  }

  void run() {
    grid.node(0, 0).p = pose.apex;
    grid.node(0, 0).known = true;
    bool any = true;
    for (int far = 1; any && far <= grid.most_; ++far) {
      any = false;
      for (int i = -far; i <= far; ++i)
        for (const int j : {far - std::abs(i), std::abs(i) - far}) {
          const int su = sign(i), sv = sign(j);
          const bool rods =
              (su != 0 && grid.known(i - su, j)) || (sv != 0 && grid.known(i, j - sv));
          if (lead && rods) follow_to(i, j);
          if (!lead && rods) grid.node(i, j).stop = march_to(i, j);
          const RodStop stop = grid.at(i, j).stop;
          const bool ends =
              !rods || stop == RodStop::rim || stop == RodStop::hole || stop == RodStop::cut;
          if (margin > 0 && !grid.known(i, j) && ends &&
              ((su != 0 && grid.present(i - su, j)) || (sv != 0 && grid.present(i, j - sv))))
            extend_past_rim(i, j);
          any = any || grid.present(i, j);
          if (j == 0) break;
        }
    }
  }
};

MarchedGrid::MarchedGrid(const Surface& surface, const NetPose& pose, const Barriers& lines,
                         double least_angle, double chord, int most, int margin)
    : MarchedGrid(chord, most) {
  March{*this, surface, pose, &lines, nullptr, least_angle, margin}.run();
}

MarchedGrid::MarchedGrid(const Surface& surface, const NetPose& pose, const MarchedGrid& lead)
    : MarchedGrid(lead.chord_ / 2, 2 * lead.most_) {
  March{*this, surface, pose, nullptr, &lead}.run();
}

Result<MarchedNet> MarchedNet::make(const Surface& surface, const NetPose& pose,
                                    std::shared_ptr<const Barriers> lines, double least_angle,
                                    double chord_mm, int most) {
  MarchedGrid grid(surface, pose, *lines, least_angle, chord_mm, most, net_reach);
  const MarchedGrid fine(surface, pose, grid);
  double narrowest = M_PI_2;
  grid.each_present([&](int i, int j) {
    MarchedGrid::Node& node = grid.node(i, j);
    const auto& at = fine.at(2 * i, 2 * j);
    if (grid.known(i - 1, j) && grid.known(i, j - 1) && grid.joined(i, j, -1, 0) &&
        grid.joined(i, j, 0, -1) && at.known)
      narrowest = std::min(narrowest, acute_angle(at.p - fine.at(2 * i - 1, 2 * j).p,
                                                  at.p - fine.at(2 * i, 2 * j - 1).p));
    if (at.known) return;
    if (node.known) node.stop = RodStop::surface;
    node.known = node.to_u = node.to_v = node.on_u = node.on_v = false;
    node.past_rim = 0;
    if (i > -most) grid.node(i - 1, j).to_u = grid.node(i - 1, j).on_u = false;
    if (j > -most) grid.node(i, j - 1).to_v = grid.node(i, j - 1).on_v = false;
  });
  bool any = false;
  grid.each_present([&](int i, int j) {
    any = any || (grid.known(i, j) && (i != 0 || j != 0));
    grid.node(i, j).p = richardson(fine.at(2 * i, 2 * j).p, grid.at(i, j).p);
  });
  if (!any)
    return invalid("no rod leaves the apex ({:.4g}, {:.4g}, {:.4g}) mm: {}", pose.apex.x(),
                   pose.apex.y(), pose.apex.z(), text_of(grid.at(1, 0).stop));
  MarchedNet net(std::move(grid), std::move(lines), pose.outside);
  net.least_angle_ = narrowest;
  return net;
}

bool MarchedNet::joined(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double length_mm,
                        double off) const {
  return std::abs((q - p).norm() - length_mm) <= off * length_mm + 1e-6 * chord() &&
         !lines_->crossed(p, q);
}

/// The net at a position in a cell next to node (i, j), from the nodes that are connected to it.
std::optional<NetPoint> MarchedNet::from(int i, int j, double u, double v) const {
  constexpr int width = 2 * net_reach;
  const double h = chord();
  const int first_i = int(std::floor(u / h)) + 1 - net_reach,
            first_j = int(std::floor(v / h)) + 1 - net_reach;
  NetNodes nodes;
  std::array<bool, width * width> have{};
  const auto index = [&](int a, int b) { return std::size_t(b * width + a); };
  const auto within = [](int a, int b) { return a >= 0 && a < width && b >= 0 && b < width; };
  // nodes that are connected to (i, j)
  std::array<std::array<int, 2>, width * width> open;
  std::size_t count = 0;
  const auto take = [&](int a, int b) {
    nodes[index(a, b)] = grid_.at(first_i + a, first_j + b).p;
    have[index(a, b)] = true;
    open[count++] = {a, b};
  };
  take(i - first_i, j - first_j);
  constexpr std::array<std::array<int, 2>, 4> neighbours{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  for (std::size_t k = 0; k < count; ++k) {
    const auto [a, b] = open[k];
    for (const auto& [da, db] : neighbours)
      if (within(a + da, b + db) && !have[index(a + da, b + db)] &&
          grid_.linked(first_i + a, first_j + b, da, db))
        take(a + da, b + db);
  }
  if (count < 3) return std::nullopt;
  // the other nodes are extrapolated by polynomials of degree up to 3, the nearest first
  while (count < have.size()) {
    const auto before = have;
    const std::size_t so_far = count;
    for (int b = 0; b < width; ++b)
      for (int a = 0; a < width; ++a) {
        if (before[index(a, b)]) continue;
        int degree = -1, times = 0;
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (const auto& [da, db] : neighbours) {
          int known = 0;
          while (known < 4 && within(a + (known + 1) * da, b + (known + 1) * db) &&
                 before[index(a + (known + 1) * da, b + (known + 1) * db)])
            ++known;
          if (known - 1 < degree || known == 0) continue;
          if (known - 1 > degree) sum.setZero(), times = 0;
          degree = known - 1;
          constexpr std::array<std::array<double, 4>, 4> weights{
              {{1, 0, 0, 0}, {2, -1, 0, 0}, {3, -3, 1, 0}, {4, -6, 4, -1}}};
          for (int k = 0; k < known; ++k)
            sum += weights[std::size_t(degree)][std::size_t(k)] *
                   nodes[index(a + (k + 1) * da, b + (k + 1) * db)];
          ++times;
        }
        if (times == 0) continue;
        nodes[index(a, b)] = sum / times;
        have[index(a, b)] = true;
        ++count;
      }
    if (count == so_far) return std::nullopt;
  }
  return net_point(nodes, u / h - std::floor(u / h), v / h - std::floor(v / h), h);
}

std::optional<NetPoint> MarchedNet::reached(double u, double v) const {
  const double h = chord();
  const int i = int(std::floor(u / h)), j = int(std::floor(v / h));
  std::array<std::array<int, 2>, 4> corners{{{i, j}, {i + 1, j}, {i, j + 1}, {i + 1, j + 1}}};
  std::ranges::sort(corners, {},
                    [&](const auto& at) { return std::hypot(u - at[0] * h, v - at[1] * h); });
  for (const auto& [a, b] : corners) {
    if (!grid_.known(a, b)) continue;
    const auto point = from(a, b, u, v);
    if (point && outside_(point->position) < 0 &&
        !lines_->crossed(grid_.at(a, b).p, point->position))
      return point;
  }
  return std::nullopt;
}

Result<NetPoint> MarchedNet::at(double u, double v) const {
  const double h = chord();
  if (std::abs(u) < grid_.most() * h && std::abs(v) < grid_.most() * h) {
    if (const auto point = reached(u, v)) return *point;
    // (u, v) may be on a line of the mesh
    const int i = int(std::lround(u / h)), j = int(std::lround(v / h));
    for (const auto& [a, b] : {std::array{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}})
      if (grid_.known(i + a, j + b) && std::abs(u / h - i - a) <= 1 && std::abs(v / h - j - b) <= 1)
        if (const auto point = from(i + a, j + b, u, v)) return *point;
  }
  return ended_before(u, v);
}

}  // namespace gridshell
