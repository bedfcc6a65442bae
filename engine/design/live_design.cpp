#include "engine/design/live_design.h"

#include "engine/scene/shell_ends.h"

namespace gridshell {

Result<LiveDesign> design_live(const preset::Preset& preset, const DesignFrom& from,
                               int most_iterations, const Watch& watch,
                               const std::function<void(const CertifiedStep&)>& seen) {
  if (auto can = can_be_designed(preset, *from.scene); !can)
    return tl::unexpected<Error>(can.error());
  auto shell = MovedShell::make(*from.scene, designed_on, from.mesh, from.model, from.state, watch);
  if (!shell) return tl::unexpected<Error>(shell.error());
  auto begun = begin_design(preset, from.scene, std::move(*shell), watch);
  if (!begun) return tl::unexpected<Error>(begun.error());
  DesignWork& work = *begun;
  work.options.most_iterations = most_iterations;
  ShellEnds last = work.coarse->ends();
  const auto hand_over = [&](const DesignStep& step, double eigenvalue) {
    last = work.coarse->ends();
    const Eigen::VectorXd now = work.target.distances(work.coarse->joints()).size();
    seen({step, *work.coarse, now, eigenvalue, table_of(*from.scene, last),
          rod_table_of(*from.scene, last)});
  };

  const double softest = work.fine->smallest_eigenvalue(watch),
               allowed = preset.inverse.min_stability * softest;
  DesignStep begin;
  begin.eigenvalue = work.coarse->smallest_eigenvalue(watch);
  if (watch.cancelled()) return stopped();
  const Eigen::VectorXd distances = work.target.distances(work.coarse->joints()).size();
  begin.max_mm = distances.maxCoeff();
  begin.mean_mm = distances.mean();
  begin.taken = true;
  begin.q = Eigen::VectorXd::Zero(work.variables.count());
  hand_over(begin, softest);
  LiveDesign end;
  optimise(*work.coarse, work.target, work.variables, work.options, from.scene->footprint.spacing,
           watch, [&](const DesignStep& step) {
             end.iterations = step.iteration;
             if (!step.taken) return;
             if (!work.fine->move_in_steps(work.coarse->ends(), work.jump_mm, watch)) return;
             const double eigenvalue = work.fine->smallest_eigenvalue(watch);
             if (eigenvalue >= allowed && !watch.cancelled()) hand_over(step, eigenvalue);
           });
  end.stopped = watch.cancelled();
  // who stops it does not wait for more
  if (!end.stopped &&
      work.fine->move_in_steps(rounded(last, preset.inverse.round_mm), work.jump_mm))
    end.rounded_max_mm = work.target.distances(work.fine->joints()).size().maxCoeff();
  return end;
}

}  // namespace gridshell
