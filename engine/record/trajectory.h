// The frames of a run in order: in memory, or read from a file one at a time on demand, so that a
// run of any length can be drawn and rewritten in bounded memory.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <initializer_list>
#include <iterator>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/frame.h"

namespace gridshell::record {

/// Source of the frames of a FrameList, as a file; all frames have the same layout.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::size_t size() const = 0;
  /// The k-th frame without_nodes(), if the source has these in memory; else null.
  virtual const Frame* head(std::size_t) const { return nullptr; }
  /// Reads the k-th frame. Errors: io; bad_input if the data are damaged.
  virtual Result<Frame> read(std::size_t k) const = 0;
};

/// A constant vector of frames, in memory or in a file, for one thread at a time. References into a
/// list with a source are valid until eight other frames were requested; those to its first and
/// last frame always. Only edit() loads all frames into memory.
class FrameList {
 public:
  class const_iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = Frame;
    using difference_type = std::ptrdiff_t;
    using pointer = const Frame*;
    using reference = const Frame&;

    const_iterator(const FrameList* list, std::size_t at) : list_(list), at_(at) {}
    const Frame& operator*() const { return (*list_)[at_]; }
    const Frame* operator->() const { return &(*list_)[at_]; }
    const_iterator& operator++() { return ++at_, *this; }
    bool operator==(const const_iterator& other) const { return at_ == other.at_; }

   private:
    const FrameList* list_;
    std::size_t at_;
  };

  FrameList() = default;
  FrameList(std::initializer_list<Frame> frames);
  FrameList(std::vector<Frame> frames);
  explicit FrameList(std::shared_ptr<const FrameSource> source);

  std::size_t size() const { return source_ ? source_->size() : frames_.size(); }
  bool empty() const { return size() == 0; }
  const Frame& operator[](std::size_t k) const;
  /// The k-th frame for readers of its scalars and K_bins: its other arrays may be empty.
  const Frame& head(std::size_t k) const {
    const Frame* head = source_ ? source_->head(k) : nullptr;
    return head ? *head : (*this)[k];
  }
  /// Whether the frames come from a source, which has checked that they fit the layout.
  bool has_source() const { return source_ != nullptr; }
  const Frame& front() const { return (*this)[0]; }
  const Frame& back() const { return (*this)[size() - 1]; }
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, size()}; }

  /// The error of the first frame that could not be read, for which an empty frame was returned.
  const std::optional<Error>& fault() const { return fault_; }

  /// All frames for changes; frames of a source are loaded into memory.
  std::vector<Frame>& edit();
  void push_back(Frame frame);

 private:
  struct Kept {
    std::size_t k = 0, bytes = 0;
    std::shared_ptr<const Frame> frame;
  };

  std::shared_ptr<const Frame> fetch(std::size_t k) const;

  std::vector<Frame> frames_;  // without a source
  std::shared_ptr<const FrameSource> source_;
  mutable std::list<Kept> recent_;  // the latest first
  mutable std::shared_ptr<const Frame> first_, last_;
  mutable std::size_t bytes_ = 0;
  mutable std::optional<Error> fault_;
};

// The results of a run for programs that show, store or compare it: the layout, which does not
// change, and one frame per sampled state. Millimetres, newtons, millijoules, z up.

/// A joint at position (u, v) of the flat footprint: on a grid the crossing of v-rod i and u-rod j.
struct Joint {
  int i = 0, j = 0;
  double u_mm = 0, v_mm = 0;
  int node = 0;  ///< column of Frame::nodes
  bool operator==(const Joint&) const = default;
};

/// A complete cell: the joints (i,j), (i+1,j), (i+1,j+1), (i,j+1) as indices into Layout::joints.
struct Cell {
  int i = 0, j = 0;
  double u_mm = 0, v_mm = 0;  ///< middle of the cell in the footprint
  std::array<int, 4> joints{};
  bool operator==(const Cell&) const = default;
};

/// A building block on its own net: its rods as polylines, as if there were no other blocks.
struct Part {
  std::string name;
  std::vector<std::vector<int>> rods;  ///< indices of the points of each rod
  Eigen::Matrix3Xd net, flat;          ///< points in space, and in the flat footprint
};

/// A rod across the seam of two building blocks.
struct SeamRod {
  std::string seam;  ///< "left.east - middle.west"
  char family = 'u';
  double line_mm = 0;   ///< v of a u-rod, u of a v-rod
  double gap_mm = 0;    ///< distance of its positions on the two nets at the seam
  double kink_deg = 0;  ///< angle between its tangents on the two nets at the seam
  bool operator==(const SeamRod&) const = default;
};

/// A joint that is pushed or pulled, and the direction: a unit vector.
struct LoadedJoint {
  int joint = 0;  ///< index into Layout::joints
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  /// true: loaded only in frames in which a reaction acts on it, as steps push and release; false:
  /// in all frames.
  bool at_times = false;
};

/// The parts of a shell and their connections, which are fixed over a run.
struct Layout {
  double spacing_mm = 0;
  double rod_diameter_mm = 0;
  /// Size of the joints' cylinders; the height is measured above the rods' crossing. Runs of 0.1 do
  /// not contain it; the defaults are those of the paper.
  double joint_diameter_mm = 3, joint_height_mm = 5;
  double table_mm = unknown;  ///< height of a table below the shell; NaN: there is none
  /// Diameter of each rod, for other sections that of a circle of equal area; empty: all
  /// rod_diameter_mm.
  std::vector<double> diameters_mm;
  /// Width and thickness of each rod in turn, 0 for a round rod, if all joints prescribe that the
  /// thickness is along their normal; empty: all rods are round, or their sections may rotate.
  std::vector<double> laths_mm;
  std::vector<double> strength_MPa;    ///< strength of each rod; empty: not known
  double length_scale_mm = 0;          ///< length that errors are divided by: R_o of a circle, rho
  std::vector<std::vector<int>> rods;  ///< nodes of each rod from edge point to edge point
  std::vector<std::string> families;   ///< "u" or "v" for each rod; empty: not known
  std::vector<Joint> joints;
  /// Node of the second rod at each joint; empty: the rods of each joint have the same node.
  std::vector<int> above;
  std::vector<Cell> cells;
  std::vector<int> edge_points;  ///< nodes pinned on the boundary
  /// Nodes that may be constrained: joints, edge points, far ends of tails. Empty: not known.
  std::vector<int> supports;
  std::vector<int> sprung;                 ///< nodes that a spring pulls to a support
  Eigen::Matrix3Xd spring_N_per_mm;        ///< stiffness of each spring along x, y, z; may be 0
  Eigen::Matrix3Xd original_boundary;      ///< closed polyline (last point joins the first)
  Eigen::Matrix3Xd actuated_boundary;      ///< the actuated positions of the same points
  Eigen::Matrix3Xd net_nodes;              ///< every node on the Chebyshev net; empty: no net
  Eigen::Matrix3Xd flat_nodes;             ///< every node in the flat footprint; empty: no net
  std::vector<Part> parts;                 ///< building blocks, if the net is made of them
  std::vector<SeamRod> seam_rods;          ///< rods across the seams of building blocks
  std::vector<LoadedJoint> loaded_joints;  ///< joints that are pushed or pulled
  /// Whether nodes and K of frames are extrapolated over the last two meshes. Residuals and pivots
  /// are always those of the finest mesh. This is written, not read back.
  bool extrapolated = false;
};

/// Origin of a run; empty texts are not known.
struct Origin {
  std::string title, preset;
  std::string program;  ///< "gridshell 0.2.0"
};

/// All frames of a run over one layout.
struct Trajectory {
  Layout layout;
  FrameList frames;
  Origin origin = {};
};

/// Diameter of a rod, mm.
inline double diameter_of(const Layout& layout, std::size_t rod) {
  return rod < layout.diameters_mm.size() ? layout.diameters_mm[rod] : layout.rod_diameter_mm;
}
/// Diameter of a rod over rod_diameter_mm of the layout; 1 if that is not known.
inline double thickness_of(const Layout& layout, std::size_t rod) {
  const double over = diameter_of(layout, rod) / layout.rod_diameter_mm;
  return over > 0 && over < 1e3 ? over : 1;
}

/// Number of edges of all rods: the length of Frame::axial_force_N.
inline Eigen::Index edges_of_rods(const Layout& layout) {
  Eigen::Index edges = 0;
  for (const auto& rod : layout.rods) edges += std::max<Eigen::Index>(0, long(rod.size()) - 1);
  return edges;
}
/// Number of points of all rods: the length of Frame::curvature_per_mm and other arrays.
inline Eigen::Index points_of_rods(const Layout& layout) {
  Eigen::Index points = 0;
  for (const auto& rod : layout.rods) points += Eigen::Index(rod.size());
  return points;
}

// Checks of the consistency of a trajectory's parts, so that its readers may trust indices and
// numbers.

/// Checks that every index of the layout is that of an existing part in a shell of `nodes` nodes,
/// that all rods together have at most 4 `nodes` points, that the two boundaries have equal numbers
/// of points, that nets and lists have the required size, and that every length is finite. Errors:
/// Fault::bad_input with the inconsistent parts and both numbers.
Result<void> check_layout(const Layout& layout, Eigen::Index nodes);

/// Checks that a frame has `nodes` nodes, one K per cell, and arrays along rods of the required
/// size. Errors: Fault::bad_input; `k` is the number of the frame in the message.
Result<void> check_frame(const Layout& layout, const Frame& frame, std::size_t k,
                         Eigen::Index nodes);

/// Checks the layout and that every frame has as many nodes as the first. Frames of a source are
/// not read: the source has checked them. Errors: Fault::bad_input.
Result<void> check_consistency(const Trajectory& trajectory);

// Receivers of the frames of a run.

/// Receives the layout of a run, then its certified frames as they are found, in any order of
/// `Frame::index`. An error stops the run and is passed on.
class Sink {
 public:
  virtual ~Sink() = default;
  /// Starts a run. Called again when a finer mesh replaces the frames so far, which are dropped.
  virtual Result<void> begin(Layout layout) = 0;
  virtual Result<void> take(Frame frame) = 0;
};

/// Stores all frames in memory, in the order of their index.
class MemorySink final : public Sink {
 public:
  Result<void> begin(Layout layout) override;
  Result<void> take(Frame frame) override;
  Trajectory& trajectory() { return trajectory_; }

 private:
  Trajectory trajectory_;
};

}  // namespace gridshell::record
