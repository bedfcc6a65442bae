#include "engine/study/method_studies.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/core/parallel.h"
#include "engine/core/team.h"
#include "engine/core/try.h"
#include "engine/study/benchmark_methods.h"

namespace gridshell::study {
namespace {

using record::AccuracyRow;
using record::RunOutcome;

/// A method on meshes from coarse to fine; finer meshes than one that is too slow are not run.
struct MethodSeries {
  std::vector<Method> methods;
  double allowed = INFINITY;  // error promised if one mesh gives no estimate
};

struct Measured {
  MethodResult result;
  std::vector<double> seconds;  // ascending
  RunOutcome outcome = RunOutcome::right;
};

/// Runs a fast method several times, a slow one once.
Measured measure(BenchmarkProblem& study, const Method& method, double allowed,
                 const AccuracyOptions& options, const Watch& watch) {
  Measured measured;
  for (int run = 0; run < std::max(1, options.runs); ++run) {
    TimeLimit limit(options.seconds, watch);
    measured.result = method.run(study, limit.watch());
    const double seconds = measured.result.seconds;
    measured.seconds.push_back(seconds);
    if (seconds > 2 || (seconds > 0.5 && run >= 2) || watch.cancelled()) break;
    if (measured.result.claim != RunOutcome::right) break;
  }
  std::ranges::sort(measured.seconds);
  measured.outcome = verdict_of(study, measured.result, claimed_error, allowed, watch);
  return measured;
}

/// The columns that the rows of both tables have.
template <class Row>
Row row_of(const Method& method, const Measured& measured) {
  Row row;
  row.method = method.name;
  row.edges_per_segment = measured.result.edges;
  row.dof = measured.result.dof;
  row.outcome = measured.outcome;
  row.cpu_s = measured.seconds[measured.seconds.size() / 2];
  row.cpu_min_s = measured.seconds.front();
  row.cpu_max_s = measured.seconds.back();
  return row;
}

template <class Make>
MethodSeries method_series(Make make, int most_edges) {
  MethodSeries series;
  for (int k = 1; k <= most_edges; k *= 2) series.methods.push_back(make(k));
  return series;
}

Method bend_method(int edges) { return plan_method("bend", {{edges}, false}); }
Method twist_method(int edges) { return plan_method("twist", {{edges}, false}, {RodModel::twist}); }

/// The engine's own methods, which take fractions of a second each.
std::vector<MethodSeries> own_series(const AccuracyOptions& options) {
  std::vector<MethodSeries> all{{{net_method()}, 1},
                                method_series(bend_method, options.most_edges)};
  std::vector<int> edges{4};
  while (2 * edges.back() <= options.most_edges) {
    edges.push_back(2 * edges.back());
    all.push_back({{plan_method("nested", {edges, edges.size() > 2})}, 1e-2});
  }
  for (double tolerance : auto_tolerances) all.push_back({{auto_method(tolerance)}, tolerance});
  return all;
}

/// Methods of other programs and textbooks.
std::vector<MethodSeries> other_series(const AccuracyOptions& options) {
  const auto up_to = [&](int edges, auto make) {
    return method_series(make, std::min(edges, options.most_edges));
  };
  const auto relaxed = [](Relaxation kind) {
    return [kind](int edges) { return relaxed_method(kind, edges); };
  };
  std::vector<MethodSeries> all{up_to(8, relaxed(Relaxation::explicit_damped)),
                                up_to(8, relaxed(Relaxation::kinetic)), up_to(8, textbook_method),
                                up_to(8, twist_method),
                                up_to(8, relaxed(Relaxation::implicit_euler))};
  for (double stiffness : {1.0, 10.0, 100.0})
    all.push_back(up_to(4, [stiffness](int edges) {
      return plan_method(fmt::format("springs {:g} N/mm", stiffness), {{edges}, false},
                         {RodModel::twist, stiffness});
    }));
  return all;
}

/// Runs the methods of each series from coarse to fine meshes, the series on several threads.
/// Rows are in the order of `series`; progress is reported from `from` to `to`.
Result<std::vector<AccuracyRow>> run_series(BenchmarkProblem& study,
                                            const std::vector<MethodSeries>& series, int threads,
                                            const AccuracyOptions& options, Watch& watch,
                                            double from, double to) {
  std::vector<std::vector<AccuracyRow>> rows(series.size());
  const auto run_one = [&](int k) {
    const MethodSeries& one = series[std::size_t(k)];
    for (const Method& method : one.methods) {
      if (watch.cancelled()) return;
      const Measured measured = measure(study, method, one.allowed, options, watch);
      auto& row = rows[std::size_t(k)].emplace_back(row_of<AccuracyRow>(method, measured));
      if (measured.result.claim == RunOutcome::right) row.error = study.error_of(measured.result.x);
      if (measured.outcome == RunOutcome::too_slow) break;
    }
  };
  const auto gathered = [&] {
    std::vector<AccuracyRow> all;
    for (const auto& some : rows) all.insert(all.end(), some.begin(), some.end());
    return all;
  };
  return parallel_for(int(series.size()), threads, watch, run_one, reporting(watch, from, to))
      .map(gathered);
}

bool is_auto(const AccuracyRow& row) { return row.method.starts_with("auto "); }

double fastest(const std::vector<AccuracyRow>& rows, double error) {
  double best = record::unknown;
  for (const AccuracyRow& row : rows)
    if (!is_auto(row) && row.outcome == RunOutcome::right && row.error <= error &&
        !(row.cpu_s >= best))
      best = row.cpu_s;
  return best;
}

std::vector<AutoOutcome> auto_outcomes(const std::vector<AccuracyRow>& rows) {
  std::vector<AutoOutcome> outcomes;
  for (const AccuracyRow& row : rows)
    if (is_auto(row)) {
      const double tolerance = auto_tolerances[outcomes.size()];
      // errors within 5 % count as equal
      outcomes.push_back({tolerance, row.error, row.cpu_s, fastest(rows, 1.05 * row.error),
                          fastest(rows, tolerance)});
    }
  return outcomes;
}

/// The longest leg of a circle over d.
double leg_of(const preset::Footprint& footprint) {
  return footprint.radius_mm / footprint.spacing_mm - (footprint.rods - 1) / 2.0;
}

/// Sets the number of rods per direction; an odd one has a rod on the axis.
void set_rods(preset::Footprint& footprint, int rods) {
  footprint.rods = rods;
  footprint.placement = rods % 2 ? Placement::on_axis : Placement::half;
}

/// The preset's shape with its spacing multiplied by `factor`; a circle retains its longest leg.
preset::Preset respaced(preset::Preset preset, double factor) {
  auto& footprint = preset.footprint;
  if (footprint.kind == preset::FootprintKind::circle) {
    preset.set_radii(preset.original_radius_mm(), preset.actuated_radius_mm());
    const double leg = leg_of(footprint);
    set_rods(footprint, std::max(4, int(std::lround(footprint.rods / factor))));
    footprint.spacing_mm = footprint.radius_mm / ((footprint.rods - 1) / 2.0 + leg);
  } else {
    footprint.spacing_mm *= factor;
  }
  return preset;
}

std::vector<record::ScalingRow> scaling_of(const preset::Preset& preset,
                                           const AccuracyOptions& options, Watch& watch) {
  constexpr int edges = 4;
  AccuracyOptions limited = options;
  limited.seconds = std::min(options.seconds, 4.0);
  limited.runs = std::min(options.runs, 3);
  std::vector<Method> methods{auto_method(1e-3),
                              bend_method(edges),
                              twist_method(edges),
                              textbook_method(edges),
                              relaxed_method(Relaxation::kinetic, edges),
                              relaxed_method(Relaxation::implicit_euler, edges)};
  std::vector<char> slow(methods.size(), 0);
  std::vector<record::ScalingRow> rows;
  int step = 0;
  for (double factor : {2.0, 1.5, 1.0, 0.75, 0.5}) {
    watch.report(0.75 + 0.05 * step++);
    auto made = BenchmarkProblem::create(respaced(preset, factor), 16, watch);
    if (!made) continue;  // the footprint has no rods at this spacing, or its path is lost
    for (std::size_t k = 0; k < methods.size() && !watch.cancelled(); ++k) {
      if (slow[k]) continue;
      const Measured measured = measure(**made, methods[k], INFINITY, limited, watch);
      auto row = row_of<record::ScalingRow>(methods[k], measured);
      row.rods = int((*made)->scene().footprint.rods.size()) / 2;
      slow[k] = row.outcome == RunOutcome::too_slow;
      rows.push_back(std::move(row));
    }
  }
  return rows;
}

}  // namespace

Result<AccuracyStudy> accuracy_study(const preset::Preset& preset, const AccuracyOptions& options,
                                     Watch& watch) {
  keep_blas_on_one_thread();
  TRY(made, BenchmarkProblem::create(preset, options.finest, watch));
  BenchmarkProblem& study = **made;
  for (int k = 1; k <= options.most_edges; k *= 2)
    (void)study.problem(k, watch);  // a method refuses a mesh without a problem
  AccuracyStudy result;
  result.reference_error = study.reference_error();
  TRY(own, run_series(study, own_series(options), 1, options, watch, 0.02, 0.05));
  result.rows = std::move(*own);
  TRY(others, run_series(study, other_series(options), std::max(1, options.threads), options, watch,
                         0.05, options.scaling ? 0.75 : 1));
  result.rows.insert(result.rows.end(), others->begin(), others->end());
  result.outcomes = auto_outcomes(result.rows);
  if (options.scaling) result.scaling = scaling_of(preset, options, watch);
  if (watch.cancelled()) return stopped();
  return result;
}

Result<std::vector<AccuracyRow>> sizes_study(const preset::Preset& preset,
                                             const std::vector<int>& sizes,
                                             const AccuracyOptions& options, Watch& watch) {
  constexpr double tolerances[] = {1e-2, 1e-3, 1e-4};
  if (preset.footprint.kind != preset::FootprintKind::circle)
    return invalid("--sizes: got another kind of footprint, expected [footprint] kind \"circle\"");
  keep_blas_on_one_thread();
  std::vector<AccuracyRow> rows;
  for (std::size_t k = 0; k < sizes.size(); ++k) {
    preset::Preset sized = preset;
    const double fraction = preset.actuated_radius_mm() / preset.original_radius_mm();
    sized.footprint.radius_mm = preset.original_radius_mm();
    const double d = preset.footprint.spacing_mm, leg = leg_of(sized.footprint);
    set_rods(sized.footprint, sizes[k]);
    const double radius = d * ((sizes[k] - 1) / 2.0 + leg);
    sized.set_radii(radius, fraction * radius);
    TRY(made, BenchmarkProblem::create(sized, options.finest, watch));
    for (const double tolerance : tolerances) {
      const Method method = auto_method(tolerance);
      const Measured measured = measure(**made, method, tolerance, options, watch);
      if (watch.cancelled()) return stopped();
      AccuracyRow row = row_of<AccuracyRow>(method, measured);
      row.method = fmt::format("{} rods", sizes[k]);
      // two tolerances may lead to the same meshes
      if (!rows.empty() && rows.back().method == row.method &&
          rows.back().edges_per_segment == row.edges_per_segment)
        continue;
      if (measured.result.claim == RunOutcome::right)
        row.error = (*made)->error_of(measured.result.x);
      rows.push_back(std::move(row));
    }
    watch.report(double(k + 1) / double(sizes.size()));
  }
  return rows;
}

}  // namespace gridshell::study
