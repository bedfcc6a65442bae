// What the pictures of a run need to know of all its frames before the first is drawn (ranges,
// bounds, events), the values that are coloured, and the arrows of loads.
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

/// The boundary at an actuation from 0, the original one, to 1, the actuated one, between which its
/// points move on straight lines. 3 x n, mm.
Eigen::Matrix3Xd boundary_at(const record::Layout& layout, double actuation);

/// Whether the original boundary is drawn: not in a push, which follows the actuation.
inline bool original_boundary_shown(const record::Frame& frame) {
  return !std::isfinite(frame.depth_mm);
}

/// An arrow of a load at a joint, from tail to tip, mm.
struct LoadArrow {
  int node = 0;  ///< of the joint
  Eigen::Vector3d from, to;
};

/// Whether a push acts in this frame. A push that acts only at times does if its joint has a
/// reaction; it always does in a frame without reactions.
bool load_acts(const record::LoadedJoint& load, const record::Layout& layout,
               const record::Frame& frame);

/// Arrows of the pushes that act, outside the shell: a push has its tip at the joint, a pull its
/// tail. Their length is a quarter of the length scale.
std::vector<LoadArrow> load_arrows(const record::Layout& layout, const record::Frame& frame);

/// Whether the loads are those of an area: on many nodes, in one direction and of similar size.
bool loads_all_alike(const record::Frame& frame);

/// The loads that are much smaller than the largest one, 3 x n, if they are many: of the weight, or
/// of an area. Their arrows are too short to be seen.
Eigen::Matrix3Xd small_loads(const record::Frame& frame);

/// Arrows of Frame::loads_N, outside the shell. The largest load of the run, `largest_N`, has an
/// arrow of longest_force() mm, others in proportion; loads below a hundredth of it are left out.
/// Loads of an area are shown by at most 25 arrows of that length, evenly over the footprint.
std::vector<LoadArrow> force_arrows(const record::Layout& layout, const record::Frame& frame,
                                    double largest_N);
inline double longest_force(const record::Layout& layout) {
  return std::clamp(1.2 * layout.spacing_mm, 0.1 * layout.length_scale_mm,
                    0.2 * layout.length_scale_mm);
}

/// Frames of a run, one at a time, from memory or from a file.
struct FrameSource {
  const record::Layout* layout = nullptr;
  int count = 0;
  std::function<Result<record::Frame>(int)> at;  ///< 0 to count - 1, in any order
};

/// The frames of a trajectory, which must outlive the source.
FrameSource source_of(const record::Trajectory& run);

/// The range of finite values; low > high if there are none.
struct Interval {
  double low = INFINITY, high = -INFINITY;
  void take(double value);
  void take(const Interval& other);
  bool any() const { return low <= high; }
};

/// The range of a quantity of cells or nodes over all frames. All frames count for the colour
/// scale, except for the deviation from the net: only those of largest actuation, since a flat
/// shell deviates by its size.
struct ColouredRange {
  /// Per index of a cell or node the largest magnitude in the frames that count, on all meshes.
  Eigen::ArrayXd most;
  Interval all;  ///< of all known values

  void take(const Eigen::VectorXd& values, bool counts);
};

/// An event or a lasting state of the shell in a frame.
enum class MarkKind { contact, unstable, motion, snap, lock, other };
struct Mark {
  int at = 0;  ///< position of the frame in the run, from 0
  MarkKind kind = MarkKind::other;
};

/// The number of nodes that rods and joints refer to: the largest index + 1.
long node_count_of(const record::Layout& layout);

/// A point of a rod between two of its nodes.
struct RodSample {
  int from = 0, to = 0;  ///< columns of Frame::nodes
  double part = 0;       ///< fraction of the distance between them
};

/// The axis of a run's timeline.
struct ProgressAxis {
  std::string name;               ///< of the quantity, with markup; empty: the number of the frame
  double first = 0, last = 1;     ///< values at the ends
  std::vector<double> positions;  ///< position of each frame between the ends, 0 to 1
  std::string unit = " mm";       ///< with the space before it
};

/// Ranges, bounds and events of a run. Every frame is passed to take() once, in order; only the
/// first one and some points of others are stored.
class RunSummary {
 public:
  /// The layout must outlive the summary. `origin`: the frame with which the frames are compared,
  /// if it is not the first of them.
  explicit RunSummary(const record::Layout& layout, const record::Frame* origin = nullptr);

  /// Takes the next frame of the run.
  void take(const record::Frame& frame);

  int frames = 0;
  record::Frame first;           ///< with which later frames are compared
  double turn_deg = 0;           ///< angle by which the camera moves around a single state; 0: none
  double depth_mm = 0;           ///< largest depth of a push; 0: no push
  double lowest_z_mm = 0;        ///< lowest point of all frames and boundaries
  double support_z_mm = 0;       ///< lowest point of both boundaries
  double largest_load_N = 0;     ///< of Frame::loads_N
  bool arrows_to_scale = false;  ///< whether lengths of load arrows are in proportion to the loads
  bool any_contacts = false;     ///< whether a frame has interpenetrations
  Interval bins_rad;             ///< mean K□ of the bins plus and minus the standard deviation
  Interval bins_change_rad;      ///< change of the means since the first frame
  double largest_move_mm = 0;    ///< largest displacement of a joint from the first frame
  std::vector<Mark> marks;       ///< in the order of frames
  std::set<int> supported;       ///< nodes with a reaction in some frame

  /// The range of a quantity (coloured_values()), except displacements, whose scale is only known
  /// after the last frame.
  const ColouredRange& spread(ColourBy by) const { return spreads_[std::size_t(by)]; }

  /// The timeline's axis: the angle of the camera, the depth of a push if it only increases, or the
  /// radius of the boundary if it only decreases; otherwise the number of the frame.
  ProgressAxis progress() const;

  /// Points that bound all frames, the boundaries that are drawn and the arrows of loads: some
  /// hundreds per frame of some dozen frames, and all points of the boundaries. They are at the
  /// same positions of the rods on every mesh and do not depend on round-off, which would move the
  /// complete picture. 3 x n, mm.
  Eigen::Matrix3Xd bounds() const;

 private:
  void sample_points(const record::Frame& frame);

  const record::Layout* layout_;
  std::array<ColouredRange, words_of<ColourBy>().size()> spreads_;
  std::vector<double> depths_mm_, radii_mm_;      ///< of every frame
  std::vector<RodSample> rod_points_;             ///< at the same positions of rods on every mesh
  double largest_actuation_ = -1;                 ///< of the frames so far
  int sample_stride_ = 1;                         ///< every so many frames have stored points
  std::vector<Eigen::Matrix3Xd> sampled_points_;  ///< points of these frames
  Eigen::Matrix3Xd last_;                         ///< points of the last frame
};

/// The summary of all frames of a run, compared with `origin` or else with the first of them.
RunSummary summarise_run(const record::Trajectory& run, const record::Frame* origin = nullptr);

/// Whether a quantity has values of cells; otherwise it has values of nodes, for the rods.
bool of_cells(ColourBy by);

/// Whether a quantity compares a frame with the first one of its run.
inline bool of_change(ColourBy by) {
  return by == ColourBy::K_change || by == ColourBy::displacement;
}

/// Whether a run may have no values of a quantity: forces and energies along the rods in a run of
/// an older version or of the net model, deviations in a run without a net.
bool may_be_missing(ColourBy by);

/// The reference of displacements and changes.
struct ColourOrigin {
  const record::Frame& first;  ///< frame of the run
  double depth_mm = 0;         ///< largest depth of the push
};

/// The values of a quantity in a frame, one per cell or node: K□ or its change (rad), deviation
/// over rho (%), displacement over depth, bending energy over length (mJ/m), axial force (N),
/// largest stress (MPa) or its ratio to the strength, angle between rods (degrees). Empty for
/// ColourBy::none, and if the frame does not have them.
Eigen::VectorXd coloured_values(ColourBy by, const record::Layout& layout,
                                const record::Frame& frame, const ColourOrigin& from);

/// The error (Fault::bad_input) of a run that has no values of a quantity in any frame.
tl::unexpected<Error> missing_values_error(ColourBy by);

/// The colour scale of a quantity: sequential for magnitudes and diverging about zero for
/// quantities with a sign, even if all values have the same sign. Its end is a quantile of `sizes`,
/// the magnitudes of the cells or nodes, so that a few extreme ones do not make the others pale,
/// and never so small that round-off is coloured; the largest stress is within the scale. `all`:
/// the range of the values.
ColourScale colour_scale(ColourBy by, std::vector<double> sizes, const Interval& all);

/// A colour bar with the symbol and the name of a quantity.
ColourBar named_bar(ColourBy by, const ColourScale& scale);

/// The colour bar for all runs that are shown together; empty if nothing is coloured. Its scale is
/// computed from the largest magnitude of each cell or node in all frames, so that it does not
/// depend on their number. Map and range of the style replace these.
std::optional<ColourBar> colour_bar_of(const std::vector<const RunSummary*>& runs,
                                       const MovieStyle& style);

}  // namespace gridshell::render
