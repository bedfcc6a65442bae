#include "engine/scan/scan.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "engine/geometry/symmetry.h"

namespace gridshell {
namespace {

constexpr double same_place = 1e-3;  // of d: a mirror image's
constexpr double reach = 0.4;        // of d: no joint is measured further away
constexpr double least_found_within = 0.9, least_within = 0.7;

/// Tangent at the middle of three points of a quadratic through them, a unit vector.
Eigen::Vector3d tangent_at(const Eigen::Vector3d& before, const Eigen::Vector3d& at,
                           const Eigen::Vector3d& after) {
  const Eigen::Vector3d a = at - before, b = after - at;
  return (a.normalized() * b.norm() + b.normalized() * a.norm()).normalized();
}

/// Whether a rod runs along u; nothing where the run does not say.
std::optional<bool> runs_along_u(const record::Layout& layout, std::size_t rod,
                                 const std::vector<int>& joint_of) {
  if (!layout.families.empty()) return layout.families[rod] == "u";
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
  const double within = same_place * layout.spacing_mm;
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

LaidScan laid(const Eigen::Matrix3Xd& tops, const ScannedForm& form, const JointCylinder& cylinder,
              const Registration& found) {
  LaidScan scan;
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
  return scan;
}

}  // namespace

Eigen::Matrix3Xd LaidScan::measured() const {
  Eigen::Matrix3Xd some(3, found);
  Eigen::Index next = 0;
  for (const auto& joint : joints.colwise())
    if (!joint.hasNaN()) some.col(next++) = joint;
  return some;
}

ScannedForm form_of(const record::Layout& layout, const record::Frame& frame) {
  const auto joints = Eigen::Index(layout.joints.size());
  std::vector<int> joint_of(std::size_t(frame.nodes.cols()), -1);
  for (Eigen::Index k = 0; k < joints; ++k)
    joint_of[std::size_t(layout.joints[std::size_t(k)].node)] = int(k);
  Eigen::Matrix3Xd u = Eigen::Matrix3Xd::Zero(3, joints), v = u;
  for (std::size_t r = 0; r < layout.rods.size(); ++r) {
    const auto& rod = layout.rods[r];
    const auto along_u = runs_along_u(layout, r, joint_of);
    for (std::size_t k = 1; k + 1 < rod.size(); ++k) {
      const int joint = joint_of[std::size_t(rod[k])];
      if (joint < 0) continue;
      const Eigen::Vector3d t = tangent_at(frame.nodes.col(rod[k - 1]), frame.nodes.col(rod[k]),
                                           frame.nodes.col(rod[k + 1]));
      // of a rod with one joint alone: the family that the other one leaves
      const bool to_u = along_u ? *along_u : u.col(joint).isZero(0);
      (to_u ? u : v).col(joint) = t;
    }
  }
  ScannedForm form;
  form.spacing_mm = layout.spacing_mm;
  form.joints.resize(3, joints);
  form.normals.resize(3, joints);
  for (Eigen::Index k = 0; k < joints; ++k) {
    form.joints.col(k) = frame.nodes.col(layout.joints[std::size_t(k)].node);
    form.normals.col(k) = Eigen::Vector3d(u.col(k)).cross(Eigen::Vector3d(v.col(k))).normalized();
  }
  form.mirror = mirror_of(layout, frame);
  return form;
}

std::optional<LaidScan> lay_on(const Clusters& clusters, const ScannedForm& form,
                               const JointCylinder& cylinder) {
  const Eigen::Matrix3Xd places = form.joints + cylinder.height_mm * form.normals;
  const double bar = cylinder.diameter_mm;
  const RegistrationOptions options{bar, std::max(bar, reach * form.spacing_mm), bar / 2};
  auto best = lay_on(clusters.tops, places, options);
  bool mirrored = false;
  if (form.mirror) {
    auto other = lay_on(clusters.tops, *form.mirror * places, options);
    // where both are as good it is no mirror image
    if (other && (!best || other->cost < (1 - 1e-6) * best->cost)) {
      other->pose.turn = *form.mirror * other->pose.turn;
      other->pose.shift = *form.mirror * other->pose.shift;
      best = std::move(other);
      mirrored = true;
    }
  }
  if (!best) return std::nullopt;
  LaidScan scan = laid(clusters.tops, form, cylinder, *best);
  scan.mirrored = mirrored;
  return scan;
}

bool shows_state(const LaidScan& scan, const JointCylinder& cylinder) {
  const Eigen::Index tops = scan.found + scan.outliers.cols();
  const auto could = double(std::min(scan.joints.cols(), tops));
  return scan.within_bar >= least_found_within * scan.found &&
         scan.within_bar >= least_within * could && scan.rms_mm <= cylinder.diameter_mm / 2;
}

}  // namespace gridshell
