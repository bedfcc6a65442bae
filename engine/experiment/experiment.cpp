#include "engine/experiment/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "engine/core/clock.h"
#include "engine/experiment/actuation.h"
#include "engine/experiment/frames.h"
#include "engine/experiment/indentation.h"
#include "engine/experiment/net_sample.h"
#include "engine/experiment/stepped.h"
#include "engine/experiment/steps.h"
#include "engine/measure/deviation.h"
#include "engine/preset/rung.h"
#include "engine/scene/scene.h"
#include "engine/session/budget.h"
#include "engine/solve/buckle.h"
#include "engine/solve/meshed_shell.h"

namespace gridshell::experiment {
namespace {

/// From 0 to 1, both among them.
std::vector<double> evenly(int frames) {
  std::vector<double> progress;
  for (int k = 0; k < frames; ++k) progress.push_back(double(k) / (frames - 1));
  return progress;
}

std::vector<double> samples_of(const preset::Preset& preset, bool stills) {
  // only a circle's boundary has a radius all the way
  if (stills && preset.footprint.kind != preset::FootprintKind::circle) return {1.0};
  if (stills && !preset.figure.radii_mm.empty()) {
    std::vector<double> progress;
    const double from = preset.original_radius_mm(), to = preset.actuated_radius_mm();
    for (double radius : preset.figure.radii_mm) progress.push_back((from - radius) / (from - to));
    std::sort(progress.begin(), progress.end());
    return progress;
  }
  return preset.movie.frames == 1 ? std::vector{1.0} : evenly(preset.movie.frames);
}

/// Of a push: all frames of a movie, or enough for the curve of its force.
std::vector<double> samples_of_push(const preset::Preset& preset, bool stills) {
  return evenly(stills ? 11 : std::max(2, preset.movie.frames));
}

/// Passes frames on, and keeps the layout and the last frame for the summary. What solvers say once
/// they were stopped holds for nothing, so no frame passes after that.
class LastFrame final : public record::Sink {
 public:
  LastFrame(record::Sink& next, const Watch& watch) : next_(next), watch_(watch) {}
  Result<void> begin(record::Layout layout) override {
    net_joints_ = layout.net_nodes.leftCols(
        std::min(layout.net_nodes.cols(), Eigen::Index(layout.joints.size())));
    scale_mm_ = layout.length_scale_mm;
    frame_.reset();
    return next_.begin(std::move(layout));
  }
  Result<void> take(record::Frame frame) override {
    if (watch_.cancelled()) return stopped();
    if (!frame_ || frame.index >= frame_->index) frame_ = frame;
    return next_.take(std::move(frame));
  }
  const std::optional<record::Frame>& frame() const { return frame_; }
  const Eigen::Matrix3Xd& net_joints() const { return net_joints_; }
  double scale_mm() const { return scale_mm_; }

 private:
  record::Sink& next_;
  const Watch& watch_;
  std::optional<record::Frame> frame_;
  Eigen::Matrix3Xd net_joints_;
  double scale_mm_ = 1;
};

void put_deviation(const LastFrame& seen, record::Summary& s) {
  if (seen.net_joints().size() == 0) return;
  const Deviation deviation(seen.frame()->nodes.leftCols(seen.net_joints().cols()),
                            seen.net_joints(), seen.scale_mm());
  s.max_deviation = deviation.largest();
  s.mean_deviation = deviation.mean();
  s.median_deviation = deviation.quantile(0.5);
  s.deviation_p90 = deviation.quantile(0.9);
}

void put_seams(const Scene& scene, record::Summary& s) {
  if (!scene.blocks || scene.blocks->seams().empty()) return;
  s.max_seam_gap_mm = s.max_seam_kink_deg = 0;
  for (const Seam& seam : scene.blocks->seams()) {
    s.max_seam_gap_mm = std::max(s.max_seam_gap_mm, seam.max_gap_mm());
    s.max_seam_kink_deg = std::max(s.max_seam_kink_deg, seam.max_kink_deg());
  }
}

/// What was followed, and on which meshes.
void put_course(const Course& course, record::Summary& s) {
  const NestedShell& shell = course.session.shell();
  s.edges_per_segment = shell.plan().edges_per_segment.back();
  s.dof = shell.model(shell.levels() - 1).dof();
  s.limit = course.limit;
  s.limit_reason = course.limit_reason;
  s.doubt = course.doubt;
  s.largest_strain = course.session.certificate().largest_strain;
  const Effort effort = course.session.effort();
  s.newton_iterations = effort.newton_iterations;
  s.factorizations = effort.factorizations;
  s.seconds_setup = course.seconds_setup;
}

record::Summary summary_of(const preset::Preset& preset, const Scene& scene,
                           const LastFrame& seen) {
  record::Summary s = summary_before(preset, scene);
  s.take_state(*seen.frame());
  put_deviation(seen, s);
  put_seams(scene, s);
  return s;
}

int dof_of(const Scene& scene, int edges_per_segment) {
  if (scene.rung == preset::Rung::net) return 0;
  const auto model =
      build_model(mesh_rods(scene.footprint, edges_per_segment), scene.rods, scene.mechanics());
  return model ? model->dof() : 0;
}

/// About how long a run takes on one core: bringing the coarsest mesh to rest, then two corrections
/// a frame on each mesh. Measured on shells of 500 to 40 000 unknowns; good within a factor of
/// three.
double seconds_for(const Scene& scene, const preset::Preset& preset) {
  constexpr double to_rest = 1.5e-5, a_frame = 4e-7, a_twist_frame = 1.5e-6;  // seconds an unknown
  if (scene.rung == preset::Rung::net) return 0.01;
  const bool twist = scene.rung == preset::Rung::twist;
  double seconds = 0;
  for (int edges : first_plan(scene).edges_per_segment) {
    const double dof = dof_of(scene, edges);
    if (seconds == 0) seconds = to_rest * dof;
    seconds += (twist ? a_twist_frame : a_frame) * dof * preset.movie.frames;
  }
  // a trial ends on a mesh of 4 edges a segment; measured on 8 to 20 rods
  constexpr double a_trial = 2e-5;
  const preset::Jitter& jitter = preset.jitter;
  if (jitter.wanted()) seconds = a_trial * dof_of(scene, 4) * (jitter.trials + jitter.confined);
  return seconds;
}

/// Steps name joints that are there, and let go of what a step before took.
Result<void> check_steps(const std::vector<preset::Step>& steps, const Footprint& footprint) {
  std::set<std::vector<int>> held;
  for (std::size_t k = 0; k < steps.size(); ++k) {
    const preset::Step& step = steps[k];
    const bool one = !step.joint.empty();
    if (one)
      if (auto joint = joint_of(step, footprint); !joint)
        return fail(joint.error().fault,
                    fmt::format("[[step]] {} {}", k + 1, joint.error().message));
    if (step.deed == preset::Deed::push || step.deed == preset::Deed::hold) held.insert(step.joint);
    if (step.deed != preset::Deed::release) continue;
    if (one ? !held.contains(step.joint) : held.empty())
      return fail(
          Fault::bad_input,
          fmt::format("[[step]] {}: no joint is held that could be let go: a step before it "
                      "must push or hold it",
                      k + 1));
    if (one)
      held.erase(step.joint);
    else
      held.clear();
  }
  return {};
}

}  // namespace

namespace {

/// Whether the boundary's motion takes the rods out of the flat at all. Errors: bad_input.
Result<void> check_motion(const Scene& scene) {
  if (scene.from_net || scene.drawn_in_space || scene.rung == preset::Rung::net) return {};
  MeshedShell flat;
  const int edges = first_plan(scene).edges_per_segment.front();
  if (auto built = flat.build(scene.footprint, scene.rods, Mechanics::bend, scene.motion, edges);
      !built)
    return built;
  return parameter_of_shortening(flat.mesh, flat.motion, flat_shortening).map([](double) {});
}

}  // namespace

Result<Plan> plan(const preset::Preset& preset) {
  const auto scene = scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  const LevelPlan levels = first_plan(*scene);
  if (auto fits = fits_memory(*scene, levels); !fits) return tl::unexpected<Error>(fits.error());
  // what the run would only find out later
  if (preset.indentation.wanted() && preset.indentation.joint.size() == 2)
    if (auto joint = pushed_joint(preset.indentation, scene->footprint, {}); !joint)
      return tl::unexpected<Error>(joint.error());
  if (auto there = check_steps(preset.step, scene->footprint); !there)
    return tl::unexpected<Error>(there.error());
  if (auto shortens = check_motion(*scene); !shortens)
    return tl::unexpected<Error>(shortens.error());
  Plan plan;
  plan.model = word_of(scene->rung);
  plan.memory_GB = memory_GB(scene->footprint, scene->rung, levels);
  plan.model_reason = preset::model_reason(preset);
  plan.levels = levels.edges_per_segment;
  plan.edges_per_segment = plan.levels.back();
  plan.extrapolated = levels.extrapolate;
  plan.rods = int(scene->footprint.rods.size());
  plan.joints = int(scene->footprint.joints.size());
  plan.cells = int(scene->footprint.cells.size());
  plan.dof = dof_of(*scene, plan.edges_per_segment);
  plan.expected_error_mm = (scene->rung == preset::Rung::net ? net_error : expected_error(levels)) *
                           scene->length_scale_mm;
  plan.expected_seconds = seconds_for(*scene, preset);
  plan.footprint = fmt::format("{} rods, {} joints, {} cells", plan.rods, plan.joints, plan.cells);
  // a ring has no legs
  if (const double d = scene->footprint.spacing; scene->footprint.longest_leg() > 0)
    plan.footprint +=
        fmt::format("; longest leg {:.2f} d, shortest {:.2f} d", scene->footprint.longest_leg() / d,
                    scene->footprint.shortest_leg() / d);
  if (scene->blocks)
    for (const Seam& seam : scene->blocks->seams())
      plan.seams.push_back(fmt::format(
          "{}: {} rods across, at most {:.2f} mm apart, kinked by at most {:.1f} degrees",
          seam.name, seam.rods.size(), seam.max_gap_mm(), seam.max_kink_deg()));
  return plan;
}

namespace {

/// What the preset wants done, followed and shown; of steps, what each came to.
Result<Course> course_for(const preset::Preset& preset, const std::shared_ptr<const Scene>& scene,
                          bool stills, std::vector<std::string>& told, LastFrame& sink,
                          Watch& watch) {
  if (preset.indentation.wanted())
    return run_indentation(scene, preset.indentation, samples_of_push(preset, stills), sink, watch);
  if (preset.step.empty()) return run_actuation(scene, samples_of(preset, stills), sink, watch);
  // stills show each step's end
  auto stepped = run_steps(scene, preset.step, stills ? 1 : preset.movie.frames, sink, watch);
  if (!stepped) return tl::unexpected<Error>(stepped.error());
  told = std::move(stepped->told);
  return std::move(stepped->course);
}

/// Runs a scene on a rung that solves, and says what was followed.
Result<void> follow(const preset::Preset& preset, const std::shared_ptr<const Scene>& scene,
                    bool stills, LastFrame& sink, Watch& watch, record::Summary& summary) {
  const double begin = seconds_now();
  std::vector<std::string> told;
  auto course = course_for(preset, scene, stills, told, sink, watch);
  if (watch.cancelled()) return stopped();
  if (!course) return tl::unexpected<Error>(course.error());
  if (!sink.frame())
    return fail(Fault::no_equilibrium, "no frame was certified: " + course->limit_reason);
  summary = summary_of(preset, *scene, sink);
  put_course(*course, summary);
  summary.steps = std::move(told);
  summary.seconds_simulation = seconds_now() - begin - summary.seconds_setup;
  return {};
}

}  // namespace

Result<record::Summary> run(const preset::Preset& preset, bool stills, record::Sink& sink,
                            Watch& watch) {
  const auto scene = shared_scene_of(preset);
  if (!scene) return tl::unexpected<Error>(scene.error());
  return run(preset, *scene, stills, sink, watch);
}

Result<record::Summary> run(const preset::Preset& preset, const std::shared_ptr<const Scene>& scene,
                            bool stills, record::Sink& sink, Watch& watch) {
  LastFrame seen(sink, watch);
  record::Summary summary;
  if (scene->rung != preset::Rung::net) {
    const auto followed = follow(preset, scene, stills, seen, watch, summary);
    if (!followed) return tl::unexpected<Error>(followed.error());
    return summary;
  }
  const double begin = seconds_now();
  const auto mesh = sample_net(*scene, samples_of(preset, stills), seen, watch);
  if (!mesh) return tl::unexpected<Error>(mesh.error());
  summary = summary_of(preset, *scene, seen);
  summary.edges_per_segment = mesh->edges_per_segment;
  summary.seconds_simulation = seconds_now() - begin;
  return summary;
}

Result<Finished> run(const preset::Preset& preset, bool stills, Watch& watch) {
  record::MemorySink sink;
  auto summary = run(preset, stills, sink, watch);
  if (!summary) return tl::unexpected<Error>(summary.error());
  return Finished{std::move(sink.trajectory()), std::move(*summary)};
}

}  // namespace gridshell::experiment
