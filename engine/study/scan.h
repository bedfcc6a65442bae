// Joints of a shell in the point cloud of a 3D scan: clusters of points, the rigid registration of
// their middles, and the comparison with a simulated state.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "engine/core/result.h"
#include "engine/record/trajectory.h"

namespace gridshell::study {

/// Result of the clustering of a cloud.
struct Clusters {
  Eigen::Matrix3Xd tops;    ///< middles of the joints' tops, 3 x n, mm
  std::vector<int> points;  ///< number of points of each top
  int specks = 0;           ///< clusters of too few points
  int others = 0;           ///< clusters wider than a joint, or two objects that touch
  /// Distance of a top's points from its plane, root mean square, the median over all tops; NaN: no
  /// top has ten points.
  double noise_mm = record::unknown;
};

/// Finds the tops of joints, discs of `diameter_mm`, in a cloud (3 x n, mm, n > 0). Points nearer
/// than a third of the diameter to one another are in one cluster, points further than 1.2
/// diameters from all others of it are not. A cluster is a speck if it has less than a quarter of
/// the points of the cluster that the median point is in (of clusters with at least eight points,
/// if there are any, since a table may leave many sparse points). It is no joint if it extends
/// further than a diameter from its mean or has a twentieth of its points outside 1.25 radii. In
/// the plane of its points the middle of a top is that of the disc which they overhang least, since
/// their mean depends on how evenly the scanner sees the top; along the normal it is their mean.
/// Errors (bad_input): points so far apart that they cannot be one shell.
Result<Clusters> cluster_joint_tops(const Eigen::Matrix3Xd& cloud, double diameter_mm);

// Rigid registration of measured points, some missing and some spurious, to a shape whose pose is
// not known.

/// The map p -> turn p + shift; `turn` is a rotation, or a rotation with a reflection.
struct Pose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  Eigen::Matrix3Xd of(const Eigen::Matrix3Xd& points) const;
};

/// Assignment of points to the positions of a shape.
struct Registration {
  Pose pose;                  ///< from the points to the shape
  std::vector<int> point_of;  ///< for each position, -1: missing
  Eigen::VectorXd distance;   ///< for each position, NaN: missing
  int found = 0;              ///< number of positions with a point
  /// Sum over the positions of their squared distance, at most `bar`^2 each, also for missing ones.
  double cost = 0;
};

/// Lengths in the unit of the points.
struct RegistrationOptions {
  double bar = 3;        ///< largest distance of a position from a point that agrees with it
  double reach = 8;      ///< largest distance of a position from the point assigned to it
  double nearest = 1.5;  ///< a point nearer than that is assigned even if all others fit better
};

/// The pose of least cost, among those tried, that maps `points` (3 x n) to the positions
/// `positions` (3 x m). A pose that is tried maps three points, drawn at random (always the same),
/// to three positions with the same distances [Fischler and Bolles 1981]. Those with which most
/// points agree are refined by alternating assignment (nearest pairs first, none further than five
/// times the median distance) and fit [Besl and McKay 1992; Umeyama 1991]. Empty: there are fewer
/// than four points or positions, or no pose maps four points to positions.
std::optional<Registration> register_points(const Eigen::Matrix3Xd& points,
                                            const Eigen::Matrix3Xd& positions,
                                            const RegistrationOptions& options);

// A 3D scan against the joints of a simulated shell [Baek 2018, Figs. 2A, 3C and 5E].

/// A joint's cylinder, whose top is `height_mm` above the rods' crossing along the shell's normal.
struct JointCylinder {
  double diameter_mm = 3, height_mm = 5;
};

/// The state to which a scan is registered.
struct ScanTarget {
  Eigen::Matrix3Xd joints, normals;  ///< positions (mm) and unit normals of the joints, 3 x n
  double spacing_mm = 0;             ///< of the rods
  /// A reflection that preserves footprint and boundary: the mirror image of the shell is an
  /// equilibrium too.
  std::optional<Eigen::Matrix3d> mirror;
};

/// The joints of a frame as the target of a scan. The normals are t_u x t_v of the two rods at each
/// joint, t the tangent of the quadratic through a rod's adjacent nodes.
ScanTarget form_of(const record::Layout& layout, const record::Frame& frame);

/// A scan registered to a state: joints in the order of ScanTarget, in the coordinates of the run.
struct RegisteredScan {
  Eigen::Matrix3Xd joints;      ///< measured positions, 3 x n; NaN: missing
  Eigen::VectorXd distance_mm;  ///< of each from the simulated joint; NaN: missing
  Eigen::Matrix3Xd outliers;    ///< tops that belong to no joint
  Pose pose;                    ///< from the scan's coordinates to the run's
  bool mirrored = false;        ///< whether the scan shows the mirror image of the state
  /// number of joints with a top; number of them within two radii of the simulated joint
  int found = 0, within_bar = 0;
  int near_outliers = 0;  ///< number of outliers nearer than the spacing to a simulated top
  double rms_mm = 0, max_mm = 0, mean_mm = 0;  ///< of the distances
  double cost = 0;  ///< Registration::cost; the state that a scan shows is the one of least cost

  int missing() const { return int(joints.cols()) - found; }
  /// The joints that are not missing.
  Eigen::Matrix3Xd measured() const;
};

/// Registers the tops of a scan to a state or, if the form has a mirror, to its mirror image,
/// whichever fits better. Empty: neither is possible (register_points() above).
std::optional<RegisteredScan> register_points(const Clusters& clusters, const ScanTarget& form,
                                              const JointCylinder& cylinder);

/// The height b (mm) by which tops are further along their normals n than the cylinder's height.
/// A least-squares fit of r = b n + w x p + s over the joints found, where r leads from the
/// simulated joint p to the measured one, and s and w are a small displacement and rotation of the
/// scan. 0 if fewer than eight joints were found.
double excess_height(const RegisteredScan& scan, const ScanTarget& form);

/// The largest rms distance (mm) of measured from simulated joints at which a scan shows a state:
/// five times the noise of the scan, but at least a tenth of the joints' diameter and at most their
/// radius; the radius if the noise is not known. A larger distance is a dent, or a shell that was
/// built otherwise.
double match_tolerance_mm(const Clusters& clusters, const JointCylinder& cylinder);

/// Whether a registered scan shows its state. At least 0.9 of the joints found are then within two
/// radii of the simulated ones. So are at least 0.6 of the smaller of two numbers: all joints, or
/// all tops on the shell or near it (so that a view of one side is enough). The rms distance is at
/// most the tolerance.
bool scan_matches(const RegisteredScan& scan, double tolerance_mm);

}  // namespace gridshell::study
