#include "engine/record/shape_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "engine/core/dense.h"

namespace gridshell {

NetDeviation::NetDeviation(const Eigen::Matrix3Xd& joints, const Eigen::Matrix3Xd& net, double rho)
    : of_joints_((joints - net).colwise().norm().transpose() / rho), sorted_(of_joints_) {
  // NaN is sorted last, so that largest() returns it
  std::ranges::sort(sorted_,
                    [](double a, double b) { return std::isnan(b) ? !std::isnan(a) : a < b; });
}

double NetDeviation::largest() const { return quantile(1); }

double NetDeviation::mean() const {
  return of_joints_.size() ? of_joints_.mean() : std::numeric_limits<double>::quiet_NaN();
}

double NetDeviation::quantile(double q) const {
  if (sorted_.size() == 0) return std::numeric_limits<double>::quiet_NaN();
  const double at = std::clamp(q, 0.0, 1.0) * static_cast<double>(sorted_.size() - 1);
  const auto below = static_cast<Eigen::Index>(at);
  const auto above = std::min(below + 1, sorted_.size() - 1);
  const double part = at - static_cast<double>(below);
  // without this, 0 times a NaN would be NaN
  return part == 0 ? sorted_[below] : (1 - part) * sorted_[below] + part * sorted_[above];
}

PushReach push_reach(const Eigen::Matrix3Xd& before, const Eigen::Matrix3Xd& now, double depth) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  if (depth == 0 || before.cols() == 0) return {none, none, none};
  const Eigen::ArrayXd moved =
      (now - before).colwise().norm().transpose().array() / std::abs(depth);
  PushReach reach{double((moved > 0.1).count()) / double(moved.size()),
                  double((moved > 0.5).count()) / double(moved.size()), none};
  for (Eigen::Index k = 0; k < moved.size(); ++k) {
    if (!(moved[k] > 0.1)) continue;
    const double latitude = std::asin(before(2, k) / before.col(k).norm()) * 180 / M_PI;
    if (!(reach.lowest_latitude_deg <= latitude)) reach.lowest_latitude_deg = latitude;
  }
  return reach;
}

namespace {

constexpr double counts = 0.05;  // smaller curvatures, over the rod's largest, are ignored

/// Curvature vectors at the inner nodes of a rod: the change of the unit tangent over the length.
Eigen::Matrix3Xd curvatures(const std::vector<int>& rod, const Eigen::Matrix3Xd& x) {
  Eigen::Matrix3Xd found(3, std::max<Eigen::Index>(0, Eigen::Index(rod.size()) - 2));
  for (Eigen::Index k = 0; k < found.cols(); ++k) {
    const Eigen::Vector3d before = x.col(rod[std::size_t(k) + 1]) - x.col(rod[std::size_t(k)]);
    const Eigen::Vector3d after = x.col(rod[std::size_t(k) + 2]) - x.col(rod[std::size_t(k) + 1]);
    found.col(k) =
        (after.normalized() - before.normalized()) / (0.5 * (before.norm() + after.norm()));
  }
  return found;
}

int inflections_of(const Eigen::Matrix3Xd& curvature) {
  if (curvature.cols() == 0) return 0;
  const double least = counts * curvature.colwise().norm().maxCoeff();
  Eigen::Vector3d last = Eigen::Vector3d::Zero();
  int found = 0;
  for (const auto& now : curvature.colwise()) {
    if (now.norm() <= least) continue;
    found += last.dot(now) < 0;
    last = now;
  }
  return found;
}

/// Sets the tangent of a rod of a network at a joint: as u if it is the first rod there, else as v,
/// oriented to the left of u.
void put_other(const Eigen::Vector3d& along, const Eigen::Vector2d& flat, int joint,
               Eigen::Vector2d& first, JointTangents& tangents) {
  if (tangents.u.col(joint).isZero(0)) {
    tangents.u.col(joint) = along;
    first = flat;
    return;
  }
  const double left = first.x() * flat.y() - first.y() * flat.x();
  if (tangents.v.col(joint).isZero(0) && std::abs(left) > 1e-6 * first.norm() * flat.norm())
    tangents.v.col(joint) = left > 0 ? along : Eigen::Vector3d(-along);
}

/// Numbers of elements of each kind in a group.
struct Counts {
  int half = 0, quarter = 0, axis = 0, diagonal = 0;  // turns about z; vertical mirrors
  // elements that invert z: horizontal mirror, inversion, turn by 90 degrees with inversion of z,
  // half turns about horizontal axes
  int level = 0, inversion = 0, improper = 0, level_axis = 0, level_diagonal = 0;
};

Counts counted(const SymmetryGroup& group) {
  Counts n;
  for (const int index : group) {
    const Eigen::Matrix3d& map = square_symmetries()[std::size_t(index)];
    const bool over = map(2, 2) < 0, swaps = map(0, 0) == 0;
    const bool mirror = map.topLeftCorner<2, 2>().determinant() < 0;
    if (mirror && swaps)
      ++(over ? n.level_diagonal : n.diagonal);
    else if (mirror)
      ++(over ? n.level_axis : n.axis);
    else if (swaps)
      ++(over ? n.improper : n.quarter);
    else if (map(0, 0) < 0)
      ++(over ? n.inversion : n.half);
    else
      n.level += over;
  }
  return n;
}

std::string name_of_upright(const Counts& n) {
  if (n.quarter > 0) return n.axis > 0 ? "C4v" : "C4";
  if (n.half > 0) return n.axis > 0 ? "C2v_axes" : n.diagonal > 0 ? "C2v_diagonals" : "C2";
  return n.axis > 0 ? "Cs_axis" : n.diagonal > 0 ? "Cs_diagonal" : "C1";
}

int index_of(const Eigen::Matrix3d& map) {
  const auto& all = square_symmetries();
  return int(std::ranges::find(all, map) - all.begin());
}

/// The smallest group that contains these maps.
SymmetryGroup generated(const SymmetryGroup& generators) {
  std::set<int> group{0};
  group.insert(generators.begin(), generators.end());
  for (std::size_t before = 0; before != group.size();) {
    before = group.size();
    const std::vector<int> now(group.begin(), group.end());
    for (const int a : now)
      for (const int b : now)
        group.insert(
            index_of(square_symmetries()[std::size_t(a)] * square_symmetries()[std::size_t(b)]));
  }
  return {group.begin(), group.end()};
}

/// The points relative to their middle in the plane.
template <class Points>
Points centred(Points points) {
  const Eigen::Vector2d middle = points.template topRows<2>().rowwise().mean();
  points.template topRows<2>().colwise() -= middle;
  return points;
}

}  // namespace

std::vector<int> inflections(const RodMesh& mesh, const Eigen::Matrix3Xd& x) {
  std::vector<int> all;
  for (const std::vector<int>& rod : mesh.rods) all.push_back(inflections_of(curvatures(rod, x)));
  return all;
}

Eigen::Vector3d JointTangents::normal(Eigen::Index joint) const {
  return u.col(joint).cross(v.col(joint)).normalized();
}

JointTangents joint_tangents(const Footprint& footprint, const RodMesh& mesh,
                             const Eigen::Matrix3Xd& x) {
  JointTangents tangents{Eigen::Matrix3Xd::Zero(3, mesh.joints),
                         Eigen::Matrix3Xd::Zero(3, mesh.joints)};
  // Direction in the flat of the first rod at each joint of a network.
  std::vector<Eigen::Vector2d> first;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r) {
    const std::vector<int>& node = mesh.rods[r];
    const Family family = footprint.rods[r].family;
    const bool ring = node.front() == node.back();
    for (std::size_t k = ring ? 0 : 1; k + 1 < node.size(); ++k) {
      const int joint = mesh.joint_of(node[k]), last = node[k > 0 ? k - 1 : node.size() - 2];
      if (joint < 0) continue;
      const Eigen::Vector3d before = x.col(node[k]) - x.col(last);
      const Eigen::Vector3d after = x.col(node[k + 1]) - x.col(node[k]);
      const double l1 = before.norm(), l2 = after.norm();
      const Eigen::Vector3d along = (before * (l2 / l1) + after * (l1 / l2)).normalized();
      if (family != Family::other) {
        (family == Family::u ? tangents.u : tangents.v).col(joint) = along;
        continue;
      }
      first.resize(std::size_t(mesh.joints));
      put_other(along, mesh.flat.col(node[k + 1]) - mesh.flat.col(last), joint,
                first[std::size_t(joint)], tangents);
    }
  }
  return tangents;
}

Eigen::VectorXd cell_curvature(const Footprint& footprint, const JointTangents& tangents) {
  Eigen::VectorXd K(Eigen::Index(footprint.cells.size()));
  for (std::size_t k = 0; k < footprint.cells.size(); ++k) {
    const auto& joint = footprint.cells[k].joints;
    // at its four corners the cell extends towards (+u,+v), (-u,+v), (-u,-v), (+u,-v)
    double sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const double side_u = corner == 0 || corner == 3 ? 1 : -1;
      const double side_v = corner < 2 ? 1 : -1;
      sum += angle_between(side_u * tangents.u.col(joint[corner]),
                           side_v * tangents.v.col(joint[corner]));
    }
    K[Eigen::Index(k)] = 2 * M_PI - sum;
  }
  return K;
}

CurvatureBins curvature_bins(const Eigen::VectorXd& x_over_L, const Eigen::VectorXd& K, int bins) {
  const double width = 2.0 / bins;
  CurvatureBins found;
  found.low = Eigen::VectorXd::LinSpaced(bins, -1, 1 - width);
  found.high = found.low.array() + width;
  found.cells = Eigen::VectorXi::Zero(bins);
  found.mean = found.deviation = Eigen::VectorXd::Zero(bins);
  const auto bin_of = [&](Eigen::Index cell) {
    return std::clamp(int(std::floor((x_over_L[cell] + 1) / width)), 0, bins - 1);
  };
  for (Eigen::Index cell = 0; cell < K.size(); ++cell) {
    ++found.cells[bin_of(cell)];
    found.mean[bin_of(cell)] += K[cell];
  }
  found.mean.array() /= found.cells.cast<double>().array();
  for (Eigen::Index cell = 0; cell < K.size(); ++cell) {
    const int bin = bin_of(cell);
    found.deviation[bin] += (K[cell] - found.mean[bin]) * (K[cell] - found.mean[bin]);
  }
  found.deviation = (found.deviation.array() / found.cells.cast<double>().array()).sqrt();
  return found;
}

std::string name_of_group(const SymmetryGroup& group) {
  const Counts n = counted(group);
  if (n.level > 0) return "flat";
  if (n.inversion + n.improper + n.level_axis + n.level_diagonal == 0) return name_of_upright(n);
  if (n.inversion > 0) return n.axis > 0 ? "C2h_axis" : n.diagonal > 0 ? "C2h_diagonal" : "Ci";
  if (n.improper > 0) return n.axis > 0 ? "D2d_axes" : n.diagonal > 0 ? "D2d_diagonals" : "S4";
  if (n.quarter > 0) return "D4";
  const std::string axis = n.level_axis > 0 ? "ax" : "diagonal";
  if (n.half > 0) return "D2_" + axis + (n.level_axis > 0 ? "es" : "s");
  return "C2_level_" + axis + (n.level_axis > 0 ? "is" : "");
}

std::vector<SymmetryGroup> subgroups(const std::vector<MeshSymmetry>& symmetries) {
  std::vector<SymmetryGroup> found;
  std::set<std::string> names{"C1", "flat"};
  const auto add = [&](const SymmetryGroup& generators) {
    SymmetryGroup group = generated(generators);
    if (names.insert(name_of_group(group)).second) found.push_back(std::move(group));
  };
  for (const MeshSymmetry& a : symmetries)
    for (const MeshSymmetry& b : symmetries) {
      add({a.index, b.index});
      for (const MeshSymmetry& c : symmetries) add({a.index, b.index, c.index});
    }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return found;
}

SymmetryGroup group_of(const std::vector<MeshSymmetry>& symmetries, const Eigen::Matrix3Xd& joints,
                       double tolerance_mm) {
  SymmetryGroup group;
  for (const MeshSymmetry& symmetry : symmetries)
    if (distance_under(symmetry, joints, joints) <= tolerance_mm) group.push_back(symmetry.index);
  return group;
}

SharedSymmetry::SharedSymmetry(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& shape,
                               double within_mm) {
  const Eigen::Matrix2Xd points = centred(flat);
  const Eigen::Matrix3Xd joints = centred(shape);
  const double same = 1e-6 * std::sqrt(points.colwise().squaredNorm().maxCoeff());
  for (const Eigen::Matrix3d& map : square_symmetries()) {
    if (map(2, 2) < 0) continue;  // only maps that do not invert z
    auto image = images_of(points, map.topLeftCorner<2, 2>(), same);
    if (!image) continue;
    MeshSymmetry element{index_of(map), map, Eigen::Vector3d::Zero(), std::move(*image)};
    if (distance_under(element, joints, joints) <= within_mm) group_.push_back(std::move(element));
  }
}

Eigen::Matrix3Xd SharedSymmetry::broken(const Eigen::Matrix3Xd& shape) const {
  const Eigen::Matrix3Xd joints = centred(shape);
  return joints - symmetric_part(joints, group_);
}

double root_mean_square(const Eigen::Matrix3Xd& columns) {
  return columns.size() == 0 ? 0 : std::sqrt(columns.squaredNorm() / double(columns.cols()));
}

}  // namespace gridshell
