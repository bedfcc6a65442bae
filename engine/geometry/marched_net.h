// A net that is marched over a surface as far as there is one.
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

/// What ends a rod of a net: a line of the mesh, the boundary that the preset gives, rods too close
/// to parallel, no smooth surface, another part of the net.
enum class RodStop : char { none, rim, hole, crease, cut, angle, surface, net };

/// "a hole", "rods too close to parallel": why a net ends there.
std::string text_of(RodStop stop);

/// Points p(i, j) of a surface, neighbours a chord h apart, from an apex outwards. Where both
/// neighbours towards the axes are there, they decide [as in ChordGrid]; where only one is, as the
/// other's rod has ended, its rod goes straight on as a geodesic: the axes are the first of these.
/// A path that would cross a line of the mesh, leave the requested part, or bring rods closer to
/// parallel than the least angle is not gone; but outside rims and holes some nodes are found where
/// the surface continues, for what lies between the last nodes and there.
class MarchedGrid {
 public:
  struct Node {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    bool known = false;
    char beyond = 0;                  ///< of one outside a rim or hole: how many nodes; 0: none
    bool to_u = false, to_v = false;  ///< joined to node (i + 1, j), (i, j + 1) by a rod
    bool on_u = false, on_v = false;  ///< the same, or as a rod would continue past its end
    enum : char { corner, straight_u, straight_v } by = corner;
    RodStop stop = RodStop::none;  ///< why it is not known; none: no rod comes there
  };

  /// No further than `most` chords from the apex, and `margin` outside rims. `least_angle` in rad.
  MarchedGrid(const Surface& surface, const NetPlace& place, const Barriers& lines,
              double least_angle, double chord, int most, int margin = 0);
  /// The grid of half the chord, where `lead` has nodes, its rods straight where that one's are.
  MarchedGrid(const Surface& surface, const NetPlace& place, const MarchedGrid& lead);

  double chord() const { return chord_; }
  int most() const { return most_; }
  const Node& at(int i, int j) const {
    static const Node outside;
    return std::abs(i) <= most_ && std::abs(j) <= most_ ? nodes_[index(i, j)] : outside;
  }
  bool known(int i, int j) const { return at(i, j).known; }
  /// Or outside a rim.
  bool present(int i, int j) const { return at(i, j).known || at(i, j).beyond > 0; }
  /// Whether a rod joins neighbours; `way` a unit step along u or v.
  bool joined(int i, int j, int way_u, int way_v) const {
    return way_u != 0 ? at(std::min(i, i + way_u), j).to_u : at(i, std::min(j, j + way_v)).to_v;
  }
  /// Or would, outside a rim.
  bool linked(int i, int j, int way_u, int way_v) const {
    return way_u != 0 ? at(std::min(i, i + way_u), j).on_u : at(i, std::min(j, j + way_v)).on_v;
  }
  /// visit(i, j) of all that are known, row by row.
  template <class Visit>
  void each_known(const Visit& visit) const {
    for (int j = -most_; j <= most_; ++j)
      for (int i = -most_; i <= most_; ++i)
        if (known(i, j)) visit(i, j);
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

/// The smooth net of two such grids, of h and h/2, whose leading error is taken away, as far as
/// they reach. Between the nodes as SurfaceNet; near its edges from nodes that are continued
/// smoothly.
class MarchedNet final : public ChebyshevNet {
 public:
  /// `chord_mm`: h. Errors (bad_input): no rod leaves the apex.
  static Result<MarchedNet> make(const Surface& surface, const NetPlace& place,
                                 std::shared_ptr<const Barriers> lines, double least_angle,
                                 double chord_mm, int most);

  Result<NetPoint> at(double u, double v) const override;

  /// The net at (u, v) where it is reached without crossing a line; else nothing.
  std::optional<NetPoint> reached(double u, double v) const;
  /// Whether a rod goes from p to q, `way_mm` along it and as far apart but for `off` of that.
  bool joined(const Eigen::Vector3d& p, const Eigen::Vector3d& q, double way_mm, double off) const;

  double chord() const { return grid_.chord(); }
  const MarchedGrid& grid() const { return grid_; }  ///< its nodes are the net's
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
