// The inside of a closed curve that a user gives.
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

/// Grid lines are cut where they cross the curve; a curve with hollows cuts a line more than once.
class CurveDomain final : public Domain {
 public:
  explicit CurveDomain(ClosedCurve curve);
  std::vector<Interval> intervals(Family family, double c) const override;
  /// evenly by arc length between corners, all corners among them where `points` allows
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

/// The upper half of a surface of revolution, between two rings `length` apart along the axis and
/// centred at the net's middle: |phi| <= pi/2, so that its long edges lie in z = 0. In the
/// footprint a rectangle along the diagonal u = v. boundary() has all four corners. Errors
/// (bad_input): length not positive; the net folds or ends before (says where).
Result<std::unique_ptr<Domain>> half_of(const RevolutionNet& net, double length_mm);

/// Half of the net between the two ends of the net, where its profile ends or it folds.
std::unique_ptr<Domain> half_of_all(const RevolutionNet& net);

/// All of a translation net: a rectangle along u and v.
std::unique_ptr<Domain> all_of(const TranslationNet& net);

// The part of a net on a surface that its boundary encloses.

/// Where `outside` is below zero on a net, as far as that is joined to the apex. Grid lines are cut
/// to round-off; pieces shorter than the net's grid may be overlooked. boundary() takes even polar
/// angles in (u, v). Errors (bad_input): a ray from the apex crosses the boundary more than once.
Result<std::unique_ptr<Domain>> part_of(std::shared_ptr<const SurfaceNet> net,
                                        Surface::Function outside);

/// All that a net's rods reach from its apex. Grid lines are cut to round-off where they meet a
/// line of the mesh; pieces shorter than four of the net's chords are left out: rods that short
/// bear no compression without stretching. boundary() is the outer edge, without holes, at points
/// where it crosses the net's grid.
std::unique_ptr<Domain> reached_part(std::shared_ptr<const MarchedNet> net);

}  // namespace gridshell
