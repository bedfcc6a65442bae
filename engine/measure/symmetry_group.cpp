#include "engine/measure/symmetry_group.h"

#include <algorithm>
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

}  // namespace gridshell
