#include "engine/record/shape_symmetry.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace gridshell {
namespace {

/// What one map is: of the sixteen, those alike are counted together.
struct Counts {
  int half = 0, quarter = 0, axis = 0, diagonal = 0;  // turns about z, vertical mirrors
  int level = 0, inversion = 0, improper = 0, level_axis = 0, level_diagonal = 0;  // z turned over
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
  return int(std::find(all.begin(), all.end(), map) - all.begin());
}

/// The smallest group that holds these maps.
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

}  // namespace

std::string name_of_group(const SymmetryGroup& group) {
  const Counts n = counted(group);
  if (n.level > 0) return "flat";
  if (n.inversion + n.improper + n.level_axis + n.level_diagonal == 0) return name_of_upright(n);
  if (n.inversion > 0) return n.axis > 0 ? "C2h_axis" : n.diagonal > 0 ? "C2h_diagonal" : "Ci";
  if (n.improper > 0) return n.axis > 0 ? "D2d_axes" : n.diagonal > 0 ? "D2d_diagonals" : "S4";
  if (n.quarter > 0) return "D4";
  const std::string place = n.level_axis > 0 ? "ax" : "diagonal";
  if (n.half > 0) return "D2_" + place + (n.level_axis > 0 ? "es" : "s");
  return "C2_level_" + place + (n.level_axis > 0 ? "is" : "");
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
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return found;
}

SymmetryGroup group_of(const std::vector<MeshSymmetry>& symmetries, const Eigen::Matrix3Xd& joints,
                       double tolerance_mm) {
  SymmetryGroup group;
  for (const MeshSymmetry& symmetry : symmetries)
    if (distance_under(symmetry, joints, joints) <= tolerance_mm) group.push_back(symmetry.index);
  return group;
}

namespace {

/// About its own middle in the plane.
template <class Points>
Points centred(Points points) {
  const Eigen::Vector2d middle = points.template topRows<2>().rowwise().mean();
  points.template topRows<2>().colwise() -= middle;
  return points;
}

}  // namespace

SharedSymmetry::SharedSymmetry(const Eigen::Matrix2Xd& flat, const Eigen::Matrix3Xd& shape,
                               double within_mm) {
  const Eigen::Matrix2Xd points = centred(flat);
  const Eigen::Matrix3Xd joints = centred(shape);
  const double same = 1e-6 * std::sqrt(points.colwise().squaredNorm().maxCoeff());
  for (const Eigen::Matrix3d& map : square_symmetries()) {
    if (map(2, 2) < 0) continue;  // it turns the shape over
    const Eigen::Matrix2d turn = map.topLeftCorner<2, 2>();
    auto image = images_of(points, turn, same);
    if (!image) continue;
    Element element{turn, std::move(*image)};
    const double off = (moved(element, joints) - joints).colwise().norm().maxCoeff();
    if (off <= within_mm) elements_.push_back(std::move(element));
  }
}

Eigen::Matrix3Xd SharedSymmetry::moved(const Element& element, const Eigen::Matrix3Xd& joints) {
  Eigen::Matrix3Xd there(3, joints.cols());
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    auto to = there.col(element.image[std::size_t(k)]);
    to.head<2>() = element.turn * joints.col(k).head<2>();
    to.z() = joints(2, k);
  }
  return there;
}

Eigen::Matrix3Xd SharedSymmetry::broken(const Eigen::Matrix3Xd& shape) const {
  const Eigen::Matrix3Xd joints = centred(shape);
  Eigen::Matrix3Xd mean = Eigen::Matrix3Xd::Zero(3, joints.cols());
  for (const Element& element : elements_) mean += moved(element, joints);
  return joints - mean / double(order());
}

double root_mean_square(const Eigen::Matrix3Xd& columns) {
  return columns.size() == 0 ? 0 : std::sqrt(columns.squaredNorm() / double(columns.cols()));
}

}  // namespace gridshell
