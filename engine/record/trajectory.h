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

/// Frames that lie elsewhere, all of one layout.
class FrameSource {
 public:
  virtual ~FrameSource() = default;
  virtual std::size_t size() const = 0;
  /// The k-th without_nodes(), which stay in memory; null: they do not.
  virtual const Frame* head(std::size_t) const { return nullptr; }
  /// The k-th in order. Errors: io, bad_input when what is read is damaged.
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
  /// The k-th, of which nodes and what lies along rods may be missing: its numbers alone.
  const Frame& head(std::size_t k) const {
    const Frame* head = source_ ? source_->head(k) : nullptr;
    return head ? *head : (*this)[k];
  }
  /// Whether frames come from a source, which has looked whether they fit their layout.
  bool has_source() const { return source_ != nullptr; }
  const Frame& front() const { return (*this)[0]; }
  const Frame& back() const { return (*this)[size() - 1]; }
  const_iterator begin() const { return {this, 0}; }
  const_iterator end() const { return {this, size()}; }

  /// Why a frame could not be read, at the first failure; an empty frame was returned for it.
  const std::optional<Error>& fault() const { return fault_; }

  /// All of them to change, which brings those of a source into memory.
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

// The results of a run for programs that show, store or compare it: the net's layout, which does
// not change, and one frame per sampled state. Millimetres, newtons, millijoules, z up.

/// A crossing of a u-rod and a v-rod at grid position (u, v) of the flat footprint.
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

/// A building block on its own net: rods as polylines, where they would lie without the others.
struct Part {
  std::string name;
  std::vector<std::vector<int>> rods;  ///< columns of the points below
  Eigen::Matrix3Xd net, flat;          ///< in space, and in the flat footprint
};

/// A rod across the seam of two building blocks.
struct SeamRod {
  std::string seam;  ///< "left.east - middle.west"
  char family = 'u';
  double line_mm = 0;   ///< v of a u-rod, u of a v-rod
  double gap_mm = 0;    ///< between the two nets at the seam
  double kink_deg = 0;  ///< between its tangents there
  bool operator==(const SeamRod&) const = default;
};

/// A joint that is pushed or pulled, and the direction: a unit vector.
struct LoadedJoint {
  int joint = 0;  ///< of Layout::joints
  Eigen::Vector3d direction = Eigen::Vector3d::UnitZ();
  /// In the frames alone whose reactions say so, as a step by hand takes and lets go; else in all.
  bool at_times = false;
};

/// The net, fixed over a run.
struct Layout {
  double spacing_mm = 0;
  double rod_diameter_mm = 0;
  /// Size of the joints' cylinders; the height is measured above the rods' crossing. Runs of 0.1 do
  /// not contain it: the paper's.
  double joint_diameter_mm = 3, joint_height_mm = 5;
  double table_mm = unknown;  ///< height of the plane that no rod passes; NaN: there is none
  /// Diameter of each rod, for other sections that of a circle of equal area; empty: all
  /// rod_diameter_mm.
  std::vector<double> diameters_mm;
  /// Width and thickness of each rod, one after the other, 0 of a round one, where all joints keep
  /// sections to their normal, the thickness along it; empty: none, or they may turn.
  std::vector<double> laths_mm;
  std::vector<double> strength_MPa;  ///< of each rod; empty: not known
  double length_scale_mm = 0;  ///< R_o for a circle, rho for a net: what errors are relative to
  std::vector<std::vector<int>> rods;  ///< nodes of each rod from edge point to edge point
  std::vector<std::string> families;   ///< of each rod: "u" or "v"; empty: not known
  std::vector<Joint> joints;
  std::vector<int> above;  ///< of every joint the node of its second rod there; empty: the same
  std::vector<Cell> cells;
  std::vector<int> edge_points;  ///< nodes pinned on the boundary
  /// Nodes that may be constrained: joints, edge points, far ends of tails. Empty: not known.
  std::vector<int> supports;
  std::vector<int> sprung;                 ///< nodes that a spring pulls to a support
  Eigen::Matrix3Xd spring_N_per_mm;        ///< stiffness of each along x, y, z; may be 0
  Eigen::Matrix3Xd original_boundary;      ///< closed polyline (last point joins the first)
  Eigen::Matrix3Xd actuated_boundary;      ///< same number of points; in correspondence
  Eigen::Matrix3Xd net_nodes;              ///< position of every node on the designed net, if any
  Eigen::Matrix3Xd flat_nodes;             ///< and in the flat footprint, where there is a net
  std::vector<Part> parts;                 ///< of a net made of building blocks
  std::vector<SeamRod> seam_rods;          ///< and how they meet
  std::vector<LoadedJoint> loaded_joints;  ///< where the shell is pushed or pulled
  /// Whether nodes and K of frames are extrapolated over the last two meshes. Residuals and pivots
  /// are those of the finest mesh always. Written, not read back.
  bool extrapolated = false;
};

/// Where a run comes from; empty words are not known.
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
/// Thickness of a rod over that of the layout; 1 if neither is known.
inline double thickness_of(const Layout& layout, std::size_t rod) {
  const double over = diameter_of(layout, rod) / layout.rod_diameter_mm;
  return over > 0 && over < 1e3 ? over : 1;
}

/// How many numbers the forces, curvatures and energies of a frame are: edges and points of all
/// rods.
inline Eigen::Index edges_of_rods(const Layout& layout) {
  Eigen::Index edges = 0;
  for (const auto& rod : layout.rods) edges += std::max<Eigen::Index>(0, long(rod.size()) - 1);
  return edges;
}
inline Eigen::Index points_of_rods(const Layout& layout) {
  Eigen::Index points = 0;
  for (const auto& rod : layout.rods) points += Eigen::Index(rod.size());
  return points;
}

// Checks of the consistency of a trajectory's parts, so that its readers may trust indices and
// numbers.

/// Checks that every index of the layout refers to a part of a shell of `nodes` nodes, that rods
/// have at most that many, that the two boundaries have equally many points, that nets have the
/// required size, and that every number is finite. Errors: Fault::bad_input with the inconsistent
/// parts and both numbers.
Result<void> check_layout(const Layout& layout, Eigen::Index nodes);

/// The frame has `nodes` nodes and one K a cell. Errors: as above; `k` names the frame.
Result<void> check_frame(const Layout& layout, const Frame& frame, std::size_t k,
                         Eigen::Index nodes);

/// All of this, of every frame the nodes of the first; a source has looked at its own.
Result<void> check_consistency(const Trajectory& trajectory);

// Where the frames of a run go as they are found.

/// Takes a run's layout, then its certified frames one by one as they are found, in any order:
/// `Frame::index` says which is which. An error stops the run and is passed on.
class Sink {
 public:
  virtual ~Sink() = default;
  /// May come again, when a finer mesh takes over: what came before is then dropped.
  virtual Result<void> begin(Layout layout) = 0;
  virtual Result<void> take(Frame frame) = 0;
};

/// Keeps all frames, in the order of their index.
class MemorySink final : public Sink {
 public:
  Result<void> begin(Layout layout) override;
  Result<void> take(Frame frame) override;
  Trajectory& trajectory() { return trajectory_; }

 private:
  Trajectory trajectory_;
};

}  // namespace gridshell::record
