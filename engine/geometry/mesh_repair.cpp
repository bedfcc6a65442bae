#include "engine/geometry/mesh_repair.h"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>

#include "engine/core/algorithms.h"
#include "engine/core/point_grid.h"
#include "engine/geometry/mesh_lines.h"
#include "engine/geometry/surface.h"
#include "engine/geometry/triangles.h"

namespace gridshell {
namespace {

using Triangle = std::array<int, 3>;
using Triangles = std::vector<Triangle>;

constexpr double equal_vertices = 1e-5;  // distance of equal vertices, over the mesh's size
constexpr double no_area = 1e-9;         // area over the square of the longest edge
constexpr double folded_cos = 0.87;      // cosine between the directions from an edge: 30 degrees
constexpr double least_up = 0.05;        // least z of a unit normal that faces up
constexpr double farthest = 0.03;        // largest displacement of a vertex, over the mesh's size

double size_of(const Eigen::Matrix3Xd& x) {
  return (x.rowwise().maxCoeff() - x.rowwise().minCoeff()).maxCoeff();
}

double total_area(const Eigen::Matrix3Xd& x, const Triangles& all) {
  return std::accumulate(all.begin(), all.end(), 0.0,
                         [&](double sum, const Triangle& t) { return sum + area_of(x, t).norm(); });
}

int next(int k) { return (k + 1) % 3; }

std::string counted(std::size_t count, const char* one, const char* more) {
  return fmt::format("{} {}", count, count == 1 ? one : more);
}

/// Replaces vertices at the position of an earlier one by it. Returns their number.
std::size_t join_near(const Eigen::Matrix3Xd& x, Triangles& triangles) {
  const double near = equal_vertices * size_of(x);
  PointGrid grid(std::max(near, 1e-300));
  std::vector<int> now(std::size_t(x.cols()));
  std::size_t joined = 0;
  for (int k = 0; k < int(x.cols()); ++k) {
    now[std::size_t(k)] = k;
    const bool is_joined = grid.any_near(x.col(k), [&](int other) {
      if ((x.col(other) - x.col(k)).norm() > near) return false;
      now[std::size_t(k)] = other;
      return true;
    });
    if (is_joined) ++joined;
    if (!is_joined) grid.add(k, x.col(k));
  }
  for (Triangle& triangle : triangles)
    for (int& corner : triangle) corner = now[std::size_t(corner)];
  return joined;
}

/// The longest side of a triangle without area; -1: the triangle has an area.
int flat_side(const Eigen::Matrix3Xd& x, const Triangle& t) {
  int longest = 0;
  std::array<double, 3> length{};
  for (int k = 0; k < 3; ++k) {
    const auto [a, b] = edge_of(t, k);
    length[std::size_t(k)] = (x.col(b) - x.col(a)).norm();
    if (length[std::size_t(k)] > length[std::size_t(longest)]) longest = k;
  }
  const double most = length[std::size_t(longest)];
  return area_of(x, t).norm() > no_area * most * most ? -1 : longest;
}

/// Removes triangles without area and repeated triangles. Returns their number.
std::size_t drop_needless(const Eigen::Matrix3Xd& x, Triangles& triangles) {
  const std::size_t before = triangles.size();
  const auto is_point = [](const Triangle& t) {
    return t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  };
  std::erase_if(triangles, is_point);
  std::map<MeshEdge, int> count;
  for (const Triangle& t : triangles)
    for (int k = 0; k < 3; ++k) ++count[edge_of(t, k)];
  // a triangle without area has a corner on its longest side: if others are connected to its short
  // sides, the neighbour at the longest side is divided at that corner
  std::map<MeshEdge, int> divided;
  std::erase_if(triangles, [&](const Triangle& t) {
    const int side = flat_side(x, t);
    if (side < 0) return false;
    if (count[edge_of(t, next(side))] > 1 || count[edge_of(t, next(next(side)))] > 1)
      divided[edge_of(t, side)] = t[std::size_t(next(next(side)))];
    return true;
  });
  std::size_t added = 0;
  for (std::size_t n = 0; n < triangles.size(); ++n)
    for (int k = 0; k < 3; ++k) {
      const auto found = divided.find(edge_of(triangles[n], k));
      if (found == divided.end()) continue;
      Triangle other = triangles[n];
      triangles[n][std::size_t(next(k))] = other[std::size_t(k)] = found->second;
      triangles.push_back(other);
      ++added;
      break;
    }
  std::set<Triangle> seen;
  std::erase_if(triangles, [&](Triangle t) {
    std::ranges::sort(t);
    return !seen.insert(t).second;
  });
  return before + added - triangles.size();
}

/// A connection of two triangles at one side of each.
struct Link {
  int first, first_side, second, second_side;
};

/// Unit vector perpendicular to a side, from it into the triangle.
Eigen::Vector3d edge_from(const Eigen::Matrix3Xd& x, const Triangle& t, int side) {
  const auto [a, b] = edge_of(t, side);
  const Eigen::Vector3d along = (x.col(b) - x.col(a)).normalized(),
                        to = x.col(t[std::size_t(next(next(side)))]) - x.col(a);
  return (to - to.dot(along) * along).normalized();
}

/// Cosine of the angle between two triangles (triangle, side) at a common edge: -1 if they are in
/// one plane, 1 if they are folded onto one another.
double turn_between(const Eigen::Matrix3Xd& x, const Triangles& triangles,
                    const std::array<int, 2>& a, const std::array<int, 2>& b) {
  return edge_from(x, triangles[std::size_t(a[0])], a[1])
      .dot(edge_from(x, triangles[std::size_t(b[0])], b[1]));
}

struct Sides {
  std::vector<Link> links;
  std::size_t of_several = 0, open = 0;  // numbers of edges with more than two triangles, with one
};

/// Finds the triangles that are connected at their sides.
Sides joined_sides(const Eigen::Matrix3Xd& x, const Triangles& triangles) {
  std::map<MeshEdge, std::vector<std::array<int, 2>>> sides;
  for (int t = 0; t < int(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) sides[edge_of(triangles[std::size_t(t)], k)].push_back({t, k});
  Sides all;
  for (const auto& [edge, at] : sides) {
    if (at.size() < 2) ++all.open;
    if (at.size() > 2) ++all.of_several;
    double straightest = folded_cos;
    std::optional<Link> best;
    for (std::size_t m = 0; m < at.size(); ++m)
      for (std::size_t n = 0; n < m; ++n) {
        const double turn = turn_between(x, triangles, at[m], at[n]);
        if (turn >= straightest) continue;
        straightest = turn;
        best = Link{at[n][0], at[n][1], at[m][0], at[m][1]};
      }
    if (best) all.links.push_back(*best);
  }
  return all;
}

/// Divides each vertex into one for each group of connected triangles around it. Returns the old
/// index of each new vertex.
std::vector<int> part(Eigen::Matrix3Xd& x, Triangles& triangles, const std::vector<Link>& links) {
  UnionFind corners(3 * triangles.size());
  const auto corner_at = [&](int t, int vertex) {
    const auto& all = triangles[std::size_t(t)];
    return 3 * t + int(std::ranges::find(all, vertex) - all.begin());
  };
  for (const Link& link : links)
    for (const int vertex : edge_of(triangles[std::size_t(link.first)], link.first_side))
      corners.join(corner_at(link.first, vertex), corner_at(link.second, vertex));
  std::map<int, int> number;
  std::vector<int> from;
  for (int t = 0; t < int(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      int& vertex = triangles[std::size_t(t)][std::size_t(k)];
      const auto [found, fresh] = number.try_emplace(corners.find(3 * t + k), int(from.size()));
      if (fresh) from.push_back(vertex);
      vertex = found->second;
    }
  x = Eigen::Matrix3Xd(x(Eigen::all, from));
  return from;
}

/// Moves vertices that were divided a little away from each other, each into its own triangles.
void draw_apart(Eigen::Matrix3Xd& x, const Triangles& triangles, const std::vector<int>& from) {
  constexpr double inwards = 1e-3;  // fraction of the distance to the middle of its triangles
  std::map<int, std::vector<int>> of;
  for (int t = 0; t < int(triangles.size()); ++t)
    for (const int vertex : triangles[std::size_t(t)]) of[vertex].push_back(t);
  std::map<int, int> now;
  for (const auto& [vertex, around] : of) ++now[from[std::size_t(vertex)]];
  const Eigen::Matrix3Xd old = x;
  for (const auto& [vertex, around] : of) {
    if (now[from[std::size_t(vertex)]] < 2) continue;
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const int t : around)
      for (const int corner : triangles[std::size_t(t)])
        middle += old.col(corner) / double(3 * around.size());
    x.col(vertex) += inwards * (middle - old.col(vertex));
  }
}

/// Removes all pieces but the one with the largest area. Returns the number of pieces, and the
/// fraction of the area that was removed.
std::pair<std::size_t, double> keep_largest(const Eigen::Matrix3Xd& x, Triangles& triangles,
                                            const std::vector<Link>& links) {
  UnionFind pieces(triangles.size());
  for (const Link& link : links) pieces.join(link.first, link.second);
  std::map<int, double> areas;
  double whole = 0;
  for (int t = 0; t < int(triangles.size()); ++t) {
    const double area = area_of(x, triangles[std::size_t(t)]).norm();
    areas[pieces.find(t)] += area;
    whole += area;
  }
  const auto largest =
      std::ranges::max_element(areas, {}, [](const auto& piece) { return piece.second; });
  Triangles kept;
  for (int t = 0; t < int(triangles.size()); ++t)
    if (pieces.find(t) == largest->first) kept.push_back(triangles[std::size_t(t)]);
  triangles = std::move(kept);
  return {areas.size(), 1 - largest->second / whole};
}

/// Orients the triangles of a closed piece consistently and removes those that do not face up.
void keep_upper(const Eigen::Matrix3Xd& x, Triangles& triangles, const std::vector<Link>& links) {
  std::vector<std::vector<Link>> around(triangles.size());
  for (const Link& link : links)
    for (const int t : {link.first, link.second}) around[std::size_t(t)].push_back(link);
  std::vector<char> done(triangles.size(), 0);
  std::vector<int> open{0};
  done[0] = 1;
  const auto runs = [&](int t, const MeshEdge& edge) {
    const Triangle& all = triangles[std::size_t(t)];
    const auto at = std::size_t(std::ranges::find(all, edge[0]) - all.begin());
    return all[(at + 1) % 3] == edge[1];
  };
  while (!open.empty()) {
    const int here = open.back();
    open.pop_back();
    for (const Link& link : around[std::size_t(here)]) {
      const int there = link.first == here ? link.second : link.first;
      if (done[std::size_t(there)]) continue;
      Triangle& other = triangles[std::size_t(there)];
      // compare edges, not numbers of sides: these change when a triangle is turned
      for (int k = 0; k < 3; ++k) {
        const MeshEdge edge = edge_of(triangles[std::size_t(here)], k);
        if (std::ranges::find(other, edge[0]) == other.end() ||
            std::ranges::find(other, edge[1]) == other.end())
          continue;
        if (runs(here, edge) == runs(there, edge)) std::swap(other[1], other[2]);
        break;
      }
      done[std::size_t(there)] = 1;
      open.push_back(there);
    }
  }
  double volume = 0;
  const Eigen::Vector3d middle = x.rowwise().mean();
  for (const Triangle& t : triangles)
    volume += area_of(x, t).dot(Eigen::Vector3d(x.col(t[0])) - middle);
  const double outwards = volume < 0 ? -1 : 1;
  std::erase_if(triangles, [&](const Triangle& t) {
    const Eigen::Vector3d area = area_of(x, t);
    return !(outwards * area.z() > least_up * area.norm());
  });
}

/// Moves vertices where triangles are folded onto one another or cross to the mean of their
/// neighbours. Returns their number and their largest displacement; if that does not help, nothing
/// is moved.
std::pair<std::size_t, double> unfold(Eigen::Matrix3Xd& x, const Triangles& triangles) {
  constexpr int most_rounds = 40;
  const double most = farthest * size_of(x);
  std::map<MeshEdge, std::vector<std::array<int, 2>>> sides;
  std::vector<std::set<int>> around(std::size_t(x.cols()));
  for (int t = 0; t < int(triangles.size()); ++t)
    for (int k = 0; k < 3; ++k) {
      const MeshEdge edge = edge_of(triangles[std::size_t(t)], k);
      sides[edge].push_back({t, k});
      around[std::size_t(edge[0])].insert(edge[1]);
      around[std::size_t(edge[1])].insert(edge[0]);
    }
  double mean_edge = 0;
  for (const auto& [edge, at] : sides)
    mean_edge += (x.col(edge[0]) - x.col(edge[1])).norm() / double(sides.size());
  const Eigen::Matrix3Xd before = x;
  for (int round = 0; round < most_rounds; ++round) {
    std::set<int> wrong;
    for (const auto& [edge, at] : sides) {
      if (at.size() != 2) continue;
      const double turn = turn_between(x, triangles, at[0], at[1]);
      if (turn < folded_cos - 0.05) continue;
      wrong.insert(edge.begin(), edge.end());
      for (const auto& [t, k] : at)
        wrong.insert(triangles[std::size_t(t)][std::size_t(next(next(k)))]);
    }
    // without folds: the vertices around a crossing of the mesh with itself
    if (wrong.empty())
      if (const auto crossing = first_crossing(x, triangles, mean_edge); crossing && *crossing)
        for (int k = 0; k < int(x.cols()); ++k)
          if ((x.col(k) - **crossing).norm() < 1.5 * mean_edge && !around[std::size_t(k)].empty())
            wrong.insert(k);
    if (wrong.empty()) {
      const Eigen::RowVectorXd moved = (x - before).colwise().norm();
      return {std::size_t((moved.array() > 0).count()), moved.maxCoeff()};
    }
    const Eigen::Matrix3Xd old = x;
    for (const int vertex : wrong) {
      Eigen::Vector3d mean = Eigen::Vector3d::Zero();
      for (const int other : around[std::size_t(vertex)])
        mean += old.col(other) / double(around[std::size_t(vertex)].size());
      x.col(vertex) = 0.5 * (mean + old.col(vertex));
    }
    if ((x - before).colwise().norm().maxCoeff() > most) break;
  }
  x = before;
  return {0, 0};
}

}  // namespace

MendedMesh mended(const Eigen::Matrix3Xd& vertices, std::vector<std::array<int, 3>> triangles) {
  MendedMesh mesh{vertices, std::move(triangles), {}};
  auto& [x, all, done] = mesh;
  if (const auto joined = join_near(x, all); joined > 0)
    done.push_back(counted(joined, "vertex at the position of another is joined to it",
                           "vertices at the positions of others are joined to these"));
  if (const auto dropped = drop_needless(x, all); dropped > 0)
    done.push_back(counted(dropped, "triangle without area, or there twice, is",
                           "triangles without area, or there twice, are") +
                   " left out");
  if (all.empty()) return mesh;
  if (const auto [moved, far] = unfold(x, all); moved > 0)
    done.push_back(
        fmt::format("the mesh is folded onto itself: {} moved, by {:.2g} mm at most, to unfold it",
                    counted(moved, "vertex is", "vertices are"), far));
  const Sides sides = joined_sides(x, all);
  if (sides.of_several > 0)
    done.push_back(counted(sides.of_several, "edge has", "edges have") +
                   " more than two triangles: the two that continue straightest stay joined");
  const auto from = part(x, all, sides.links);
  const auto [pieces, left_out] = keep_largest(x, all, sides.links);
  draw_apart(x, all, from);
  if (joined_sides(x, all).open == 0) {
    const double area = total_area(x, all);
    keep_upper(x, all, joined_sides(x, all).links);
    if (all.empty()) return mesh;
    const auto links = joined_sides(x, all).links;
    const auto parted = part(x, all, links);
    const auto upper = keep_largest(x, all, links);
    draw_apart(x, all, parted);
    const double kept = total_area(x, all);
    done.push_back(fmt::format(
        "the mesh is closed, as of a solid: the {} facing up is taken, {:.1f} % of its area",
        upper.first > 1 ? "largest part" : "part", 100 * kept / area));
  }
  if (pieces > 1)
    done.push_back(
        fmt::format("the mesh is in {} pieces: the largest is taken, {:.1f} % of the "
                    "area is left out with the others",
                    pieces, 100 * left_out));
  if (const auto [moved, far] = unfold(x, all); moved > 0)
    done.push_back(
        fmt::format("the mesh is folded onto itself: {} moved, by {:.2g} mm at most, to unfold it",
                    counted(moved, "vertex is", "vertices are"), far));
  return mesh;
}

}  // namespace gridshell
