// Original boundaries b that a net maps to a wanted boundary a, C(b) = a [Baek 2018, eq. 3].
#pragma once

#include <memory>

#include "engine/core/result.h"
#include "engine/footprint/domain.h"
#include "engine/geometry/revolution_net.h"
#include "engine/geometry/sphere_net.h"
#include "engine/geometry/translation_net.h"

namespace gridshell {

/// The part of Chebyshev's net above the plane z = cut_height rho. Crossings of grid lines with the
/// plane are solved to round-off (bracketed Newton iteration); boundary() takes even polar angles.
/// Errors (bad_input): cut_height not in [0, 1).
Result<std::unique_ptr<Domain>> cap_of(const SphereNet& net, double cut_height);

/// The upper half of a surface of revolution, between two rings `length` apart along the axis and
/// centred at the net's middle: |phi| <= pi/2, so that its long edges lie in z = 0. In the
/// footprint a rectangle along the diagonal u = v. boundary() has all four corners. Errors
/// (bad_input): length not positive; the net folds or ends before (says where).
Result<std::unique_ptr<Domain>> half_of(const RevolutionNet& net, double length_mm);

/// The same between the two ends of the net, where its profile ends or it folds.
std::unique_ptr<Domain> half_of_all(const RevolutionNet& net);

/// All of a translation net: a rectangle along u and v.
std::unique_ptr<Domain> all_of(const TranslationNet& net);

}  // namespace gridshell
