// A 3D scan against the joints of a simulated shell [Baek 2018, Figs. 2A, 3C and 5E].
#pragma once

#include <Eigen/Core>
#include <optional>

#include "engine/record/snapshot.h"
#include "engine/scan/clusters.h"
#include "engine/scan/registration.h"

namespace gridshell {

/// A joint's cylinder: its top lies `height_mm` above the rods' crossing along the shell's normal.
struct JointCylinder {
  double diameter_mm = 3, height_mm = 5;
};

/// What a scan is laid on: the joints of one state, 3 x n.
struct ScannedForm {
  Eigen::Matrix3Xd joints, normals;
  double spacing_mm = 0;
  /// A mirror that leaves footprint and boundary as they are: the shell may rest in the mirror
  /// image as well.
  std::optional<Eigen::Matrix3d> mirror;
};

/// The normals are t_u x t_v of the rods at each joint, t of the quadratic through the nodes beside
/// it.
ScannedForm form_of(const record::Layout& layout, const record::Frame& frame);

/// A scan laid on a state. Joints in the order of the form, in the frame of the run.
struct LaidScan {
  Eigen::Matrix3Xd joints;      ///< measured, 3 x n; NaN: missing
  Eigen::VectorXd distance_mm;  ///< from the simulated ones; NaN: missing
  Eigen::Matrix3Xd outliers;    ///< tops that belong to no joint, in the frame of the run
  Pose pose;                    ///< from the scan's frame to the run's
  bool mirrored = false;
  int found = 0, within_bar = 0;  ///< joints; of them within two radii
  double rms_mm = 0, max_mm = 0, mean_mm = 0;
  double cost = 0;  ///< Registration::cost: of several states the least is the one

  int missing() const { return int(joints.cols()) - found; }
  /// The joints that are not missing.
  Eigen::Matrix3Xd measured() const;
};

/// The scan's tops on a state, rigidly or, where the form has a mirror, mirrored too. Nothing: it
/// cannot be laid on it at all.
std::optional<LaidScan> lay_on(const Clusters& clusters, const ScannedForm& form,
                               const JointCylinder& cylinder);

/// Whether a scan laid so shows that state: nine tenths of the joints found lie within two radii of
/// the simulated ones, as do seven tenths of what could (of the joints or of the tops, whichever
/// are fewer), and their rms is at most a radius.
bool shows_state(const LaidScan& scan, const JointCylinder& cylinder);

}  // namespace gridshell
