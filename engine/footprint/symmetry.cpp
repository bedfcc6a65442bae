#include "engine/footprint/symmetry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace gridshell {

double mirror_defect(const Eigen::Matrix3Xd& joints, const Eigen::Vector2d& normal) {
  double worst = 0;
  for (Eigen::Index k = 0; k < joints.cols(); ++k) {
    Eigen::Vector3d image = joints.col(k);
    image.head<2>() -= 2 * image.head<2>().dot(normal) * normal;
    const double nearest = (joints.colwise() - image).colwise().squaredNorm().minCoeff();
    if (!(nearest <= worst)) worst = nearest;
  }
  return std::sqrt(worst);
}

namespace {

constexpr double same_mm = 1e-3;  // distance up to which positions are equal

using RoundedPosition = std::array<long long, 3>;

RoundedPosition rounded(const Eigen::Vector3d& p) {
  return {std::llround(p.x() / same_mm), std::llround(p.y() / same_mm),
          std::llround(p.z() / same_mm)};
}

/// (u, v, height) of a node.
Eigen::Vector3d drawn(const RodMesh& mesh, int node) {
  return {mesh.flat(0, node), mesh.flat(1, node), mesh.height.size() > 0 ? mesh.height[node] : 0};
}

/// Adds the images of the supports of springs: those of the nodes that they pull. Empty if there is
/// no spring of the same stiffness at an image.
std::optional<std::vector<int>> with_supports(const RodMesh& mesh, const Eigen::Matrix3d& map,
                                              std::vector<int> image) {
  for (const MeshSpring& spring : mesh.springs) {
    const int node = image[std::size_t(spring.node)];
    const Eigen::Vector3d turned = map.cwiseAbs() * spring.N_per_mm;
    const auto there = std::ranges::find_if(mesh.springs, [&](const MeshSpring& other) {
      return other.node == node && other.N_per_mm.isApprox(turned);
    });
    if (there == mesh.springs.end()) return std::nullopt;
    image[std::size_t(spring.support)] = there->support;
  }
  return image;
}

/// The image of each node; empty if a node is not mapped to the position of a node.
std::optional<std::vector<int>> image_of(const RodMesh& mesh, const Eigen::Matrix3d& map) {
  std::map<RoundedPosition, int> node_at;
  // supports of springs have the positions of other nodes, so they are added at the end
  const int without_supports = mesh.nodes() - int(mesh.springs.size());
  for (int node = 0; node < without_supports; ++node) node_at[rounded(drawn(mesh, node))] = node;
  std::vector<int> image(std::size_t(mesh.nodes()));
  std::iota(image.begin(), image.end(), 0);
  if (map.isIdentity(0)) return image;
  // nodes with the same position cannot be distinguished
  if (int(node_at.size()) < without_supports) return std::nullopt;
  for (int node = 0; node < without_supports; ++node) {
    const auto [u, v, w] = rounded(map * drawn(mesh, node));
    int found = -1;
    // round-off may give a neighbour of the expected position
    const long long dw_most = mesh.height.size() > 0 ? 1 : 0;
    for (long long du = -1; du <= 1 && found < 0; ++du)
      for (long long dv = -1; dv <= 1 && found < 0; ++dv)
        for (long long dw = -dw_most; dw <= dw_most && found < 0; ++dw)
          if (const auto at = node_at.find({u + du, v + dv, w + dw}); at != node_at.end())
            found = at->second;
    if (found < 0) return std::nullopt;
    image[std::size_t(node)] = found;
  }
  return with_supports(mesh, map, std::move(image));
}

}  // namespace

std::vector<int> fixed_nodes(const RodMesh& mesh) {
  std::vector<int> fixed = mesh.fixed_joints;
  for (int k = 0; k < mesh.edge_points; ++k)
    if (is_fixed(mesh.end_of(k))) fixed.push_back(mesh.joints + k);
  for (int node = mesh.rod_nodes(); node < mesh.rod_nodes() + mesh.ghosts; ++node)
    fixed.push_back(node);
  return fixed;
}

std::optional<std::vector<int>> images_of(const Eigen::Matrix2Xd& points,
                                          const Eigen::Matrix2d& map, double within_mm) {
  std::vector<int> images;
  for (Eigen::Index k = 0; k < points.cols(); ++k) {
    Eigen::Index nearest = 0;
    const Eigen::Vector2d there = map * points.col(k);
    const double off = (points.colwise() - there).colwise().squaredNorm().minCoeff(&nearest);
    if (!(std::sqrt(off) <= within_mm)) return std::nullopt;
    images.push_back(int(nearest));
  }
  return images;
}

const std::vector<Eigen::Matrix3d>& square_symmetries() {
  static const std::vector<Eigen::Matrix3d> all = [] {
    std::vector<Eigen::Matrix3d> maps;
    for (const double z : {1.0, -1.0})
      for (const bool swapped : {false, true})
        for (const double x : {1.0, -1.0})
          for (const double y : {1.0, -1.0}) {
            Eigen::Matrix3d map = Eigen::Matrix3d::Zero();
            map(0, swapped ? 1 : 0) = x;
            map(1, swapped ? 0 : 1) = y;
            map(2, 2) = z;
            maps.push_back(map);
          }
    return maps;
  }();
  return all;
}

Eigen::Matrix3Xd MeshSymmetry::of(const Eigen::Matrix3Xd& x) const {
  Eigen::Matrix3Xd moved(3, x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k)
    moved.col(image[std::size_t(k)]) = map * (x.col(k) - centre) + centre;
  return moved;
}

std::vector<MeshSymmetry> symmetries_of(const RodMesh& mesh, const Eigen::Matrix3Xd& ends) {
  const std::vector<int> fixed = fixed_nodes(mesh);
  std::vector<int> sorted = fixed;
  std::ranges::sort(sorted);
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  for (const int node : fixed) centre.z() += ends(2, node) / double(fixed.size());
  std::vector<MeshSymmetry> found;
  for (std::size_t k = 0; k < square_symmetries().size(); ++k) {
    MeshSymmetry symmetry{int(k), square_symmetries()[k], centre, {}};
    auto image = image_of(mesh, symmetry.map);
    if (!image) continue;
    symmetry.image = std::move(*image);
    // fixed nodes must be mapped to fixed nodes
    if (!std::ranges::all_of(fixed, [&](int node) {
          return std::ranges::binary_search(sorted, symmetry.image[std::size_t(node)]);
        }))
      continue;
    const Eigen::Matrix3Xd moved = symmetry.of(ends.leftCols(Eigen::Index(symmetry.image.size())));
    const bool same = std::ranges::all_of(
        fixed, [&](int node) { return (moved.col(node) - ends.col(node)).norm() < same_mm; });
    if (same) found.push_back(std::move(symmetry));
  }
  return found;
}

Eigen::Matrix3Xd symmetric_part(const Eigen::Matrix3Xd& x, const std::vector<MeshSymmetry>& group) {
  Eigen::Matrix3Xd sum = Eigen::Matrix3Xd::Zero(3, x.cols());
  for (const MeshSymmetry& symmetry : group) sum += symmetry.of(x);
  return sum / double(group.size());
}

double distance_under(const MeshSymmetry& symmetry, const Eigen::Matrix3Xd& x,
                      const Eigen::Matrix3Xd& y) {
  double largest = 0;
  for (Eigen::Index k = 0; k < y.cols(); ++k) {
    const Eigen::Vector3d moved = symmetry.map * (y.col(k) - symmetry.centre) + symmetry.centre;
    largest = std::max(largest, (x.col(symmetry.image[std::size_t(k)]) - moved).squaredNorm());
  }
  return std::sqrt(largest);
}

}  // namespace gridshell
