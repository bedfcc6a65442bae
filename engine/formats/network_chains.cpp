// Joins lines of a drawing that meet end to end to rods, and removes points that are not needed.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <tuple>

#include "engine/core/algorithms.h"
#include "engine/core/dense.h"
#include "engine/core/try.h"
#include "engine/formats/network_file.h"

namespace gridshell::preset {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr std::size_t most_ends = 100;  // largest number of ends at one point
constexpr double turn_a_piece_deg = 3;  // angle between two pieces of a curve
constexpr double straight_deg = 0.1;

/// Angle by which a polyline turns at its middle point, rad.
double turn_at(const NetworkData& network, int before, int at, int after) {
  const Eigen::Vector3d in = position_of(network, at) - position_of(network, before),
                        out = position_of(network, after) - position_of(network, at);
  return angle_between(in, out);
}

/// An end of a line: `number` is 2 r for the start and 2 r + 1 for the end of line r.
struct LineEnd {
  int number, point, before;  ///< its point, and the point next to it
};

std::map<int, std::vector<LineEnd>> ends_at_points(const NetworkData& network) {
  std::map<int, std::vector<LineEnd>> ends;
  for (std::size_t r = 0; r < network.rods.size(); ++r) {
    const std::vector<int>& rod = network.rods[r];
    if (rod.front() == rod.back()) continue;
    ends[rod.front()].push_back({int(2 * r), rod.front(), rod[1]});
    ends[rod.back()].push_back({int(2 * r + 1), rod.back(), rod[rod.size() - 2]});
  }
  return ends;
}

/// For each end the end of another line that continues it; -1: none.
Result<std::vector<int>> continuations(const NetworkData& network,
                                       const std::vector<std::string>& locations) {
  std::vector<int> partner(2 * network.rods.size(), -1);
  for (const auto& [point, ends] : ends_at_points(network)) {
    if (ends.size() > most_ends)
      return invalid("{}: got an end at that of {} other lines, expected at most {}",
                     locations[std::size_t(ends.back().number / 2)], ends.size() - 1, most_ends);
    std::vector<std::tuple<double, int, int>> pairs;
    for (std::size_t a = 0; a < ends.size(); ++a)
      for (std::size_t b = a + 1; b < ends.size(); ++b)
        if (const double turn = turn_at(network, ends[a].before, point, ends[b].before);
            turn <= most_turn_deg * degree)
          pairs.emplace_back(turn, ends[a].number, ends[b].number);
    std::ranges::sort(pairs);
    for (const auto& [turn, a, b] : pairs)
      if (partner[std::size_t(a)] < 0 && partner[std::size_t(b)] < 0) {
        partner[std::size_t(a)] = b;
        partner[std::size_t(b)] = a;
      }
  }
  return partner;
}

/// Number of pieces that a curve between two points `first` and `last` of a rod needs.
std::size_t pieces_of(const NetworkData& network, const std::vector<int>& rod, std::size_t first,
                      std::size_t last) {
  double turn = 0;
  for (std::size_t k = first + 1; k < last; ++k)
    turn += turn_at(network, rod[k - 1], rod[k], rod[k + 1]);
  return std::max(std::size_t(1),
                  std::size_t(std::ceil(turn / (turn_a_piece_deg * degree) - 1e-6)));
}

}  // namespace

Result<int> NetworkBuilder::join_in_line() {
  TRY(partner, continuations(network_, locations_));
  const int met = int(std::ranges::count_if(*partner, [](int other) { return other >= 0; }) / 2);
  if (met > 0) chain(*partner);
  return met;
}

/// Joins lines to rods; `partner` has for each end the end that continues it; -1: none.
void NetworkBuilder::chain(const std::vector<int>& partner) {
  std::vector<std::vector<int>> rods;
  std::vector<std::string> locations;
  std::vector<char> taken(network_.rods.size(), 0);
  const auto follow = [&](std::size_t first, bool reversed) {
    std::vector<int> chain;
    locations.push_back(locations_[first]);
    for (std::size_t rod = first; taken[rod] == 0;) {
      taken[rod] = 1;
      std::vector<int> points = network_.rods[rod];
      if (reversed) std::ranges::reverse(points);
      if (!chain.empty()) seams_.insert(points.front());
      chain.insert(chain.end(), points.begin() + (chain.empty() ? 0 : 1), points.end());
      const int next = partner[2 * rod + (reversed ? 0 : 1)];
      if (next < 0) break;
      rod = std::size_t(next / 2);
      reversed = next % 2 == 1;
    }
    rods.push_back(std::move(chain));
  };
  for (std::size_t r = 0; r < network_.rods.size(); ++r)
    if (taken[r] == 0 && (partner[2 * r] < 0 || partner[2 * r + 1] < 0))
      follow(r, partner[2 * r] >= 0);
  for (std::size_t r = 0; r < network_.rods.size(); ++r)
    if (taken[r] == 0) follow(r, false);
  network_.rods = std::move(rods);
  network_.diameters.assign(network_.rods.size(), 0);
  locations_ = std::move(locations);
}

void NetworkBuilder::thin_out() {
  if (samples_.empty() && seams_.empty()) return;
  const std::vector<PointUse> uses = uses_of(points(), network_.rods);
  const auto alone = [&](const std::set<int>& of, int point) {
    const auto [passes, ends] = uses[std::size_t(point)];
    return of.contains(point) && passes + ends == 1;
  };
  for (std::vector<int>& rod : network_.rods) {
    std::vector<int> left{rod.front()};
    for (std::size_t k = 1; k < rod.size(); ++k) {
      const std::size_t first = k - 1;
      while (k + 1 < rod.size() && alone(samples_, rod[k])) ++k;
      const std::size_t pieces = k > first + 1 ? pieces_of(network_, rod, first, k) : 1;
      for (std::size_t piece = 1; piece < pieces; ++piece)
        left.push_back(rod[first + (piece * (k - first) + pieces / 2) / pieces]);
      left.push_back(rod[k]);
    }
    left.erase(std::unique(left.begin(), left.end()), left.end());
    std::vector<int> points{left.front()};
    for (std::size_t k = 1; k < left.size(); ++k)
      if (k + 1 == left.size() || !alone(seams_, left[k]) ||
          turn_at(network_, points.back(), left[k], left[k + 1]) > straight_deg * degree)
        points.push_back(left[k]);
    rod = std::move(points);
  }
}

}  // namespace gridshell::preset
