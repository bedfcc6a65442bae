#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "engine/core/parallel.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/study/mountain_pass.h"
#include "engine/study/state_library.h"

namespace gridshell::study {
namespace {

using record::Disturbance;
using record::StateName;

constexpr int pushes = 8, paths = pushes + 1;  // per state; on the first the boundary is released
constexpr double end_fraction = 0.98;          // times the progress at which a state ends

/// Perturbs states on the mesh of judged_edges, and identifies those of a library by their joints
/// on that mesh; one object per thread.
struct Explorer {
  StateSearcher hand;
  StateCatalogue catalogue;
  const StateLibrary* library;

  static Result<Explorer> make(const StateLibrary& library,
                               const std::shared_ptr<const Scene>& scene,
                               const preset::SearchSettings& jitter) {
    static const std::vector<StartForm> no_forms;
    TRY(hand, StateSearcher::make(scene, jitter, no_forms));
    StateCatalogue catalogue(hand->symmetries(), jitter.tolerance * scene->footprint.spacing);
    for (const ShellState& state : library.states)
      catalogue.enter(hand->joints_of(state.rest), state.energy_mJ);
    return Explorer{std::move(*hand), std::move(catalogue), &library};
  }

  /// The library's state with these joints and energy, or 0.
  StateName name_of(const State& rest, double energy_mJ) const {
    const auto at = catalogue.find(hand.joints_of(rest), energy_mJ);
    return at ? library->states[*at].row.in_tables() : StateName{};
  }
};

void count(std::vector<record::Transition>& all, StateName from, StateName to, Disturbance by) {
  const auto known = std::ranges::find_if(all, [&](const record::Transition& one) {
    return one.from == from && one.to == to && one.by == by;
  });
  if (known != all.end())
    ++known->count;
  else
    all.push_back({from, to, by, 1});
}

constexpr int neighbours = 2;         // paths from each state
constexpr double step_down_mm = 0.5;  // of the descent from a saddle
constexpr double step_over_d = 0.1;   // largest step of a point of the path between two states

/// Two states to be joined by a path, and the symmetry whose image of the second is nearest to the
/// first.
struct Pairing {
  std::size_t from = 0, to = 0, symmetry = 0;
};

/// A pass and the states to which the descents on its two sides lead.
struct Crossing {
  StateName from, to;  ///< as Barrier
  double from_mJ = 0, to_mJ = 0;
  MountainPass pass;
};

/// Looks for passes between the states of an explorer's library.
class Crossings {
 public:
  Crossings(Explorer explorer, double spacing)
      : explorer_(std::move(explorer)), spacing_(spacing) {}

  /// Each state with the nearest others, each pair once. The nearest image under a symmetry is
  /// chosen if the model has no twist angles, otherwise the state itself.
  std::vector<Pairing> pairings(const std::vector<std::size_t>& drawn) const {
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    std::vector<Pairing> all;
    for (const std::size_t from : drawn) {
      std::vector<std::pair<double, Pairing>> others;
      for (const std::size_t to : drawn)
        if (to != from) others.push_back(nearest(from, to));
      const std::size_t kept = std::min(others.size(), std::size_t(neighbours));
      std::ranges::partial_sort(others, others.begin() + std::ptrdiff_t(kept), {},
                                &std::pair<double, Pairing>::first);
      for (std::size_t k = 0; k < kept; ++k)
        if (pairs.insert(std::minmax(from, others[k].second.to)).second)
          all.push_back(others[k].second);
    }
    return all;
  }

  std::optional<Crossing> cross(const Pairing& pair, const Watch& watch) {
    MultilevelRelaxation& cascade = explorer_.hand.cascade();
    Linearisation& system = cascade.system();
    const MeshSymmetry& symmetry = explorer_.hand.symmetries()[pair.symmetry];
    State target = rest_of(pair.to);
    if (symmetry.index != 0) {
      const auto image = symmetry.of(nodes(pair.to));
      target = start_state(cascade.model(), columns_of(cascade.finest(), cascade.model(), image));
      auto rest = find_equilibrium(system, target, spacing_, watch);
      if (!rest) return std::nullopt;
      target = std::move(*rest);
    }
    Crossing crossing;
    crossing.pass =
        mountain_pass(system, rest_of(pair.from), target, step_over_d * spacing_, watch);
    if (crossing.pass.outcome != Outcome::reached) return std::nullopt;
    const bool back =
        descend(crossing.pass, BranchSide::against, crossing.from, crossing.from_mJ, watch);
    const bool on = descend(crossing.pass, BranchSide::along, crossing.to, crossing.to_mJ, watch);
    if (!back || !on) return std::nullopt;
    return crossing;
  }

 private:
  const State& rest_of(std::size_t state) const { return explorer_.library->states[state].rest; }

  Eigen::Matrix3Xd nodes(std::size_t state) const {
    const MultilevelRelaxation& cascade = explorer_.hand.cascade();
    return nodes_of(cascade.finest(), cascade.model(), rest_of(state).x);
  }

  std::pair<double, Pairing> nearest(std::size_t from, std::size_t to) const {
    std::pair<double, Pairing> best{std::numeric_limits<double>::infinity(), {from, to, 0}};
    const StateSearcher& hand = explorer_.hand;
    const Eigen::Index joints = hand.cascade().finest().joints;
    const bool turns = !hand.cascade().model().has_spins();
    for (std::size_t k = 0; k < hand.symmetries().size(); ++k) {
      const MeshSymmetry& symmetry = hand.symmetries()[k];
      if (symmetry.index != 0 && !turns) continue;
      const double away =
          distance_under(symmetry, nodes(from).leftCols(joints), nodes(to).leftCols(joints));
      if (away < best.first) best = {away, {from, to, k}};
    }
    return best;
  }

  bool descend(const MountainPass& pass, BranchSide side, StateName& state, double& energy,
               const Watch& watch) {
    BranchSwitch departure;
    departure.side = side;
    departure.amplitude_mm = departure.step_mm = step_down_mm;
    const auto rest = leave_saddle(explorer_.hand.cascade().system(), pass.saddle, pass.towards_b,
                                   departure, watch);
    if (!rest) return false;
    energy = explorer_.hand.energy_of(*rest);
    state = explorer_.name_of(*rest, energy);
    return true;
  }

  Explorer explorer_;
  double spacing_;
};

record::Barrier barrier_of(const Crossing& crossing) {
  record::Barrier barrier{crossing.from, crossing.to, crossing.pass.energy_mJ};
  barrier.barrier_mJ = crossing.pass.energy_mJ - crossing.from_mJ;
  barrier.back_mJ = crossing.pass.energy_mJ - crossing.to_mJ;
  barrier.residual_N = crossing.pass.residual_N;
  // from the state that is in the library, and of two such states from the lower
  if (barrier.from == 0 || (barrier.to != 0 && barrier.to < barrier.from)) {
    std::swap(barrier.from, barrier.to);
    std::swap(barrier.barrier_mJ, barrier.back_mJ);
  }
  return barrier;
}

/// The lowest of several passes between the same two states, in the order of the states. A pass
/// between two states that are not in the library is ignored.
std::vector<record::Barrier> lowest_each(std::vector<record::Barrier> all) {
  std::erase_if(all, [](const record::Barrier& one) { return one.from == 0; });
  std::ranges::stable_sort(all, {}, [](const record::Barrier& one) {
    return std::tuple(one.from, one.to, one.energy_mJ);
  });
  const auto same = [](const record::Barrier& a, const record::Barrier& b) {
    return a.from == b.from && a.to == b.to;
  };
  all.erase(std::unique(all.begin(), all.end(), same), all.end());
  return all;
}

}  // namespace

Result<std::vector<record::Transition>> transitions_between(
    const StateLibrary& library, const std::shared_ptr<const Scene>& scene,
    const preset::SearchSettings& jitter, int threads, double begun, double end, Watch& watch) {
  const auto& states = library.states;
  const int followed = std::min(jitter.transitions, int(states.size()));
  std::vector<std::optional<StateName>> to(std::size_t(followed * paths));
  const auto follow = [&](Explorer& explorer, int k) {
    const ShellState& from = states[std::size_t(k / paths)];
    const int path = k % paths;
    // the range of a state whose equilibrium was not found again is unknown
    if (path == 0 && !std::isfinite(from.row.lives_to)) return;
    StateSearcher& hand = explorer.hand;
    const auto rest =
        path == 0 ? hand.release_boundary(from.rest, end_fraction * from.row.lives_to, watch)
                  : hand.push_at_random(from.rest, path, watch);
    if (rest) to[std::size_t(k)] = explorer.name_of(*rest, hand.energy_of(*rest));
  };
  TRY_DO(parallel_for(
      int(to.size()), threads, watch, [&] { return Explorer::make(library, scene, jitter); },
      follow, reporting(watch, begun, end)));
  std::vector<record::Transition> all;
  for (std::size_t k = 0; k < to.size(); ++k)
    if (to[k])
      count(all, states[k / paths].row.in_tables(), *to[k],
            k % paths == 0 ? Disturbance::released : Disturbance::pushed);
  return all;
}

Result<std::vector<record::Barrier>> barriers_between(StateLibrary& library,
                                                      const std::shared_ptr<const Scene>& scene,
                                                      const preset::SearchSettings& jitter,
                                                      int threads, double begun, double end,
                                                      Watch& watch) {
  const auto make = [&]() -> Result<Crossings> {
    TRY(explorer, Explorer::make(library, scene, jitter));
    return Crossings(std::move(*explorer), scene->footprint.spacing);
  };
  std::vector<record::StateRow> rows;
  for (const ShellState& state : library.states) rows.push_back(state.row);
  TRY(first, make());
  const auto pairs = first->pairings(record::states_to_draw(rows, jitter.drawn));
  std::vector<std::optional<Crossing>> found(pairs.size());
  const auto cross = [&](Crossings& crossings, int k) {
    found[std::size_t(k)] = crossings.cross(pairs[std::size_t(k)], watch);
  };
  TRY_DO(
      parallel_for(int(pairs.size()), threads, watch, make, cross, reporting(watch, begun, end)));
  std::vector<record::Barrier> all;
  for (const auto& crossing : found)
    if (crossing) all.push_back(barrier_of(*crossing));
  library.search.paths_followed_for_barriers = int(pairs.size());
  library.search.passes_found = int(all.size());
  for (const record::Barrier& one : all)
    for (const auto& [state, height] :
         {std::pair(one.from, one.barrier_mJ), {one.to, one.back_mJ}}) {
      if (state == 0) continue;
      double& lowest = library.states[std::size_t(state) - 1].row.barrier_mJ;
      if (!(lowest <= height)) lowest = height;
    }
  return lowest_each(std::move(all));
}

}  // namespace gridshell::study
