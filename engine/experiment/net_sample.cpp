#include "engine/experiment/net_sample.h"

#include "engine/core/clock.h"
#include "engine/experiment/frames.h"
#include "engine/experiment/net_design.h"
#include "engine/measure/gauss.h"

namespace gridshell::experiment {
namespace {

constexpr int edges_per_segment = 4;  // for the pictures of the rods between joints

record::Frame frame_at(const ActuationScene& scene, const RodMesh& mesh, int index, double progress,
                       const Eigen::Matrix3Xd& x, const Eigen::VectorXd& K) {
  record::Frame frame;
  put_shape(scene, mesh, x, K, frame);
  frame.index = index;
  frame.progress = frame.actuation = progress;
  frame.energies = Energies::not_known();
  frame.residual_N = record::unknown;
  frame.negative_pivots = -1;
  frame.event = progress == 0 ? "" : "the net itself, no equilibrium";
  return frame;
}

/// from the net's own tangents
Result<Eigen::VectorXd> curvature_of(const ActuationScene& scene) {
  JointTangents tangents;
  const Eigen::Index joints = Eigen::Index(scene.footprint.joints.size());
  tangents.u.resize(3, joints);
  tangents.v.resize(3, joints);
  for (Eigen::Index k = 0; k < joints; ++k) {
    const FootprintJoint& joint = scene.footprint.joints[std::size_t(k)];
    const auto point = scene.net->at(joint.u, joint.v);
    if (!point) return tl::unexpected<Error>(point.error());
    tangents.u.col(k) = point->tangent_u;
    tangents.v.col(k) = point->tangent_v;
  }
  return cell_curvature(scene.footprint, tangents);
}

}  // namespace

Result<ActuationOutcome> sample_net(const ActuationScene& scene,
                                    const std::vector<double>& progress, Watch& watch) {
  const double begin = seconds_now();
  const RodMesh mesh = mesh_rods(scene.footprint, edges_per_segment);
  auto layout = layout_of(scene, mesh);
  if (!layout) return tl::unexpected<Error>(layout.error());
  const auto K = curvature_of(scene);
  if (!K) return tl::unexpected<Error>(K.error());
  ActuationOutcome outcome;
  auto& frames = outcome.trajectory.frames;
  for (std::size_t k = 0; k < progress.size(); ++k) {
    if (progress[k] == 0)
      frames.push_back(frame_at(scene, mesh, int(k), 0, scene.flat.all(mesh.flat),
                                Eigen::VectorXd::Zero(K->size())));
    if (progress[k] == 1) frames.push_back(frame_at(scene, mesh, int(k), 1, layout->net_nodes, *K));
  }
  outcome.trajectory.layout = std::move(*layout);
  outcome.levels = {{edges_per_segment}, false};
  outcome.seconds_simulation = seconds_now() - begin;
  watch.report(1);
  return outcome;
}

}  // namespace gridshell::experiment
