#include "engine/simulate/run.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <optional>

#include "engine/core/system_info.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/preset/consistency.h"
#include "engine/record/shape_measures.h"
#include "engine/simulate/actuation.h"
#include "engine/simulate/expected_cost.h"
#include "engine/simulate/first_state.h"
#include "engine/simulate/frames.h"
#include "engine/simulate/indentation.h"
#include "engine/simulate/mesh_policy.h"
#include "engine/simulate/path_doubt.h"
#include "engine/simulate/steps.h"
#include "engine/solve/buckling.h"
#include "engine/solve/mesh_levels.h"

namespace gridshell::simulate {
namespace {

/// Typical largest distance of a gridshell's joints from their net, over rho: that of caps of a
/// sphere with pinned ends is at most 0.032.
constexpr double net_error = 0.032;

constexpr int edges_per_segment = 4;  // for the pictures of the rods between joints

record::Frame frame_at(const Scene& scene, const RodMesh& mesh, int index, double progress,
                       const Eigen::Matrix3Xd& x, const Eigen::VectorXd& K) {
  record::Frame frame;
  fill_shape(scene, mesh, x, K, frame);
  frame.index = index;
  frame.progress = frame.actuation = progress;
  frame.energies = Energies::not_known();
  frame.residual_N = record::unknown;
  frame.negative_pivots = -1;
  frame.event = progress == 0 ? "" : "the net itself, no equilibrium";
  return frame;
}

/// K of the cells by the net's own tangents.
Result<Eigen::VectorXd> curvature_of(const Scene& scene) {
  JointTangents tangents;
  const Eigen::Index joints = Eigen::Index(scene.footprint.joints.size());
  tangents.u.resize(3, joints);
  tangents.v.resize(3, joints);
  for (Eigen::Index k = 0; k < joints; ++k) {
    const FootprintJoint& joint = scene.footprint.joints[std::size_t(k)];
    TRY(point, scene.net->at(joint.u, joint.v));
    tangents.u.col(k) = point->tangent_u;
    tangents.v.col(k) = point->tangent_v;
  }
  return cell_curvature(scene.footprint, tangents);
}

/// The flat footprint and the net, where `progress` has 0 and 1; nothing in between, as no
/// equilibrium is solved for. Residual, energies, pivots and error estimate are not known. Returns
/// the mesh that was drawn. Errors (bad_input): those of the net; the sink's.
Result<RodMesh> write_net_frames(const Scene& scene, const std::vector<double>& progress,
                                 record::Sink& sink, Watch& watch) {
  RodMesh mesh = mesh_rods(scene.footprint, edges_per_segment);
  TRY(layout, layout_of(scene, mesh));
  TRY(K, curvature_of(scene));
  const Eigen::Matrix3Xd net = layout->net_nodes;
  TRY_DO(sink.begin(std::move(*layout)));
  for (std::size_t k = 0; k < progress.size(); ++k) {
    if (progress[k] == 0)
      TRY_DO(sink.take(frame_at(scene, mesh, int(k), 0, scene.flat.all(mesh.flat),
                                Eigen::VectorXd::Zero(K->size()))));
    if (progress[k] == 1) TRY_DO(sink.take(frame_at(scene, mesh, int(k), 1, net, *K)));
  }
  watch.report(1);
  return mesh;
}

/// Equidistant values of the progress from 0 to 1, both included; at least two.
std::vector<double> evenly(int frames) {
  std::vector<double> progress;
  for (int k = 0; k < frames; ++k) progress.push_back(double(k) / (frames - 1));
  return progress;
}

std::vector<double> samples_of(const preset::Preset& preset, bool stills) {
  // only a circular boundary has a radius throughout the path
  const bool circle = preset.footprint.kind == preset::FootprintKind::circle;
  if (stills && (!circle || preset.figure.radii_mm.empty())) return {1.0};
  if (stills) {
    std::vector<double> progress;
    const double from = preset.original_radius_mm(), to = preset.actuated_radius_mm();
    for (double radius : preset.figure.radii_mm) progress.push_back((from - radius) / (from - to));
    std::ranges::sort(progress);
    return progress;
  }
  if (preset.movie.frames == 1) return {1.0};
  std::vector<double> progress = evenly(preset.movie.frames);
  // the height of a buckled flat grid grows as the square root of its shortening
  if (preset.movie.pace == preset::Pace::height)
    for (double& one : progress) one *= one;
  return progress;
}

/// Passes frames on and stores the layout and the last frame for the summary. After a cancel the
/// results of solvers are not valid, so no frame is passed then.
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
  const NetDeviation deviation(seen.frame()->nodes.leftCols(seen.net_joints().cols()),
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

/// Writes how the path was followed, and on which meshes, into the summary.
void put_path(const EquilibriumPath& path, record::Summary& s) {
  const NestedShell& shell = path.simulation.shell();
  s.edges_per_segment = shell.plan().edges_per_segment.back();
  s.dof = shell.model(shell.levels() - 1).dof();
  if (const std::string why = why_so_fine(path); !why.empty()) s.model_reason += "; " + why;
  s.limit = path.limit;
  s.limit_reason = path.limit_reason;
  s.doubt = doubt_about(path);
  s.tolerance_met = !path.tolerance_missed;
  for (const ContactEvent& event : path.contacts)
    s.contact += (s.contact.empty() ? "" : "; ") + event.text;
  s.largest_strain = path.simulation.certificate().largest_strain;
  const Effort effort = path.simulation.effort();
  s.newton_iterations = effort.newton_iterations;
  s.factorizations = effort.factorizations;
  s.seconds_setup = path.seconds_setup;
}

record::Summary summary_of(const preset::Preset& preset, const Scene& scene,
                           const LastFrame& seen) {
  record::Summary s = summary_before(preset, scene);
  s.take_state(*seen.frame());
  put_deviation(seen, s);
  put_seams(scene, s);
  return s;
}

/// Checks that the boundary's motion makes a flat grid buckle at all. Errors: bad_input.
Result<void> check_motion(const Scene& scene) {
  if (scene.from_net || scene.from_drawing || scene.rod_model == RodModel::net) return {};
  MeshLevel flat;
  const int edges = initial_levels(scene).edges_per_segment.front();
  TRY_DO(flat.build(scene.footprint, scene.rods, RodModel::bend, scene.motion, edges));
  if (begins_as_drawn(scene, flat.mesh, flat.motion)) return {};
  return parameter_of_shortening(flat.mesh, flat.motion, flat_shortening).map([](double) {});
}

/// A sentence on thick rods, since the model treats rods as lines that meet in points. The shear
/// deformation of a round rod of Poisson's ratio 0.3 between joints adds a fraction 12 EI/(kappa G
/// A L^2) = 2.2 (d/L)^2 to its bending [Timoshenko].
std::vector<std::string> left_out_of(const Scene& scene) {
  constexpr double slender = 20;  // diameters from joint to joint; the fraction is then 0.5 %
  std::vector<std::string> sentences;
  if (std::string balls = ends_on_balls(scene); !balls.empty())
    sentences.push_back(std::move(balls));
  const auto& diameters = scene.drawn_diameters_mm;
  const double thickest = diameters.empty() ? 0 : std::ranges::max(diameters),
               long_by = scene.footprint.spacing / thickest;
  if (scene.rod_model == RodModel::net || !(long_by < slender)) return sentences;
  sentences.push_back(
      fmt::format("rods of {:.3g} mm are {:.2g} diameters long from joint to joint, and lines in "
                  "this model: shear, which bends such a piece by some {:.2g} % more, and the "
                  "{:.3g} mm between the axes of rods that cross are not in the expected error",
                  thickest, long_by, 100 * 2.2 / (long_by * long_by), thickest));
  return sentences;
}

/// Refuses a first step that would open joints of the drawn network to angles that they cannot
/// have.
Result<void> check_opening(const preset::Preset& preset, const Scene& scene) {
  if (!opens_as_drawn(preset.step, scene)) return {};
  const auto bolts = bolts_as_drawn(preset.step.front(), scene.footprint);
  if (bolts) return {};
  const std::string against = preset::joints_against(preset);
  return invalid("[[step]] 1: {}{}", bolts.error().message, against.empty() ? "" : "; " + against);
}

/// Follows and samples the experiment of a preset.
Result<EquilibriumPath> path_for(const preset::Preset& preset,
                                 const std::shared_ptr<const Scene>& scene, bool stills,
                                 LastFrame& sink, Watch& watch, const RunContext& context) {
  // for a push all frames of a movie, or enough for its force curve
  const auto samples = evenly(stills ? 61 : std::max(2, preset.movie.frames));
  if (preset.indentation.requested())
    return run_indentation(scene, preset.indentation, samples, stills, sink, watch, context);
  if (preset.step.empty())
    return run_actuation(scene, samples_of(preset, stills), sink, watch, context);
  // stills show each step's end
  return run_steps(scene, preset.step, stills ? 1 : preset.movie.frames, sink, watch, context);
}

/// Why a path without a limit has no frame at the requested state.
std::string not_in_the_flat(const EquilibriumPath& path) {
  const Scene& scene = path.simulation.scene();
  std::string text =
      "rods with natural curvature have no equilibrium in the flat, for which all frames were "
      "requested: request one nearer to the actuated boundary";
  if (path.segments.empty()) return text;
  double nearest = 1;  // to the flat
  for (const PathSegment& segment : path.segments)
    nearest = std::min({nearest, progress_at(segment.from), progress_at(segment.end())});
  return text + fmt::format(", at a radius of {:.6g} mm or less", scene.radius_at(nearest));
}

}  // namespace

Result<Plan> plan(const preset::Preset& preset) {
  const double begun = cpu_seconds_now();
  TRY(built, shared_scene_of(preset));
  const std::shared_ptr<const Scene>& scene = *built;
  const double seconds_scene = cpu_seconds_now() - begun;
  const LevelPlan levels = initial_levels(*scene);
  TRY_DO(fits_memory(*scene, levels));
  // errors that would else be found only during the run
  if (preset.indentation.requested() && preset.indentation.joint.size() == 2)
    TRY_DO(pushed_joint(preset.indentation, scene->footprint, {}));
  TRY_DO(check_steps(preset.step, scene->footprint));
  TRY_DO(check_opening(preset, *scene));
  TRY_DO(check_motion(*scene));
  Plan plan;
  plan.scene = scene;
  plan.model = word_of(scene->rod_model);
  plan.memory_GB = expected_GB(memory_GB(scene->footprint, scene->rod_model, levels), preset);
  plan.model_reason = preset::model_reason(preset);
  plan.levels = levels.edges_per_segment;
  plan.edges_per_segment = plan.levels.back();
  plan.extrapolated = levels.extrapolate;
  plan.rods = int(scene->footprint.rods.size());
  plan.joints = int(scene->footprint.joints.size());
  plan.cells = int(scene->footprint.cells.size());
  plan.dof = dof_of(*scene, plan.edges_per_segment);
  plan.expected_error_mm =
      (scene->rod_model == RodModel::net ? net_error : expected_error(levels)) *
      scene->length_scale_mm;
  plan.expected_seconds = seconds_scene + expected_seconds(*scene, preset);
  plan.bending = expected_bending(*scene);
  plan.left_out = left_out_of(*scene);
  if (std::string against = preset::joints_against(preset); !against.empty())
    plan.left_out.push_back(std::move(against));
  if (scene->mesh_net) plan.net = scene->mesh_net->sentences();
  plan.footprint = fmt::format("{} rods, {} joints, {} cells", plan.rods, plan.joints, plan.cells);
  // a ring has no legs
  if (const double d = scene->footprint.spacing; scene->footprint.longest_leg() > 0)
    plan.footprint +=
        fmt::format("; {:.2f} to {:.2f} d from a rod's last joint to the boundary",
                    scene->footprint.shortest_leg() / d, scene->footprint.longest_leg() / d);
  if (const int lone = scene->footprint.lone_lines; lone > 0)
    plan.footprint += fmt::format("; {} more would cross no other and {} left out", lone,
                                  lone == 1 ? "is" : "are");
  if (scene->blocks)
    for (const Seam& seam : scene->blocks->seams())
      plan.seams.push_back(fmt::format(
          "{}: {} rods across, gaps of at most {:.2f} mm, kinks of at most {:.1f} degrees",
          seam.name, seam.rods.size(), seam.max_gap_mm(), seam.max_kink_deg()));
  return plan;
}

Result<EquilibriumPath> follow(const preset::Preset& preset,
                               const std::shared_ptr<const Scene>& scene, bool stills,
                               record::Sink& frames, Watch& watch, record::Summary& summary,
                               const RunContext& context) {
  const double begin = seconds_now();
  LastFrame sink(frames, watch);
  auto path = path_for(preset, scene, stills, sink, watch, context);
  if (watch.cancelled()) return stopped();
  if (!path) return tl::unexpected<Error>(path.error());
  if (!sink.frame())
    return fail(Fault::no_equilibrium,
                "no frame was certified: " +
                    (path->limit_reason.empty() ? not_in_the_flat(*path) : path->limit_reason));
  summary = summary_of(preset, *scene, sink);
  put_path(*path, summary);
  summary.steps = messages_of_steps(*path);
  if (preset.indentation.requested() && !path->simulation.constraints().empty()) {
    const int pushed = path->simulation.constraints().front().node;
    const FootprintJoint& at = scene->footprint.joints[std::size_t(pushed)];
    summary.pushed_joint = fmt::format("[{}, {}]", at.i, at.j);
  }
  summary.seconds_simulation = seconds_now() - begin - summary.seconds_setup;
  return path;
}

Result<record::Summary> run(const preset::Preset& preset, bool stills, record::Sink& sink,
                            Watch& watch) {
  TRY(scene, shared_scene_of(preset));
  return run(preset, *scene, stills, sink, watch);
}

Result<record::Summary> run(const preset::Preset& preset, const std::shared_ptr<const Scene>& scene,
                            bool stills, record::Sink& sink, Watch& watch,
                            const RunContext& context) {
  record::Summary summary;
  if (scene->rod_model != RodModel::net) {
    TRY_DO(follow(preset, scene, stills, sink, watch, summary, context));
    return summary;
  }
  LastFrame seen(sink, watch);
  const double begin = seconds_now();
  TRY(mesh, write_net_frames(*scene, samples_of(preset, stills), seen, watch));
  summary = summary_of(preset, *scene, seen);
  summary.edges_per_segment = mesh->edges_per_segment;
  summary.seconds_simulation = seconds_now() - begin;
  return summary;
}

Result<ExperimentResult> run(const preset::Preset& preset, bool stills, Watch& watch) {
  record::MemorySink sink;
  TRY(summary, run(preset, stills, sink, watch));
  return ExperimentResult{std::move(sink.trajectory()), std::move(*summary)};
}

}  // namespace gridshell::simulate
