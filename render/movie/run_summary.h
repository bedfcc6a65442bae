// The boundary on its path.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"
#include "render/canvas/legend.h"
#include "render/movie/movie_style.h"

namespace gridshell::render {

/// Every point moves straight and evenly from the original (actuation 0) to the actuated boundary
/// (1). 3 x n, mm.
Eigen::Matrix3Xd boundary_at(const record::Layout& layout, double actuation);

/// Whether the original boundary says anything: not where an actuated shell is pushed.
inline bool original_boundary_shown(const record::Frame& frame) {
  return !std::isfinite(frame.depth_mm);
}

// Where a shell is pushed or pulled: arrows at the joints that move with them.

/// From tail to tip, mm.
struct LoadArrow {
  int node = 0;  ///< of the joint that it acts on
  Eigen::Vector3d from, to;
};

/// Whether a load acts in this frame. One that comes and goes acts where its joint is prescribed;
/// where the frame knows no reactions, always.
bool load_acts(const record::LoadedJoint& load, const record::Layout& layout,
               const record::Frame& frame);

/// Arrows of the loads that act. A push has its tip at the joint; a pull away from the shell its
/// tail. As long as a quarter of the length scale.
std::vector<LoadArrow> load_arrows(const record::Layout& layout, const record::Frame& frame);

/// Whether the loads are those of an area: of many nodes, all in one direction.
bool loads_all_alike(const record::Frame& frame);

/// Arrows for Frame::loads_N, as long as the loads are large: the largest of a run, `largest_N`,
/// longest_force() mm. They are outside the shell, as the arrows above; what is less than a
/// hundredth is left out. If all loads are equal, some are shown, all of that length.
std::vector<LoadArrow> force_arrows(const record::Layout& layout, const record::Frame& frame,
                                    double largest_N);
inline double longest_force(const record::Layout& layout) {
  return std::clamp(1.2 * layout.spacing_mm, 0.1 * layout.length_scale_mm,
                    0.2 * layout.length_scale_mm);
}

// What the pictures of a run have to know of all its frames before the first is drawn: ranges,
// bounds and events. Frames are looked at once, one at a time; the first is kept, and of some
// others some points.

/// Frames one at a time, from memory or from a file.
struct FrameSource {
  const record::Layout* layout = nullptr;
  int count = 0;
  std::function<Result<record::Frame>(int)> at;  ///< 0 to count - 1, in any order
};

/// The frames of a run in memory, which outlives the source.
FrameSource source_of(const record::Trajectory& run);

/// The smallest and the largest of some values; low > high before the first.
struct Interval {
  double low = INFINITY, high = -INFINITY;
  void take(double value);
  void take(const Interval& other);
  bool any() const { return low <= high; }
};

/// A quantity of cells or nodes over all frames. All count for the scale, but for the deviation
/// from the net: those with the boundary farthest on its path alone, as a flat shell deviates by
/// its size.
struct ColouredRange {
  Eigen::ArrayXd most;  ///< largest size of each one's, of the frames that count for the scale
  Interval all;         ///< of all that are known

  void take(const Eigen::VectorXd& values, bool counts);
};

/// Something that happened to the shell, and in which frame.
enum class MarkKind { contact, unstable, motion, snap, lock, other };
struct Mark {
  int at = 0;  ///< position of the frame in the run, from 0
  MarkKind kind = MarkKind::other;
};

/// One more than the largest node that rods and joints name.
long node_count_of(const record::Layout& layout);

/// A point of a rod between two of its nodes, or at one.
struct RodSample {
  int from = 0, to = 0;  ///< columns of Frame::nodes
  double part = 0;       ///< of the distance between them
};

/// What a bar of progress shows of a run: the quantity, its ends, and each frame's position between
/// them, 0 to 1. Without a name: frames alone.
struct ProgressAxis {
  std::string name;  ///< marked text
  double first = 0, last = 1;
  std::vector<double> places;
  std::string unit = " mm";  ///< with the space before it
};

class RunSummary {
 public:
  /// The layout outlives the survey.
  explicit RunSummary(const record::Layout& layout);

  /// The next frame of the run.
  void take(const record::Frame& frame);

  int frames = 0;
  record::Frame first;           ///< what later frames are compared with
  double turn_deg = 0;           ///< angle that the camera goes around a state alone; 0: none
  double depth_mm = 0;           ///< of a push, at its deepest; 0 without one
  double lowest_z_mm = 0;        ///< of all that is drawn
  double support_z_mm = 0;       ///< of the lowest point of both boundaries
  double largest_load_N = 0;     ///< of Frame::loads_N
  bool arrows_to_scale = false;  ///< some frame's loads are arrows as long as they are large
  bool any_contacts = false;     ///< some frame has interpenetrations
  Interval bins_rad;             ///< mean K of the bins, with their standard deviations
  Interval bins_change_rad;      ///< of these means, from the first frame
  double largest_move_mm = 0;    ///< of a joint, from where it was in the first frame
  std::vector<Mark> marks;       ///< in order
  std::set<int> supported;       ///< nodes with a reaction in some frame: a flat grid has round-off

  /// The range of what is coloured (colour_by.cpp), but for displacements, whose depth the end
  /// alone knows.
  const ColouredRange& spread(ColourBy by) const { return spreads_[std::size_t(by)]; }

  /// Along the angle of the camera, the depth of a push that only grows, or the radius of a
  /// boundary that only shrinks.
  ProgressAxis progress() const;

  /// Points that bound all frames, what is drawn of both boundaries, and the arrows of loads: some
  /// hundreds of some dozen frames, and the boundaries themselves. They have the same positions on
  /// the rods on every mesh, and round-off does not choose them: the whole picture would move with
  /// them. 3 x n, mm.
  Eigen::Matrix3Xd bounds() const;

 private:
  void sample_points(const record::Frame& frame);

  const record::Layout* layout_;
  std::array<ColouredRange, words_of<ColourBy>().size()> spreads_;
  std::vector<double> depths_mm_, radii_mm_;      ///< of every frame
  std::vector<RodSample> rod_points_;             ///< the same positions on the rods of every mesh
  double largest_actuation_ = -1;                 ///< the boundary has come
  int sample_stride_ = 1;                         ///< frame whose points are kept
  std::vector<Eigen::Matrix3Xd> sampled_points_;  ///< of every so many frames
  Eigen::Matrix3Xd last_;                         ///< of the last frame
};

RunSummary summarise_run(const record::Trajectory& run);

// What of a frame is coloured: a value a cell or a node.

/// Whether the values are the cells'; else they are the nodes', of rods.
bool of_cells(ColourBy by);

/// Whether a run may know it of no frame: forces and energies along the rods of an older version or
/// of a net, distances where there is no net.
bool may_be_missing(ColourBy by);

/// What displacements and changes are measured from.
struct ColourOrigin {
  const record::Frame& first;  ///< of the run
  double depth_mm = 0;         ///< of the push, at its deepest
};

/// One value a cell or a node: K or its change (rad), deviation over rho, displacement over depth,
/// bending energy over length (mJ/m), axial force (N). Empty for none, and where the frame does not
/// know them.
Eigen::VectorXd coloured_values(ColourBy by, const record::Layout& layout,
                                const record::Frame& frame, const ColourOrigin& from);

/// For a run of which no frame knows what is to be coloured: what it lacks. Errors:
/// Fault::bad_input.
tl::unexpected<Error> missing_values_error(ColourBy by);

// One colour bar for all runs that are shown together.

/// The scale that suits all of the runs: sequential of sizes, diverging about zero of what has a
/// sign, also where all values have the same; none when nothing is coloured. It comes from the most
/// of each cell, so that it does not depend on how many frames sample the path, and a
/// few strongly bent cells at the boundary do not pale the others. The style's map and range go
/// before.
std::optional<ColourBar> colour_bar_of(const std::vector<const RunSummary*>& runs,
                                       const MovieStyle& style);

}  // namespace gridshell::render
