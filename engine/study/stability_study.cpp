#include "engine/study/stability_study.h"

#include "engine/core/parallel.h"
#include "engine/study/stopwatch.h"

namespace gridshell::study {

Result<void> run_cells(Cells& cells, const StabilityOptions& options, Watch& watch) {
  const auto run = [&](int k) {
    Cell& cell = cells[std::size_t(k)];
    const TimeLimit limit(options.seconds, watch);
    cell.row.outcome = cell.run(limit.watch());
  };
  return share_work(int(cells.size()), options.threads, watch, run,
                    [&](double share) { watch.report(share); });
}

Result<std::vector<record::StabilityRow>> stability_study(const preset::Preset& preset,
                                                          const StabilityOptions& options,
                                                          Watch& watch) {
  keep_blas_on_one_thread();
  auto made = Subject::create(preset, 64, watch);
  if (!made) return tl::unexpected<Error>(made.error());
  const std::shared_ptr<Subject> study = std::move(*made);
  if (study->task() != Task::actuation)
    return fail(Fault::bad_input,
                "maps of stability need an actuation from the flat, without a "
                "push (actuation.start = \"flat\")");
  for (int edges : {1, 2, 4, 8}) (void)study->problem(edges, watch);
  Cells cells;
  const auto add = [&](Cells more) {
    for (Cell& cell : more) cells.push_back(std::move(cell));
  };
  add(explicit_map(study, {0.5, 0.8, 0.95, 1.05, 1.2, 1.4, 1.8}, {1, 2, 4, 8}));
  add(relaxation_map(study, {0.5, 0.8, 0.95, 1.05, 1.2, 1.4, 1.8}, {1, 2}));
  add(newton_map(study, {1, 3, 10, 30, 100}, {1, 2, 4}));
  add(tolerance_map(study, {1e-6, 1e-4, 1e-2, 1e-1, 1}, {10, 40}, 2));
  add(stiffness_map(preset, {1e-2, 1, 1e2, 1e4}, {3, 10, 30}, 2));
  add(leg_map(preset, {1e-4, 1e-3, 1e-2, 0.1, 0.2}, {3, 10}, 4));
  add(seed_map(study, {1e-12, 1e-6, 1e-3, 1, 10}, {2, 4}));
  add(joint_map(study, {0.01, 1, 1e2, 1e4, 1e6}, {3, 10, 30}, 1));
  if (auto ran = run_cells(cells, options, watch); !ran) return tl::unexpected<Error>(ran.error());
  std::vector<record::StabilityRow> rows;
  for (Cell& cell : cells) rows.push_back(std::move(cell.row));
  return rows;
}

}  // namespace gridshell::study
