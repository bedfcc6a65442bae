#include "engine/scan/clusters.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "engine/core/union_find.h"

namespace gridshell {
namespace {

constexpr double cells_a_diameter = 3, most_cells = 1e6;  // a side
constexpr double speck_share = 0.25;
constexpr int disc_steps = 30;
constexpr double pull = 1e-3;  // of the mean, where the disc's rim sees no point
constexpr double wide_rim = 1.25, most_beyond = 0.05;  // radii; share of the points beyond them

using Cell = std::array<std::int32_t, 3>;

/// The cell of every point, and all cells once, sorted.
struct Cells {
  std::vector<Cell> all;
  std::vector<int> of_point;
};

Result<Cells> cells_of(const Eigen::Matrix3Xd& cloud, double size) {
  const Eigen::Vector3d low = cloud.rowwise().minCoeff();
  const double extent = (cloud.rowwise().maxCoeff() - low).maxCoeff();
  if (!(extent / size < most_cells))
    return fail(Fault::bad_input,
                fmt::format("the points reach over {:.3g} mm, joints of {:.3g} mm are not to be "
                            "found among them",
                            extent, size * cells_a_diameter));
  Cells cells;
  std::vector<Cell> own;
  for (const auto& p : cloud.colwise()) {
    const Eigen::Vector3d at = (p - low) / size;
    own.push_back({std::int32_t(at.x()), std::int32_t(at.y()), std::int32_t(at.z())});
  }
  cells.all = own;
  std::ranges::sort(cells.all);
  cells.all.erase(std::unique(cells.all.begin(), cells.all.end()), cells.all.end());
  for (const Cell& cell : own)
    cells.of_point.push_back(int(std::ranges::lower_bound(cells.all, cell) - cells.all.begin()));
  return cells;
}

/// The points of every set of cells that touch one another.
std::vector<std::vector<int>> sets_of(const Cells& cells) {
  UnionFind sets(cells.all.size());
  for (std::size_t k = 0; k < cells.all.size(); ++k)
    for (int n = 0; n < 27; ++n) {
      const Cell& cell = cells.all[k];
      const Cell beside{cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1};
      const auto found = std::ranges::lower_bound(cells.all, beside);
      if (found != cells.all.end() && *found == beside)
        sets.join(int(k), int(found - cells.all.begin()));
    }
  std::vector<int> number(cells.all.size(), -1);
  std::vector<std::vector<int>> points;
  for (std::size_t k = 0; k < cells.of_point.size(); ++k) {
    int& set = number[std::size_t(sets.find(cells.of_point[k]))];
    if (set < 0) set = int(points.size()), points.emplace_back();
    points[std::size_t(set)].push_back(int(k));
  }
  return points;
}

/// The middle of the disc of that radius which points of the plane overhang least: the least sum of
/// squares of what lies outside, by Gauss and Newton from their mean.
Eigen::Vector2d disc_around(const Eigen::Matrix2Xd& points, double radius) {
  const Eigen::Vector2d mean = points.rowwise().mean();
  Eigen::Vector2d middle = mean;
  for (int step = 0; step < disc_steps; ++step) {
    Eigen::Matrix2d normal = pull * double(points.cols()) * Eigen::Matrix2d::Identity();
    Eigen::Vector2d slope = pull * double(points.cols()) * (mean - middle);
    for (const auto& p : points.colwise()) {
      const Eigen::Vector2d out = p - middle;
      const double beyond = out.norm() - radius;
      if (beyond <= 0) continue;
      const Eigen::Vector2d way = out.normalized();
      normal += way * way.transpose();
      slope += beyond * way;
    }
    const Eigen::Vector2d move = normal.inverse() * slope;
    middle += move;
    if (move.norm() < 1e-6 * radius) break;
  }
  return middle;
}

Eigen::Matrix3Xd chosen(const Eigen::Matrix3Xd& cloud, const std::vector<int>& points) {
  Eigen::Matrix3Xd some(3, Eigen::Index(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) some.col(Eigen::Index(k)) = cloud.col(points[k]);
  return some;
}

/// The middle of a top, or nothing where its points reach beyond it: two things that touch.
std::optional<Eigen::Vector3d> middle_of(const Eigen::Matrix3Xd& points, double radius) {
  const Eigen::Vector3d mean = points.rowwise().mean();
  if ((points.colwise() - mean).colwise().norm().maxCoeff() > 2 * radius) return std::nullopt;
  if (points.cols() < 3) return mean;
  const Eigen::Matrix3Xd about = points.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(about * about.transpose());
  const Eigen::Matrix<double, 3, 2> plane = axes.eigenvectors().rightCols<2>();
  const Eigen::Vector3d middle = plane * disc_around(plane.transpose() * about, radius);
  const auto off = (about.colwise() - middle).colwise().norm().array().eval();
  const auto beyond = double((off > wide_rim * radius).count());
  if (beyond > most_beyond * double(points.cols())) return std::nullopt;
  return mean + middle;
}

/// How many points the cluster has that the median point is in.
std::size_t usual_size(const std::vector<std::vector<int>>& sets, std::size_t points) {
  std::vector<std::size_t> sizes;
  for (const auto& set : sets) sizes.push_back(set.size());
  std::ranges::sort(sizes);
  std::size_t before = 0;
  for (const std::size_t size : sizes)
    if ((before += size) * 2 >= points) return size;
  return 0;
}

}  // namespace

Result<Clusters> cluster_tops(const Eigen::Matrix3Xd& cloud, double diameter_mm) {
  const auto cells = cells_of(cloud, diameter_mm / cells_a_diameter);
  if (!cells) return tl::unexpected(cells.error());
  const auto sets = sets_of(*cells);
  const auto usual = double(usual_size(sets, std::size_t(cloud.cols())));
  Clusters found;
  std::vector<Eigen::Vector3d> tops;
  for (const auto& set : sets) {
    if (double(set.size()) < speck_share * usual) {
      ++found.specks;
      continue;
    }
    const auto middle = middle_of(chosen(cloud, set), diameter_mm / 2);
    if (!middle) {
      ++found.others;
      continue;
    }
    tops.push_back(*middle);
    found.points.push_back(int(set.size()));
  }
  found.tops.resize(3, Eigen::Index(tops.size()));
  for (std::size_t k = 0; k < tops.size(); ++k) found.tops.col(Eigen::Index(k)) = tops[k];
  return found;
}

}  // namespace gridshell
