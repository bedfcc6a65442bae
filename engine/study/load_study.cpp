#include "engine/elastic/model.h"
#include "engine/study/formed_shell.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "engine/core/algorithms.h"
#include "engine/core/try.h"
#include "engine/scene/scene.h"
#include "engine/simulate/frame_forces.h"
#include "engine/simulate/frames.h"
#include "engine/solve/eigenmodes.h"
#include "engine/solve/equilibrium.h"

namespace gridshell::study {
namespace {

using record::BranchEvent;

/// Number of points of a path until it loses its stability, that point included.
std::size_t until_lost(const CriticalLoad& found) {
  const auto lost = std::ranges::find_if(
      found.points, [](const TracedPoint& point) { return point.event != BranchEvent::none; });
  return std::min(found.points.size(), std::size_t(lost - found.points.begin()) + 1);
}

/// Applies an increasing load case to the meshes of a simulation and follows its path on each.
class Loading {
 public:
  Loading(Simulation& simulation, const LoadCase& load, const Watch& watch)
      : shell_(simulation.shell()), scene_(simulation.scene()), load_(load), watch_(watch) {
    steady_ = simulation.field();
    dead_now_ = simulation.steady_load().begin;
    forces_ = forces_of(load, scene_.footprint, simulation.nodes());
    shell_.set_fields(steady_, forces_);
    shell_.drive(
        {.constraints = simulation.constraints(), .load = {dead_now_, load.dead}, .field = {0, 1}});
  }

  CriticalLoad on(int level, const State& begin) {
    CriticalOptions options;
    options.max_strain = std::max(scene_.max_strain, 1e-2);
    options.largest_mm = 5e-4 * scene_.length_scale_mm;
    options.tolerance_mm = 1e-8 * scene_.length_scale_mm;
    return critical_load(shell_.system(level), shell_.motion(level), begin, options, watch_);
  }
  CriticalLoad on(int level) { return on(level, shell_.state().levels[std::size_t(level)]); }

  /// Largest stress over strength at every point of a path; empty: the strength is not known.
  std::vector<double> utilisations(int level, const CriticalLoad& found) {
    std::vector<double> used;
    if (scene_.strength_MPa.empty()) return used;
    for (const TracedPoint& point : found.points)
      used.push_back(utilisation(level, point.at.t, point.at.state));
    return used;
  }

  /// The first factor at which a fibre reaches its rod's strength; NaN: not until stability is
  /// lost.
  double strength_factor(int level, const CriticalLoad& found, const std::vector<double>& used) {
    const auto end = used.begin() + std::ptrdiff_t(used.empty() ? 0 : until_lost(found));
    const auto reached = std::find_if(used.begin(), end, [](double part) { return part >= 1; });
    if (reached == end) return record::unknown;
    const auto k = std::size_t(reached - used.begin());
    if (k == 0) return found.points[0].at.t;
    const TracedPoint &from = found.points[k - 1], &to = found.points[k];
    double low = from.at.t, high = to.at.t, below = used[k - 1] - 1, above = used[k] - 1;
    const auto crossing = [&] { return low - below / (above - below) * (high - low); };
    // near a limit point two states have the same factor, so it does not determine one
    if (to.negative_pivots > 0 || !(high > low)) return crossing();
    constexpr int rounds = 6;
    State state = from.at.state;
    for (int round = 0; round < rounds && above > 1e-9 && below < -1e-9; ++round) {
      const double t = crossing();
      shell_.motion(level).apply_loads(shell_.system(level), t);
      NewtonOptions options;
      options.tolerance_mm = 1e-8 * scene_.length_scale_mm;
      if (newton(shell_.system(level), state, options, watch_).outcome != Outcome::reached) break;
      const double fraction = utilisation(level, t, state) - 1;
      (fraction < 0 ? low : high) = t;
      (fraction < 0 ? below : above) = fraction;
    }
    return crossing();
  }

  /// Critical load of the shell with an imperfection of `size_mm`.
  Result<CriticalLoad> imperfect(int level, const Eigenmodes& soft, int seed, double size_mm) {
    std::mt19937 random{std::uint32_t(seed)};
    const Model& model = shell_.model(level);
    Eigen::Matrix3Xd shape = Eigen::Matrix3Xd::Zero(3, model.columns()), force = shape;
    for (std::size_t k = 0; k < soft.shapes.size(); ++k) {
      const double fraction = symmetric_uniform(random);
      const double lambda = soft.values[Eigen::Index(k)];
      shape += fraction * soft.shapes[k];
      force += fraction * lambda * soft.shapes[k];
    }
    force *= size_mm / max_column_norm(shape.leftCols(model.nodes));
    std::vector<NodeAction> acting = steady_;
    for (int node = 0; node < model.nodes; ++node)
      if (!force.col(node).isZero(0)) acting.push_back({node, force.col(node)});
    Linearisation& system = shell_.system(level);
    const SetForScope under(system.outside.steady,
                            static_cast<const std::vector<NodeAction>*>(&acting));
    shell_.motion(level).apply_loads(system, 0);
    Result<CriticalLoad> found = fail(Fault::no_equilibrium, "");
    if (auto bent = find_equilibrium(system, shell_.state().levels[std::size_t(level)],
                                     10 * size_mm, watch_))
      found = on(level, *bent);
    return found;
  }

  /// The complete load at a factor of one, on the layout's supports, N.
  Eigen::Matrix3Xd loads() const {
    return simulate::loads_on(shell_.finest(), shell_.model(shell_.levels() - 1),
                              shell_.state().levels.back().x, {load_.dead, &forces_, nullptr, 0});
  }

 private:
  double utilisation(int level, double t, const State& state) {
    Linearisation& system = shell_.system(level);
    shell_.motion(level).apply_loads(system, t);
    system.gradient_at(state);
    return simulate::utilisation_of(scene_, shell_.mesh(level), shell_.model(level), state,
                                    system.assembly());
  }

  NestedShell& shell_;
  const Scene& scene_;
  const LoadCase& load_;
  const Watch& watch_;
  std::vector<NodeAction> steady_, forces_;
  double dead_now_ = 1;
};

/// Appends a path's points to `rows`: the load factor over the displacement of the joint that moves
/// most until stability is lost, in the direction of that displacement.
void put_points(const std::string& name, const CriticalLoad& found, const std::vector<double>& used,
                int joints, std::vector<record::LoadPoint>& rows) {
  const auto joints_at = [&](const TracedPoint& point) -> Eigen::Matrix3Xd {
    return point.at.state.x.leftCols(joints);
  };
  const Eigen::Matrix3Xd begin = joints_at(found.points.front());
  const Eigen::Matrix3Xd moved = joints_at(found.points[until_lost(found) - 1]) - begin;
  Eigen::Index furthest = 0;
  moved.colwise().norm().maxCoeff(&furthest);
  const Eigen::Vector3d along = moved.col(furthest).normalized();
  for (std::size_t k = 0; k < found.points.size(); ++k) {
    const TracedPoint& point = found.points[k];
    rows.push_back({name, point.at.t, along.dot((joints_at(point) - begin).col(furthest)),
                    point.negative_pivots, point.event, used.empty() ? record::unknown : used[k]});
  }
}

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) return record::unknown;
  std::ranges::sort(values);
  const double at = fraction * double(values.size() - 1);
  const auto low = std::size_t(at), high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - double(low)) * (values[high] - values[low]);
}

/// Writes quantiles of the critical factors of imperfect shells, over `perfect`, that of the
/// perfect shell on the same mesh, to the row. A shell that stays stable counts with the factor at
/// which its path ends; one whose path is not found or lost counts with 0.
Result<void> put_imperfections(Loading& loading, Simulation& simulation, int level, int count,
                               double perfect, record::LoadRow& row, const Watch& watch) {
  constexpr int soft_modes = 6;
  NestedShell& shell = simulation.shell();
  const Model& model = shell.model(level);
  Linearisation& system = shell.system(level);
  shell.motion(level).apply_loads(system, 0);
  const Inertia inertia = system.at(shell.state().levels[std::size_t(level)], false);
  Eigen::Matrix3Xd mass = Eigen::Matrix3Xd::Zero(3, model.columns());
  mass.leftCols(model.nodes).setOnes();
  TRY(soft, softest_modes(system, mass, soft_modes, inertia.negative_pivots, watch));
  const Scene& scene = simulation.scene();
  std::vector<double> factors;
  for (int k = 0; k < count && !watch.cancelled(); ++k) {
    const auto found =
        loading.imperfect(level, *soft, scene.imperfection.seed + k, scene.load_imperfection_mm);
    const bool failed = !found || found->points.empty() || found->event == BranchEvent::lost;
    row.imperfections_failed += failed;
    factors.push_back(failed                         ? 0
                      : std::isfinite(found->factor) ? found->factor / perfect
                                                     : found->points.back().at.t / perfect);
  }
  row.imperfections = int(factors.size());
  row.knock_down_5 = quantile(factors, 0.05);
  row.knock_down_50 = quantile(factors, 0.5);
  row.knock_down_95 = quantile(factors, 0.95);
  return {};
}

/// A factor computed on meshes from coarse to fine (NaN: not on the path of a mesh, and meshes
/// coarser than that do not count). It is extrapolated if `same`, the meshes lose stability by the
/// same event; otherwise it is that of the finest mesh, with the complete difference as its error.
CertifiedVectors certified(const std::vector<double>& factors, bool extrapolate, bool same) {
  std::vector<Eigen::Matrix3Xd> known;
  for (const double factor : factors) {
    if (std::isfinite(factor))
      known.emplace_back(factor * Eigen::Vector3d::UnitX());
    else
      known.clear();
  }
  if (!std::isfinite(factors.back()))
    return {Eigen::Vector3d::Constant(record::unknown), record::unknown};
  return certify_vectors(known, extrapolate && same && known.size() > 1, !same);
}

Result<void> put_case(Simulation& simulation, const LoadCase& load, int imperfections,
                      LoadStudy& study, const Watch& watch) {
  NestedShell& shell = simulation.shell();
  Loading loading(simulation, load, watch);
  record::LoadRow row;
  row.load_case = load.name;
  study.loads.push_back(loading.loads());
  const Eigen::Vector3d sum = study.loads.back().rowwise().sum();
  row.load_x_N = sum.x(), row.load_y_N = sum.y(), row.load_z_N = sum.z();
  const int last = shell.levels() - 1, first = shell.first_of_last_three();
  std::vector<double> critical, linear, strength, used;
  std::vector<BranchEvent> events;
  CriticalLoad found;
  for (int level = first; level <= last; ++level) {
    found = loading.on(level);
    if (watch.cancelled()) return stopped();
    if (found.points.empty() && found.event == BranchEvent::none)
      return invalid(
          "[[loads.case]] name: \"{}\" moves no joint, expected a load on one that is "
          "not fixed",
          load.name);
    if (found.points.empty())
      return fail(Fault::no_equilibrium, "case \"{}\": no equilibrium at the start of its path",
                  load.name);
    critical.push_back(found.factor);
    linear.push_back(found.linear);
    events.push_back(found.event);
    used = loading.utilisations(level, found);
    strength.push_back(loading.strength_factor(level, found, used));
  }
  row.event = found.event;
  const bool extrapolate = shell.plan().extrapolate;
  const CertifiedVectors torn = certified(strength, extrapolate, true),
                         estimated = certified(linear, extrapolate, true);
  row.strength_factor = torn.value(0, 0), row.strength_error = torn.error;
  row.linear_factor = estimated.value(0, 0), row.linear_error = estimated.error;
  // the order of convergence is known from three meshes with the same event
  const bool ordered = critical.size() == 3 && std::isfinite(critical[0]) &&
                       events[0] == events[1] && events[1] == events[2];
  const CertifiedVectors lost = certified(critical, extrapolate, ordered);
  row.critical_factor = lost.value(0, 0), row.error = lost.error;
  // imperfect shells are computed on the coarser one of the last two meshes
  const double perfect = critical[std::max<std::size_t>(critical.size(), 2) - 2];
  if (imperfections > 0 && std::isfinite(perfect))
    TRY_DO(put_imperfections(loading, simulation, std::max(0, last - 1), imperfections, perfect,
                             row, watch));
  if (watch.cancelled()) return stopped();
  put_points(load.name, found, used, shell.finest().joints, study.points);
  study.cases.push_back(row);
  study.modes.emplace_back();
  if (found.mode.size() == 0) return {};
  const Eigen::Matrix3Xd nodes =
      nodes_of(shell.finest(), shell.model(last), found.mode).leftCols(shell.finest().rod_nodes());
  study.modes.back() = nodes / max_column_norm(nodes);
  return {};
}

Result<void> check_cases(std::size_t cases) {
  if (cases > 0) return {};
  return invalid("got no load, expected a [[loads.case]]");
}

}  // namespace

Result<LoadStudy> load_study(const preset::Preset& preset, int imperfections, Watch& watch) {
  TRY_DO(check_cases(preset.load_case.size()));
  TRY(shell, form_shell(preset, watch));
  return load_study(*shell, imperfections, watch);
}

Result<LoadStudy> load_study(FormedShell& shell, int imperfections, Watch& watch) {
  Simulation& simulation = shell.path.simulation;
  const auto& cases = simulation.scene().load_cases;
  TRY_DO(check_cases(cases.size()));
  LoadStudy study;
  study.state = shell.state;
  study.summary = shell.summary;
  const Checkpoint formed = simulation.save();
  for (std::size_t k = 0; k < cases.size(); ++k) {
    const auto ended = put_case(simulation, cases[k], imperfections, study, watch);
    simulation.restore(formed);
    TRY_DO(ended);
    watch.report(0.5 + 0.5 * double(k + 1) / double(cases.size()));
  }
  return study;
}

}  // namespace gridshell::study
