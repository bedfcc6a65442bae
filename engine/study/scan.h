// The tops of joints in a cloud of points: what lies together is one of them.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"

namespace gridshell::study {

/// Result of the clustering of a cloud.
struct Clusters {
  Eigen::Matrix3Xd tops;    ///< middles of the discs, mm
  std::vector<int> points;  ///< of each
  int specks = 0;           ///< clusters of too few points
  int others = 0;           ///< clusters wider than a joint, or two things that touch
  /// By how much the points of a top lie off its plane, rms, of the middle one of all tops; NaN:
  /// no top has enough points to say.
  double noise_mm = record::unknown;
};

/// Points with distances below a third of `diameter_mm` are one cluster (above 1.2 diameters
/// never). A cluster with less than a quarter of the points of the median point's cluster, among
/// clusters of eight points and more if there are any (sparse points of a table are many), is a
/// speck; one that extends further than a diameter from its middle, or with a twentieth of its
/// points outside 1.25 radii, is no joint. The middle of a top is that of the disc of the diameter
/// in the points' plane which they overhang least, since their mean depends on how evenly a scanner
/// sees it; along the normal it is their mean. Errors (bad_input): points so far apart that they
/// cannot be one shell.
Result<Clusters> cluster_joint_tops(const Eigen::Matrix3Xd& cloud, double diameter_mm);

// Lays measured points on a shape whose pose is not known: rigidly, some missing, some spurious.

/// p goes to turn p + shift; `turn` is a rotation, or one with a mirror.
struct Pose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  Eigen::Matrix3Xd of(const Eigen::Matrix3Xd& points) const;
};

/// Assignment of points to the positions of a shape.
struct Registration {
  Pose pose;
  std::vector<int> point_of;  ///< for each position, -1: missing
  Eigen::VectorXd distance;   ///< for each position, NaN: missing
  int found = 0;              ///< number of positions with a point
  /// Sum over the positions of their squared distance, at most `bar`^2 each, also for missing ones.
  double cost = 0;
};

/// Lengths in the unit of the points.
struct RegistrationOptions {
  double bar = 3;        ///< largest distance of a position from a point that agrees with it
  double reach = 8;      ///< largest distance of a position from its point
  double nearest = 1.5;  ///< within that it does, however well all others lie
};

/// The pose in which most positions have a point within the bar and, among those, the cost is
/// least. The poses tried lay three points, drawn at random (always the same), on three positions
/// at their distances [Fischler and Bolles 1981]; the best are refined by alternating assignment
/// (each position its point, the nearest pairs first, none further than five medians) and fit [Besl
/// and McKay 1992; Umeyama 1991]. Empty: there are fewer than four of either, or no pose lays four
/// points on positions.
std::optional<Registration> register_points(const Eigen::Matrix3Xd& points,
                                            const Eigen::Matrix3Xd& places,
                                            const RegistrationOptions& options);

// A 3D scan against the joints of a simulated shell [Baek 2018, Figs. 2A, 3C and 5E].

/// A joint's cylinder: its top lies `height_mm` above the rods' crossing along the shell's normal.
struct JointCylinder {
  double diameter_mm = 3, height_mm = 5;
};

/// What a scan is laid on: the joints of one state, 3 x n.
struct ScanTarget {
  Eigen::Matrix3Xd joints, normals;
  double spacing_mm = 0;
  /// A reflection that preserves footprint and boundary: the mirror image of the shell is an
  /// equilibrium too.
  std::optional<Eigen::Matrix3d> mirror;
};

/// The normals are t_u x t_v of the rods at each joint, t of the quadratic through the adjacent
/// nodes.
ScanTarget form_of(const record::Layout& layout, const record::Frame& frame);

/// A scan laid on a state. Joints in the order of the form, in the frame of the run.
struct RegisteredScan {
  Eigen::Matrix3Xd joints;      ///< measured, 3 x n; NaN: missing
  Eigen::VectorXd distance_mm;  ///< from the simulated ones; NaN: missing
  Eigen::Matrix3Xd outliers;    ///< tops that belong to no joint, in the frame of the run
  Pose pose;                    ///< from the scan's frame to the run's
  bool mirrored = false;
  int found = 0, within_bar = 0;  ///< joints; of them within two radii
  int beside = 0;                 ///< outliers nearer than the spacing to where a top should be
  double rms_mm = 0, max_mm = 0, mean_mm = 0;
  double cost = 0;  ///< Registration::cost: of several states the least is the one

  int missing() const { return int(joints.cols()) - found; }
  /// The joints that are not missing.
  Eigen::Matrix3Xd measured() const;
};

/// The scan's tops on a state, rigidly or, where the form has a mirror, mirrored too. Nothing: it
/// cannot be laid on it at all.
std::optional<RegisteredScan> register_points(const Clusters& clusters, const ScanTarget& form,
                                              const JointCylinder& cylinder);

/// Mean distance of all tops along the normals outside the cylinder's height, mm, in addition to a
/// small displacement s and rotation w of the scan: the least squares of r = b n + w x p + s over
/// the joints found, r from the simulated joint p to the measured one. 0 for fewer than eight of
/// them.
double beyond_height(const RegisteredScan& scan, const ScanTarget& form);

/// How far the joints of a state that a scan shows may lie off, rms: five times the noise of the
/// scan, from a tenth of the joints' diameter to their radius; where the noise is not known the
/// radius. More than that, and in a pattern, is a dent or a shell that was built otherwise.
double match_tolerance_mm(const Clusters& clusters, const JointCylinder& cylinder);

/// Whether a registered scan shows that state: nine tenths of the joints found are within two radii
/// of the simulated ones, as are six tenths of those possible (of the joints or of the tops on the
/// shell or near it, whichever are fewer, so that a view of one side is enough), and their rms is
/// at most the tolerance.
bool scan_matches(const RegisteredScan& scan, double tolerance_mm);

}  // namespace gridshell::study
