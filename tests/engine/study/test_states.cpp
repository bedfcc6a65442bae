// Searches for the states of a shell.
#include "engine/study/state_library.h"

#include "tests/presets.h"

using namespace gridshell;
using study::find_states;
using study::StateLibrary;

namespace {

preset::Preset shell(int rods) {
  preset::Preset p = paper_circle(rods);
  p.accuracy.edges_per_segment = 8;
  return p;
}

StateLibrary states_of(const preset::Preset& preset, int threads = 1, bool lives = false) {
  const auto scene = std::make_shared<const Scene>(scene_of(preset).value());
  Watch watch;
  return value_of(find_states(scene, preset.jitter, {.threads = threads, .lives = lives}, watch));
}

const record::StateRow* of_class(const StateLibrary& library, record::StateClass kind) {
  for (const auto& state : library.states)
    if (state.row.kind == kind) return &state.row;
  return nullptr;
}

}  // namespace

TEST_CASE("states: the same whatever the threads, each once, in the order of energy") {
  preset::Preset p = shell(6);
  p.jitter.trials = 16;
  p.jitter.confined = 7;
  const StateLibrary one = states_of(p), two = states_of(p, 2);
  REQUIRE(one.states.size() > 1);
  REQUIRE(one.states.size() == two.states.size());
  std::vector<record::StateRow> rows, others;
  for (const auto& state : one.states) rows.push_back(state.row);
  for (const auto& state : two.states) others.push_back(state.row);
  CHECK(record::csv_table(rows) == record::csv_table(others));
  int met = 0, confined = 0;
  for (std::size_t k = 0; k < rows.size(); ++k) {
    CHECK(rows[k].state == int(k) + 1);
    CHECK(one.states[k].frame.negative_pivots == 0);
    CHECK(one.states[k].frame.nodes == two.states[k].frame.nodes);
    if (k > 0) CHECK(rows[k - 1].energy_mJ() <= rows[k].energy_mJ());
    met += rows[k].count;
    confined += rows[k].count_confined;
    // upright, as up and down are equivalent
    CHECK(one.states[k].frame.nodes.row(2).mean() > 0);
  }
  CHECK(met + confined <= one.search.at_rest + one.search.confined_at_rest);
  CHECK(one.search.at_rest >= 14);
}

TEST_CASE("states: gravity and pokes end in stable states, too") {
  preset::Preset p = shell(6);
  p.jitter.trials = 6;
  for (const auto mode : {preset::SearchMode::gravity, preset::SearchMode::poke}) {
    p.jitter.mode = mode;
    p.jitter.field_N_per_mm = 5e-3;
    const StateLibrary found = states_of(p);
    CAPTURE(found.search.mode);
    CHECK(found.search.at_rest >= 5);
    for (const auto& state : found.states) CHECK(state.frame.negative_pivots == 0);
  }
}

TEST_CASE("states: a search that cannot be is an error with its reason") {
  preset::Preset p = shell(4);
  p.jitter.trials = 2;
  const auto scene = std::make_shared<const Scene>(scene_of(p).value());
  check_stops([&](Watch& watch) { return find_states(scene, p.jitter, {}, watch); });
  p.limits.max_strain = 1e-12;
  const auto strained = std::make_shared<const Scene>(scene_of(p).value());
  Watch other;
  CHECK(refusal(find_states(strained, p.jitter, {}, other), Fault::no_equilibrium) ==
        "finer meshes have none of the stable states in which 2 of 2 trials ended");
}

TEST_CASE("states report all terms of their energy") {
  preset::Preset p = shell(6);
  p.accuracy.model = RodModel::twist;
  p.rod.shear_GPa = 31;
  p.joints.shear_Nmm = 0.3;
  p.jitter.trials = 2;
  const StateLibrary found = states_of(p);
  REQUIRE_FALSE(found.states.empty());
  for (const auto& state : found.states) {
    CHECK(state.row.energies[Term::shear] > 0.01);
    CHECK(state.row.energy_mJ() == state.frame.energies.total());
  }
}

TEST_CASE("states: the three of the paper at twelve rods, in their order", "[standard]") {
  preset::Preset p = shell(12);
  p.accuracy = {};
  p.accuracy.tolerance = 1e-4;
  p.jitter.trials = 10;
  p.jitter.confined = 42;
  const StateLibrary found = states_of(p, 2);
  using record::StateClass;
  const auto *ii = of_class(found, StateClass::ii), *iii = of_class(found, StateClass::iii),
             *iv = of_class(found, StateClass::iv);
  REQUIRE(iv);
  REQUIRE(ii);
  REQUIRE(iii);
  // bend energies on meshes fine enough to be sure of the digits, found independently
  CHECK(iv->energies[Term::bend] == Approx(39.910).margin(2e-3));
  CHECK(ii->energies[Term::bend] == Approx(39.979).margin(2e-3));
  CHECK(iii->energies[Term::bend] == Approx(44.556).margin(2e-3));
  CHECK(iv->state < ii->state);
  CHECK(ii->state < iii->state);
  CHECK(iv->group == "C4v");
  CHECK(ii->group == "C2v_diagonals");
  CHECK(iii->group == "C4");
  CHECK(iv->z_max_mm == Approx(72.8).margin(0.1));
  CHECK(ii->z_max_mm == Approx(49.3).margin(0.1));
  CHECK(iii->z_max_mm == Approx(66.4).margin(0.1));
  CHECK(ii->z_min_mm == Approx(-4.2).margin(0.1));
}

TEST_CASE("barriers: passes lie above the states that their two sides lead to") {
  preset::Preset p = shell(6);
  p.jitter.trials = 12;
  p.jitter.confined = 7;
  p.jitter.drawn = 3;
  const auto scene = std::make_shared<const Scene>(scene_of(p).value());
  Watch watch;
  auto library = value_of(find_states(scene, p.jitter, {.threads = 1, .lives = false}, watch));
  REQUIRE(library.states.size() > 1);
  StateLibrary again = library;
  const auto found = value_of(study::barriers_between(library, scene, p.jitter, 1, 0, 1, watch));
  CHECK(library.search.paths_followed_for_barriers > 0);
  REQUIRE(library.search.passes_found > 0);
  CHECK(int(found.size()) <= library.search.passes_found);
  for (const record::Barrier& one : found) {
    CHECK(one.from > 0);
    CHECK(one.barrier_mJ > 0);
    CHECK(one.back_mJ > 0);
    CHECK(one.residual_N < 1e-7);
    const study::ShellState& from = library.states[std::size_t(one.from) - 1];
    CHECK(one.energy_mJ - one.barrier_mJ == Approx(from.energy_mJ).epsilon(1e-6));
    CHECK(from.row.barrier_mJ <= one.barrier_mJ);
  }
  const auto same = value_of(study::barriers_between(again, scene, p.jitter, 2, 0, 1, watch));
  CHECK(record::csv_table(same) == record::csv_table(found));
}

TEST_CASE("transitions: a state whose range is not known is pushed, but not released") {
  preset::Preset p = shell(4);
  p.jitter.trials = 2;
  p.jitter.transitions = 1;
  const auto scene = std::make_shared<const Scene>(scene_of(p).value());
  Watch watch;
  const auto library =
      value_of(find_states(scene, p.jitter, {.threads = 1, .lives = false}, watch));
  REQUIRE(std::isnan(library.states.front().row.lives_to));
  const auto found = value_of(study::transitions_between(library, scene, p.jitter, 1, 0, 1, watch));
  for (const record::Transition& one : found) CHECK(one.by == record::Disturbance::pushed);
}
