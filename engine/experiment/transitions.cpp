#include "engine/experiment/transitions.h"

#include <algorithm>

#include "engine/core/parallel.h"
#include "engine/experiment/state_book.h"
#include "engine/experiment/state_measures.h"

namespace gridshell::experiment {
namespace {

constexpr int pokes = 8, ways = pokes + 1;  // of a state; the first lets the boundary out
constexpr double beyond = 0.98;             // of the progress at which a state ends
constexpr int nowhere = -1;

void count(std::vector<record::Transition>& all, int from, int to, const char* by) {
  const auto known = std::ranges::find_if(all, [&](const record::Transition& way) {
    return way.from == from && way.to == to && way.by == by;
  });
  if (known != all.end())
    ++known->count;
  else
    all.push_back({from, to, by, 1});
}

}  // namespace

Result<std::vector<record::Transition>> ways_between(const StateLibrary& library,
                                                     const std::shared_ptr<const Scene>& scene,
                                                     const preset::Jitter& jitter, int threads,
                                                     double begun, double end, Watch& watch) {
  const auto& states = library.states;
  const int followed = std::min(jitter.transitions, int(states.size()));
  const std::vector<PartlyActuated> none;
  const auto make = [&] { return Jitter::make(scene, jitter, none); };
  auto judge = make();
  if (!judge) return tl::unexpected<Error>(judge.error());
  const Eigen::Index joints = judge->cascade().finest().joints;
  StateBook book(judge->symmetries(), jitter.tolerance * scene->footprint.spacing);
  for (const ShellState& state : states) book.enter(state.rest.x.leftCols(joints), state.energy_mJ);
  std::vector<int> to(std::size_t(followed * ways), nowhere);
  const auto follow = [&](Jitter& hand, int k) {
    const ShellState& from = states[std::size_t(k / ways)];
    const int way = k % ways;
    const auto rest = way == 0 ? hand.let_out(from.rest, beyond * from.row.lives_to, watch)
                               : hand.poked(from.rest, way, watch);
    if (!rest) return;
    const auto at = book.find(rest->x.leftCols(joints), hand.cascade().system().energy_at(*rest));
    to[std::size_t(k)] = at ? states[*at].row.state : 0;
  };
  const auto shared = share_work(int(to.size()), threads, watch, make, follow, [&](double share) {
    watch.report(begun + (end - begun) * share);
  });
  if (!shared) return tl::unexpected<Error>(shared.error());
  std::vector<record::Transition> all;
  for (std::size_t k = 0; k < to.size(); ++k)
    if (to[k] != nowhere)
      count(all, states[k / ways].row.state, to[k], k % ways == 0 ? "let out" : "poked");
  return all;
}

}  // namespace gridshell::experiment
