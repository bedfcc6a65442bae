#include "engine/footprint/curve_domain.h"

#include <algorithm>

namespace gridshell {

CurveDomain::CurveDomain(ClosedCurve curve) : curve_(std::move(curve)) {
  constexpr int samples = 4096;
  for (int k = 0; k < samples; ++k)
    reach_ =
        std::max(reach_, curve_.at(curve_.last() * k / samples).position.lpNorm<Eigen::Infinity>());
  for (const double t : curve_.breaks())
    reach_ = std::max(reach_, curve_.at(t).position.lpNorm<Eigen::Infinity>());
  // between samples a smooth curve reaches a little further
  reach_ *= 1 + 1e-5;
}

std::vector<Interval> CurveDomain::intervals(Family family, double c) const {
  const int along = family == Family::u ? 0 : 1;
  std::vector<double> places;
  for (const double t : curve_.crossings(1 - along, c))
    places.push_back(curve_.at(t).position[along]);
  std::sort(places.begin(), places.end());
  std::vector<Interval> pieces;
  for (std::size_t k = 0; k + 1 < places.size(); k += 2)
    if (places[k] < places[k + 1]) pieces.push_back({places[k], places[k + 1]});
  return pieces;
}

Eigen::Matrix2Xd CurveDomain::boundary(int points) const {
  const std::vector<double>& breaks = curve_.breaks();
  const auto pieces = static_cast<int>(breaks.size()) - 1;
  Eigen::Matrix2Xd ring(2, points);
  if (points < pieces) {
    for (int k = 0; k < points; ++k)
      ring.col(k) = curve_.at(curve_.at_arc_length(curve_.length() * k / points)).position;
    return ring;
  }
  // each piece has its share of the points, from its first corner on
  int first = 0;
  for (int k = 0; k < pieces; ++k) {
    const double from = curve_.arc_length(breaks[k]), to = curve_.arc_length(breaks[k + 1]);
    const auto share = static_cast<int>(points * to / curve_.length() + 0.5);
    const int end =
        k + 1 == pieces ? points : std::clamp(share, first + 1, points - (pieces - k - 1));
    for (int n = first; n < end; ++n)
      ring.col(n) =
          curve_.at(curve_.at_arc_length(from + (to - from) * (n - first) / (end - first)))
              .position;
    first = end;
  }
  return ring;
}

}  // namespace gridshell
