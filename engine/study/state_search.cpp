#include "engine/study/state_search.h"

#include <cmath>
#include <utility>

#include "engine/core/algorithms.h"
#include "engine/core/try.h"
#include "engine/simulate/actuation.h"
#include "engine/simulate/indentation.h"
#include "engine/study/state_library.h"

namespace gridshell::study {

using namespace simulate;

namespace {

using preset::SearchMode;

const LevelPlan judged_plan{{judged_edges}, false};

/// Distinguishes the random generators of trials.
enum class Purpose : std::uint32_t { trial, confined, poke };

/// One generator per trial, so that any trial can be repeated by itself.
std::mt19937 generator(int seed, Purpose purpose, int k) {
  std::seed_seq seeds{std::uint32_t(seed), std::uint32_t(purpose), std::uint32_t(k)};
  return std::mt19937(seeds);
}

double random_fraction(std::mt19937& random) { return 0.5 * (1 + symmetric_uniform(random)); }

/// A random unit vector, uniformly distributed.
Eigen::Vector3d direction(std::mt19937& random) {
  const double z = symmetric_uniform(random), angle = M_PI * symmetric_uniform(random),
               r = std::sqrt(1 - z * z);
  return {r * std::cos(angle), r * std::sin(angle), z};
}

tl::unexpected<Error> no_rest(std::string why) {
  return fail(Fault::no_equilibrium, std::move(why));
}
/// Replaces a solver's error, which has numbers in it, by a reason by which trials are counted.
Result<State> in_few_words(Result<State> rest, const char* why) {
  if (!rest && rest.error().fault == Fault::no_equilibrium) return no_rest(why);
  return rest;
}
Result<void> reached_or(Outcome end, const char* why, const Watch& watch) {
  if (end == Outcome::reached) return {};
  return watch.cancelled() ? stopped() : no_rest(why);
}

std::vector<double> levels_of(const preset::SearchSettings& jitter) {
  if (!jitter.levels.empty()) return jitter.levels;
  if (jitter.mode == SearchMode::gravity) return {0.02, 0.05, 0.1, 0.2, 0.35, 0.5};
  return {1};
}

}  // namespace

Eigen::Matrix3Xd StateSearcher::joints_of(const State& state) const {
  return state.x.leftCols(cascade_.finest().joints);
}

Result<std::vector<StartForm>> forms_to_shake(const std::shared_ptr<const Scene>& scene,
                                              const preset::SearchSettings& jitter,
                                              const Watch& watch) {
  std::vector<StartForm> forms;
  Result<void> last;
  for (const double level : levels_of(jitter)) {
    forms.push_back({parameter_at(level), {}});
    if (jitter.mode == SearchMode::random) continue;
    auto path = follow_actuation(scene, judged_plan, level < 1, level, watch);
    if (watch.cancelled()) return stopped();
    // whether the level was reached is tested below
    if (path && scene->from_net) (void)path->simulation.go(forms.back().t, watch);
    const bool there = path && path->simulation.shell().state().t == forms.back().t;
    if (there)
      forms.back().state = path->simulation.shell().state().levels[0];
    else
      forms.pop_back();
    if (!path) last = tl::unexpected<Error>(path.error());
  }
  if (!forms.empty()) return forms;
  if (!last) return tl::unexpected<Error>(last.error());
  return no_rest("the actuation reaches none of [jitter] levels");
}

StateSearcher::StateSearcher(std::shared_ptr<const Scene> scene,
                             const preset::SearchSettings& jitter,
                             const std::vector<StartForm>& forms, MultilevelRelaxation cascade,
                             Simulation session)
    : scene_(std::move(scene)),
      jitter_(jitter),
      forms_(&forms),
      symmetries_(symmetries_of_shell(*scene_, cascade.finest(), cascade.symmetries())),
      groups_(subgroups(symmetries_)),
      cascade_(std::move(cascade)),
      session_(std::move(session)) {
  // half of the rod between two joints belongs to each
  const RodMesh mesh = mesh_rods(scene_->footprint, 1);
  joint_length_ = lumped(mesh, std::vector<double>(mesh.rods.size(), 1.0)).head(mesh.joints);
  for (int joint = 0; joint < mesh.joints; ++joint)
    if (not_on_boundary(scene_->footprint, joint)) pushable_.push_back(joint);
}

Result<StateSearcher> StateSearcher::make(std::shared_ptr<const Scene> scene,
                                          const preset::SearchSettings& jitter,
                                          const std::vector<StartForm>& forms) {
  TRY(cascade, MultilevelRelaxation::make(scene->footprint, scene->rods, scene->solved_model(),
                                          scene->motion, scene->flat, judged_edges));
  TRY(session, Simulation::open(scene, judged_plan));
  return StateSearcher(std::move(scene), jitter, forms, std::move(*cascade), std::move(*session));
}

Eigen::Matrix3Xd StateSearcher::random_nodes(double t, std::mt19937& random) const {
  Eigen::Matrix3Xd nodes = cascade_.stretched_flat(t);
  const double reach = jitter_.amplitude * scene_->footprint.spacing;
  for (double& coordinate : nodes.reshaped()) coordinate += reach * symmetric_uniform(random);
  return nodes;
}

Result<State> StateSearcher::pull_start(const StartForm& form, std::mt19937& random,
                                        const Watch& watch) {
  const Eigen::Vector3d field =
      jitter_.field_N_per_mm * random_fraction(random) * direction(random);
  std::vector<NodeAction> forces;
  for (int joint = 0; joint < joint_length_.size(); ++joint)
    forces.push_back({joint, joint_length_[joint] * field});
  auto under = in_few_words(cascade_.rest_under(forces, form.t, form.state, watch),
                            "did not converge under the load");
  if (!under) return under;
  return in_few_words(cascade_.rest_under({}, form.t, std::move(*under), watch),
                      "did not converge after the load");
}

Result<State> StateSearcher::push_start(const StartForm& form, std::mt19937& random,
                                        const Watch& watch) {
  constexpr unsigned most_pushes = 3;
  TRY_DO(reached_or(session_.begin_at(form.t, form.state, watch).end,
                    "the form to push is not in equilibrium", watch));
  if (pushable_.empty()) return no_rest("every joint is a support, nothing can push it");
  const unsigned pushes = 1 + random() % most_pushes;
  for (unsigned k = 0; k < pushes; ++k) {
    const int joint = pushable_[random() % std::uint32_t(pushable_.size())];
    const double depth = jitter_.depth * scene_->footprint.spacing * random_fraction(random);
    // a push may end early: a user, too, stops when the rods reach the strain limit
    (void)session_.push(joint, depth * direction(random), Across::free, watch);
    if (watch.cancelled()) return stopped();
    TRY_DO(reached_or(session_.release(joint, watch).end, "did not converge when it was released",
                      watch));
  }
  return session_.shell().state().levels[0];
}

/// Moves the simulation from its current state along the scene's own motion.
Result<State> StateSearcher::go(double t, const Watch& watch) {
  Report report = session_.go(t, watch);
  // a scene that does not choose a branch continues through unstable states
  if (report.end == Outcome::reached && !report.certificate.stable()) report = session_.rest(watch);
  if (watch.cancelled()) return stopped();
  if (report.end == Outcome::locked) return no_rest("the rods reached the strain limit");
  if (report.end != Outcome::reached || !session_.certificate().stable())
    return no_rest("the actuation did not reach its end");
  return session_.shell().state().levels[0];
}

Result<State> StateSearcher::go_from(double from, const State& rest, double t, const Watch& watch) {
  TRY_DO(reached_or(session_.begin_at(from, rest, watch).end, "its equilibrium is not certified",
                    watch));
  return go(t, watch);
}

Result<State> StateSearcher::trial(int k, const Watch& watch) {
  std::mt19937 random = generator(jitter_.seed, Purpose::trial, k);
  const StartForm& form = (*forms_)[std::size_t(k) % forms_->size()];
  auto rest = jitter_.mode == SearchMode::gravity ? pull_start(form, random, watch)
              : jitter_.mode == SearchMode::poke
                  ? push_start(form, random, watch)
                  : in_few_words(cascade_.rest(form.t, random_nodes(form.t, random), watch),
                                 "did not converge");
  if (!rest || form.t == 1) return rest;
  return go_from(form.t, *rest, 1, watch);
}

Result<State> StateSearcher::symmetric_trial(int k, const Watch& watch) {
  if (groups_.empty()) return no_rest("the footprint has no symmetry");
  std::mt19937 random = generator(jitter_.seed, Purpose::confined, k);
  const SymmetryGroup& group = groups_[std::size_t(k) % groups_.size()];
  return in_few_words(cascade_.rest_confined(1, random_nodes(1, random), group, watch),
                      "did not converge");
}

Result<State> StateSearcher::release_boundary(const State& from, double to, const Watch& watch) {
  TRY_DO(go_from(1, from, parameter_at(to), watch));
  return go(1, watch);
}

Result<State> StateSearcher::push_at_random(const State& from, int k, const Watch& watch) {
  std::mt19937 random = generator(jitter_.seed, Purpose::poke, k);
  return push_start({1, from}, random, watch);
}

}  // namespace gridshell::study
