#include "engine/study/scan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/footprint/symmetry.h"

namespace gridshell::study {
namespace {

constexpr double cells_a_diameter = 3, most_cells = 1e6;  // along each axis
constexpr double speck_fraction = 0.25;
constexpr int disc_steps = 30;
constexpr double pull = 1e-3;  // weight of the mean, for discs whose rim no point crosses
constexpr double wide_rim = 1.25,
                 most_outside = 0.05;  // radii; fraction of the points outside them

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
    return invalid(
        "the points extend over {:.3g} mm, too far for joints of {:.3g} mm: check --unit", extent,
        size * cells_a_diameter);
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
      const Cell neighbour{cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1};
      const auto found = std::ranges::lower_bound(cells.all, neighbour);
      if (found != cells.all.end() && *found == neighbour)
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

/// The middle of the disc of that radius which the points overhang least: it minimises the sum of
/// the squared distances of points outside the disc from it, by Gauss-Newton steps from their mean.
Eigen::Vector2d disc_around(const Eigen::Matrix2Xd& points, double radius) {
  const Eigen::Vector2d mean = points.rowwise().mean();
  Eigen::Vector2d middle = mean;
  for (int step = 0; step < disc_steps; ++step) {
    Eigen::Matrix2d normal = pull * double(points.cols()) * Eigen::Matrix2d::Identity();
    Eigen::Vector2d slope = pull * double(points.cols()) * (mean - middle);
    for (const auto& p : points.colwise()) {
      const Eigen::Vector2d out = p - middle;
      const double excess = out.norm() - radius;
      if (excess <= 0) continue;
      const Eigen::Vector2d outward = out.normalized();
      normal += outward * outward.transpose();
      slope += excess * outward;
    }
    const Eigen::Vector2d move = solution(normal, slope);
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

/// The middle of a top; `off_plane` gets the rms distance of the points from its plane (unchanged
/// if there are fewer than ten). Empty if the points extend outside a top, as those of two touching
/// objects do.
std::optional<Eigen::Vector3d> middle_of(const Eigen::Matrix3Xd& points, double radius,
                                         double& off_plane) {
  const Eigen::Vector3d mean = points.rowwise().mean();
  if ((points.colwise() - mean).colwise().norm().maxCoeff() > 2 * radius) return std::nullopt;
  if (points.cols() < 3) return mean;
  const Eigen::Matrix3Xd about = points.colwise() - mean;
  const auto axes = eigen_pairs(about * about.transpose());
  constexpr Eigen::Index enough = 10;  // a plane passes through any three points
  if (points.cols() >= enough)
    off_plane = std::sqrt(std::max(0.0, axes.values[0]) / double(points.cols() - 3));
  const Eigen::Matrix<double, 3, 2> plane = axes.vectors.rightCols<2>();
  const Eigen::Vector3d middle = plane * disc_around(plane.transpose() * about, radius);
  const auto off = (about.colwise() - middle).colwise().norm().array().eval();
  const auto outside = double((off > wide_rim * radius).count());
  if (outside > most_outside * double(points.cols())) return std::nullopt;
  return mean + middle;
}

/// Size of the cluster that the median point is in, among clusters of at least eight points if
/// there are any.
std::size_t usual_size(const std::vector<std::vector<int>>& sets) {
  constexpr std::size_t of_a_top = 8;
  std::vector<std::size_t> sizes;
  for (const auto& set : sets) sizes.push_back(set.size());
  std::ranges::sort(sizes);
  if (sizes.empty()) return 0;
  if (sizes.back() >= of_a_top)
    std::erase_if(sizes, [](std::size_t size) { return size < of_a_top; });
  const std::size_t points = std::accumulate(sizes.begin(), sizes.end(), std::size_t(0));
  std::size_t before = 0;
  for (const std::size_t size : sizes)
    if ((before += size) * 2 >= points) return size;
  return 0;
}

constexpr double same_position = 1e-3;  // times d: tolerance of a mirror image
constexpr double reach = 0.4;           // times d: largest distance of a measured joint
constexpr double least_found_within = 0.9, least_within = 0.6;

/// Tangent of a rod at its k-th node, a unit vector: inside that of a quadratic through three
/// nodes.
Eigen::Vector3d tangent_at(const std::vector<int>& rod, std::size_t k,
                           const Eigen::Matrix3Xd& nodes) {
  const bool ring = rod.front() == rod.back();
  const std::size_t last = rod.size() - 1;
  if (!ring && k == 0) return (nodes.col(rod[1]) - nodes.col(rod[0])).normalized();
  if (!ring && k == last) return (nodes.col(rod[last]) - nodes.col(rod[last - 1])).normalized();
  const std::size_t from = k > 0 ? k - 1 : last - 1, to = k < last ? k + 1 : 1;
  const Eigen::Vector3d a = nodes.col(rod[k]) - nodes.col(rod[from]),
                        b = nodes.col(rod[to]) - nodes.col(rod[k]);
  return (a.normalized() * b.norm() + b.normalized() * a.norm()).normalized();
}

/// Whether a rod runs along u; empty if the run does not determine it.
std::optional<bool> runs_along_u(const record::Layout& layout, std::size_t rod,
                                 const std::vector<int>& joint_of) {
  if (!layout.families.empty()) {
    const std::string& family = layout.families[rod];
    return family == "u" || family == "v" ? std::optional(family == "u") : std::nullopt;
  }
  std::optional<int> first;
  for (const int node : layout.rods[rod]) {
    const int joint = joint_of[std::size_t(node)];
    if (joint < 0) continue;
    if (first && *first != joint)
      return layout.joints[std::size_t(*first)].j == layout.joints[std::size_t(joint)].j;
    first = joint;
  }
  return std::nullopt;
}

/// One of the four upright mirrors of the square that leaves footprint and boundary as they are.
std::optional<Eigen::Matrix3d> mirror_of(const record::Layout& layout, const record::Frame& frame) {
  Eigen::Matrix3Xd flat(3, Eigen::Index(layout.joints.size())),
      ends(3, Eigen::Index(layout.edge_points.size()));
  for (Eigen::Index k = 0; k < flat.cols(); ++k)
    flat.col(k) << layout.joints[std::size_t(k)].u_mm, layout.joints[std::size_t(k)].v_mm, 0;
  for (Eigen::Index k = 0; k < ends.cols(); ++k)
    ends.col(k) = frame.nodes.col(layout.edge_points[std::size_t(k)]);
  const double within = same_position * layout.spacing_mm;
  for (const Eigen::Vector2d& across : {Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1),
                                        Eigen::Vector2d(1, -1), Eigen::Vector2d(1, 1)}) {
    const Eigen::Vector2d normal = across.normalized();
    if (!(mirror_defect(flat, normal) <= within && mirror_defect(ends, normal) <= within)) continue;
    Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
    map.topLeftCorner<2, 2>() -= 2 * normal * normal.transpose();
    return map;
  }
  return std::nullopt;
}

RegisteredScan laid(const Eigen::Matrix3Xd& tops, const ScanTarget& form,
                    const JointCylinder& cylinder, const Registration& found) {
  RegisteredScan scan;
  scan.pose = found.pose;
  scan.distance_mm = found.distance;
  scan.found = found.found;
  scan.cost = found.cost;
  scan.joints = Eigen::Matrix3Xd::Constant(3, form.joints.cols(), std::nan(""));
  const Eigen::Matrix3Xd moved = found.pose.of(tops);
  std::vector<char> used(std::size_t(tops.cols()), 0);
  double sum = 0, squares = 0;
  for (Eigen::Index k = 0; k < form.joints.cols(); ++k) {
    const int top = found.point_of[std::size_t(k)];
    if (top < 0) continue;
    used[std::size_t(top)] = 1;
    scan.joints.col(k) = moved.col(top) - cylinder.height_mm * form.normals.col(k);
    const double off = found.distance[k];
    sum += off;
    squares += off * off;
    scan.max_mm = std::max(scan.max_mm, off);
    if (off <= cylinder.diameter_mm) ++scan.within_bar;
  }
  scan.mean_mm = sum / found.found;
  scan.rms_mm = std::sqrt(squares / found.found);
  scan.outliers.resize(3, tops.cols() - found.found);
  Eigen::Index next = 0;
  for (Eigen::Index k = 0; k < tops.cols(); ++k)
    if (!used[std::size_t(k)]) scan.outliers.col(next++) = moved.col(k);
  const Eigen::Matrix3Xd positions = form.joints + cylinder.height_mm * form.normals;
  for (const auto& top : scan.outliers.colwise())
    scan.near_outliers += (positions.colwise() - top).colwise().norm().minCoeff() < form.spacing_mm;
  return scan;
}

}  // namespace

Result<Clusters> cluster_joint_tops(const Eigen::Matrix3Xd& cloud, double diameter_mm) {
  TRY(cells, cells_of(cloud, diameter_mm / cells_a_diameter));
  const auto sets = sets_of(*cells);
  const auto usual = double(usual_size(sets));
  Clusters found;
  std::vector<Eigen::Vector3d> tops;
  std::vector<double> noise;
  for (const auto& set : sets) {
    if (double(set.size()) < speck_fraction * usual) {
      ++found.specks;
      continue;
    }
    double off_plane = record::unknown;
    const auto middle = middle_of(chosen(cloud, set), diameter_mm / 2, off_plane);
    if (!middle) {
      ++found.others;
      continue;
    }
    tops.push_back(*middle);
    if (std::isfinite(off_plane)) noise.push_back(off_plane);
    found.points.push_back(int(set.size()));
  }
  found.tops.resize(3, Eigen::Index(tops.size()));
  for (std::size_t k = 0; k < tops.size(); ++k) found.tops.col(Eigen::Index(k)) = tops[k];
  std::ranges::sort(noise);
  if (!noise.empty()) found.noise_mm = noise[noise.size() / 2];
  return found;
}

Eigen::Matrix3Xd RegisteredScan::measured() const {
  Eigen::Matrix3Xd some(3, found);
  Eigen::Index next = 0;
  for (const auto& joint : joints.colwise())
    if (!joint.hasNaN()) some.col(next++) = joint;
  return some;
}

ScanTarget form_of(const record::Layout& layout, const record::Frame& frame) {
  const auto joints = Eigen::Index(layout.joints.size());
  std::vector<int> joint_of(std::size_t(frame.nodes.cols()), -1);
  for (Eigen::Index k = 0; k < joints; ++k)
    joint_of[std::size_t(layout.joints[std::size_t(k)].node)] = int(k);
  for (std::size_t k = 0; k < layout.above.size(); ++k)
    joint_of[std::size_t(layout.above[k])] = int(k);
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, joints), v = u;
  std::vector<char> of_grid(std::size_t(joints), 1);
  for (std::size_t r = 0; r < layout.rods.size(); ++r) {
    const auto& rod = layout.rods[r];
    const auto along_u = runs_along_u(layout, r, joint_of);
    for (std::size_t k = 0; k < rod.size(); ++k) {
      const int joint = joint_of[std::size_t(rod[k])];
      if (joint < 0) continue;
      of_grid[std::size_t(joint)] &= along_u.has_value();
      // a rod of unknown direction is of the family that the joint has no tangent of yet
      const bool to_u = along_u ? *along_u : u.col(joint).isZero(0);
      (to_u ? u : v).col(joint) = tangent_at(rod, k, frame.nodes);
    }
  }
  ScanTarget form;
  form.spacing_mm = layout.spacing_mm;
  form.joints.resize(3, joints);
  form.normals.resize(3, joints);
  for (Eigen::Index k = 0; k < joints; ++k) {
    form.joints.col(k) = frame.nodes.col(layout.joints[std::size_t(k)].node);
    form.normals.col(k) = Eigen::Vector3d(u.col(k)).cross(Eigen::Vector3d(v.col(k))).normalized();
    // only the two families of a grid have an order, which gives the normal its side
    if (!of_grid[std::size_t(k)] && form.normals(2, k) < 0) form.normals.col(k) *= -1;
  }
  form.mirror = mirror_of(layout, frame);
  return form;
}

std::optional<RegisteredScan> register_points(const Clusters& clusters, const ScanTarget& form,
                                              const JointCylinder& cylinder) {
  const Eigen::Matrix3Xd positions = form.joints + cylinder.height_mm * form.normals;
  const double bar = cylinder.diameter_mm;
  const RegistrationOptions options{bar, std::max(bar, reach * form.spacing_mm), bar / 2};
  auto best = register_points(clusters.tops, positions, options);
  bool mirrored = false;
  if (form.mirror) {
    auto other = register_points(clusters.tops, *form.mirror * positions, options);
    // of two equal fits that without reflection is chosen
    if (other && (!best || other->cost < (1 - 1e-6) * best->cost)) {
      other->pose.turn = *form.mirror * other->pose.turn;
      other->pose.shift = *form.mirror * other->pose.shift;
      best = std::move(other);
      mirrored = true;
    }
  }
  if (!best) return std::nullopt;
  RegisteredScan scan = laid(clusters.tops, form, cylinder, *best);
  scan.mirrored = mirrored;
  return scan;
}

double excess_height(const RegisteredScan& scan, const ScanTarget& form) {
  constexpr int unknowns = 7;
  if (scan.found <= unknowns) return 0;
  Eigen::MatrixXd moves(3 * scan.found, unknowns);
  Eigen::VectorXd off(3 * scan.found);
  const Eigen::Vector3d middle = form.joints.rowwise().mean();
  int row = 0;
  for (Eigen::Index k = 0; k < form.joints.cols(); ++k) {
    if (scan.joints.col(k).hasNaN()) continue;
    const Eigen::Vector3d arm = form.joints.col(k) - middle;
    for (int axis = 0; axis < 3; ++axis, ++row) {
      const Eigen::Vector3d e = Eigen::Vector3d::Unit(axis);
      moves.row(row) << form.normals(axis, k), arm.cross(e).transpose(), e.transpose();
      off[row] = scan.joints(axis, k) - form.joints(axis, k);
    }
  }
  return least_squares(moves, off)(0);
}

double match_tolerance_mm(const Clusters& clusters, const JointCylinder& cylinder) {
  constexpr double of_noise = 5, least = 0.1;
  if (!std::isfinite(clusters.noise_mm)) return cylinder.diameter_mm / 2;
  return std::clamp(of_noise * clusters.noise_mm, least * cylinder.diameter_mm,
                    cylinder.diameter_mm / 2);
}

bool scan_matches(const RegisteredScan& scan, double tolerance_mm) {
  const auto could =
      double(std::min(scan.joints.cols(), Eigen::Index(scan.found + scan.near_outliers)));
  return scan.within_bar >= least_found_within * scan.found &&
         scan.within_bar >= least_within * could && scan.rms_mm <= tolerance_mm;
}

}  // namespace gridshell::study
