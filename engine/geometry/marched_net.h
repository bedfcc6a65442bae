// Chebyshev nets on meshes with rims, holes and creases: marched from an apex over the surface
// until each rod meets a line of the mesh.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/mesh_lines.h"
#include "engine/geometry/surface_net.h"

namespace gridshell {

/// Reason why a rod of a net ends: a line of the mesh (rim, hole, crease), the boundary given by
/// the preset (cut), rods too close to parallel (angle), a surface that bends too sharply
/// (surface), or another part of the net at the same position (net).
enum class RodStop : char { none, rim, hole, crease, cut, angle, surface, net };

/// The reason in words: "a hole", "rods too close to parallel ([net] least_angle_deg)".
std::string text_of(RodStop stop);

/// A discrete Chebyshev net: points p(i, j) of a surface, neighbours at distance h (the chord),
/// computed from the apex outwards.
/// - If both neighbours towards the axes are known, p(i, j) is at distance h from both [ChordGrid].
/// - If only one is known, because the other's rod has ended, its rod continues as a geodesic. The
///   axes are the first such rods.
/// - A node is not computed if its rod would cross a line of the mesh, leave the requested part, or
///   cross another rod at less than the least angle.
/// - Outside rims and holes, on the continued surface, `margin` more nodes are computed
///   (Node::past_rim). They are used to interpolate between the last nodes and the rim.
class MarchedGrid {
 public:
  struct Node {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    bool known = false;
    char past_rim = 0;                ///< number of nodes outside a rim or hole; 0: not outside
    bool to_u = false, to_v = false;  ///< a rod connects it to node (i + 1, j), (i, j + 1)
    bool on_u = false, on_v = false;  ///< a rod or its continuation past its end connects them
    /// computed from both neighbours, or as the geodesic of its u-rod or v-rod
    enum : char { corner, straight_u, straight_v } by = corner;
    RodStop stop = RodStop::none;  ///< why it is not known; none: no rod leads to it
  };

  /// Computes nodes up to `most` chords from the apex and `margin` nodes outside rims. `lines`: the
  /// lines of the mesh; `least_angle`: between rods, rad; `chord`: h, mm.
  MarchedGrid(const Surface& surface, const NetPose& pose, const Barriers& lines,
              double least_angle, double chord, int most, int margin = 0);
  /// The grid of half the chord on the part that `lead` covers; the same rods are geodesics.
  MarchedGrid(const Surface& surface, const NetPose& pose, const MarchedGrid& lead);

  double chord() const { return chord_; }
  int most() const { return most_; }
  const Node& at(int i, int j) const {
    static const Node outside;
    return std::abs(i) <= most_ && std::abs(j) <= most_ ? nodes_[index(i, j)] : outside;
  }
  bool known(int i, int j) const { return at(i, j).known; }
  /// Whether the node is computed, inside or outside a rim.
  bool present(int i, int j) const { return at(i, j).known || at(i, j).past_rim > 0; }
  /// Whether a rod connects node (i, j) to its neighbour (i + step_u, j + step_v), one of these
  /// +-1.
  bool joined(int i, int j, int step_u, int step_v) const {
    return step_u != 0 ? at(std::min(i, i + step_u), j).to_u : at(i, std::min(j, j + step_v)).to_v;
  }
  /// Whether a rod or its continuation outside a rim connects the two nodes of joined().
  bool linked(int i, int j, int step_u, int step_v) const {
    return step_u != 0 ? at(std::min(i, i + step_u), j).on_u : at(i, std::min(j, j + step_v)).on_v;
  }
  /// Calls visit(i, j) for all nodes that are computed, row by row, or only for known ones.
  template <class Visit>
  void each_present(const Visit& visit) const {
    for (int j = -most_; j <= most_; ++j)
      for (int i = -most_; i <= most_; ++i)
        if (present(i, j)) visit(i, j);
  }
  template <class Visit>
  void each_known(const Visit& visit) const {
    each_present([&](int i, int j) {
      if (known(i, j)) visit(i, j);
    });
  }
  Node& node(int i, int j) { return nodes_[index(i, j)]; }

 private:
  struct March;
  MarchedGrid(double chord, int most);
  std::size_t index(int i, int j) const {
    return std::size_t(j + most_) * std::size_t(2 * most_ + 1) + std::size_t(i + most_);
  }

  double chord_;
  int most_;
  std::vector<Node> nodes_;
};

/// The smooth net, extrapolated from two MarchedGrids of h and h/2: (4 fine - coarse)/3. Between
/// the nodes it is interpolated as SurfaceNet is; near its edges from nodes continued smoothly past
/// them.
class MarchedNet final : public ChebyshevNet {
 public:
  /// `lines`: the lines of the mesh; `least_angle`: between rods, rad; `chord_mm`: h; `most`:
  /// largest number of chords from the apex. Errors (bad_input): no rod leaves the apex.
  static Result<MarchedNet> make(const Surface& surface, const NetPose& pose,
                                 std::shared_ptr<const Barriers> lines, double least_angle,
                                 double chord_mm, int most);

  Result<NetPoint> at(double u, double v) const override;

  /// The net at (u, v); empty if rods do not reach (u, v) without crossing a line of the mesh.
  std::optional<NetPoint> reached(double u, double v) const;
  /// Whether a rod of length `length_mm` connects p and q: no line of the mesh is between them, and
  /// their distance differs from the length by at most the fraction `off`.
  bool joined(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double length_mm,
              double off) const;

  double chord() const { return grid_.chord(); }
  /// The grid of h, with its nodes moved to the extrapolated positions.
  const MarchedGrid& grid() const { return grid_; }
  /// Smallest angle between rods at the nodes, rad.
  double least_angle() const { return least_angle_; }

 private:
  MarchedNet(MarchedGrid grid, std::shared_ptr<const Barriers> lines, Surface::Function outside)
      : grid_(std::move(grid)), lines_(std::move(lines)), outside_(std::move(outside)) {}
  std::optional<NetPoint> from(int i, int j, double u, double v) const;

  MarchedGrid grid_;
  std::shared_ptr<const Barriers> lines_;
  Surface::Function outside_;
  double least_angle_ = 0;
};

}  // namespace gridshell
