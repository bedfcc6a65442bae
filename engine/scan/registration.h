// Lays measured points on a shape whose pose is not known: rigidly, some missing, some spurious.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace gridshell {

/// p goes to turn p + shift; `turn` is a rotation, or one with a mirror.
struct Pose {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();

  Eigen::Matrix3Xd of(const Eigen::Matrix3Xd& points) const {
    return (turn * points).colwise() + shift;
  }
};

/// How points lie on the places of a shape.
struct Registration {
  Pose pose;
  std::vector<int> point_of;  ///< of each place, -1: missing
  Eigen::VectorXd distance;   ///< of each place, NaN: missing
  int found = 0;              ///< places with a point
  /// Sum over the places of their squared distance, at most `bar`^2 each, a missing one's too.
  double cost = 0;
};

/// Lengths in the unit of the points.
struct RegistrationOptions {
  double bar = 3;        ///< places nearer to a point than that agree with it
  double reach = 8;      ///< no point belongs to a place further away
  double nearest = 1.5;  ///< within that it does, however well all others lie
};

/// The pose in which most places have a point within the bar and, among those, the cost is least.
/// Poses are tried that lay three points, drawn at random (always the same), on three places at
/// their distances [Fischler and Bolles 1981]; the best are refined by turns of assignment (each
/// place its point, the nearest pairs first, none further than five medians of all) and fit [Besl
/// and McKay 1992; Umeyama 1991]. Nothing: there are fewer than four of either, or no pose lays
/// four points on places.
std::optional<Registration> lay_on(const Eigen::Matrix3Xd& points, const Eigen::Matrix3Xd& places,
                                   const RegistrationOptions& options);

}  // namespace gridshell
