// Domains in the (u, v) plane: the inside of a closed curve, and the parts of Chebyshev nets that
// boundaries enclose.
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/footprint/footprint.h"
#include "engine/geometry/chebyshev_net.h"
#include "engine/geometry/closed_curve.h"
#include "engine/geometry/marched_net.h"
#include "engine/geometry/revolution_net.h"
#include "engine/geometry/surface_net.h"

namespace gridshell {

/// The inside of a closed curve. A curve that is not convex may cut a grid line more than once.
class CurveDomain final : public Domain {
 public:
  explicit CurveDomain(ClosedCurve curve);
  std::vector<Interval> intervals(Family family, double c) const override;
  /// The boundary evenly by arc length between corners, with all corners if `points` is large
  /// enough.
  Eigen::Matrix2Xd boundary(int points) const override;
  double reach() const override { return reach_; }

 private:
  ClosedCurve curve_;
  double reach_ = 0;
};

// Original boundaries b that a net maps to a given boundary a, C(b) = a [Baek 2018, eq. 3].

/// The part of Chebyshev's net above the plane z = cut_height rho. Crossings of grid lines with the
/// plane are solved to round-off (bracketed Newton iteration); boundary() takes even polar angles.
/// Errors (bad_input): cut_height not in [0, 1).
Result<std::unique_ptr<Domain>> cap_of(const SphereNet& net, double cut_height);

/// The upper half, |phi| <= pi/2, of a surface of revolution between two rings at a distance of
/// `length_mm` along the axis, centred at the net's middle. Its long edges are in z = 0. In the
/// footprint it is a rectangle along the diagonal u = v. boundary() contains all four corners.
/// Errors (bad_input): length not positive; the net folds or ends before, with the position.
Result<std::unique_ptr<Domain>> half_of(const RevolutionNet& net, double length_mm);

/// The upper half of a surface of revolution between the two ends of the net, where its profile
/// ends or the net folds.
std::unique_ptr<Domain> half_of_all(const RevolutionNet& net);

/// All of a translation net: a rectangle along u and v.
std::unique_ptr<Domain> all_of(const TranslationNet& net);

// The part of a net on a surface that its boundary encloses.

/// The part of a net in which `outside` is below zero and which is connected to the apex. Crossings
/// of grid lines with the boundary are solved to round-off; pieces shorter than the net's grid may
/// be missed. boundary() takes even polar angles in (u, v). Errors (bad_input): a ray from the apex
/// crosses the boundary more than once.
Result<std::unique_ptr<Domain>> part_of(std::shared_ptr<const SurfaceNet> net,
                                        Surface::Function outside);

/// The part of a net that its rods reach from its apex. Grid lines end, to round-off, where the net
/// meets a line of the mesh. Pieces shorter than four of the net's chords are left out: such short
/// rods would be compressed instead of bent. boundary() is the outer edge, without holes, at points
/// where it crosses the net's grid.
std::unique_ptr<Domain> reached_part(std::shared_ptr<const MarchedNet> net);

}  // namespace gridshell
