#include "engine/experiment/frames.h"

#include "engine/experiment/block_design.h"
#include "engine/experiment/net_design.h"
#include "engine/measure/bins.h"
#include "engine/measure/gauss.h"

namespace gridshell::experiment {
namespace {

/// Measures that are extrapolated like the positions.
struct Measures {
  Eigen::VectorXd K;
  Energies energies;
};

Measures measure(const ActuationScene& scene, const RodMesh& mesh, const Model& model,
                 const Eigen::Matrix3Xd& x) {
  return {cell_curvature(scene.footprint, joint_tangents(scene.footprint, mesh, x)),
          energies_of(model, x)};
}

Measures measure(const ActuationScene& scene, const NestedShell& shell) {
  const int last = shell.levels() - 1;
  const NestedState& state = shell.state();
  Measures fine = measure(scene, shell.mesh(last), shell.model(last), state.levels[last].x);
  if (!shell.plan().extrapolate) return fine;
  const Measures coarse =
      measure(scene, shell.mesh(last - 1), shell.model(last - 1), state.levels[last - 1].x);
  fine.K = (4 * fine.K - coarse.K) / 3;
  fine.energies = (4 * fine.energies - coarse.energies) / 3;
  return fine;
}

}  // namespace

Eigen::MatrixX3d bins_of(const ActuationScene& scene, const Eigen::Matrix3Xd& x,
                         const Eigen::VectorXd& K) {
  // an assemblage need not lie about the origin
  const auto ends = scene.actuated_boundary.row(0);
  const double middle = 0.5 * (ends.minCoeff() + ends.maxCoeff()), L = ends.maxCoeff() - middle;
  Eigen::VectorXd along(K.size());
  for (Eigen::Index k = 0; k < K.size(); ++k) {
    const auto& joints = scene.footprint.cells[std::size_t(k)].joints;
    const double at = x(0, joints[0]) + x(0, joints[1]) + x(0, joints[2]) + x(0, joints[3]);
    along[k] = (0.25 * at - middle) / L;
  }
  const CurvatureBins bins = curvature_bins(along, K);
  Eigen::MatrixX3d rows(bins.mean.size(), 3);
  rows << bins.mean, bins.deviation, bins.cells.cast<double>();
  return rows;
}

Result<record::Layout> layout_of(const ActuationScene& scene, const RodMesh& mesh) {
  record::Layout layout;
  layout.spacing_mm = scene.footprint.spacing;
  layout.rod_diameter_mm = scene.rod_diameter_mm;
  layout.length_scale_mm = scene.length_scale_mm;
  for (const std::vector<int>& nodes : mesh.rods) {
    layout.rods.emplace_back();
    for (int node : nodes)
      if (!mesh.is_ghost(node)) layout.rods.back().push_back(node);
  }
  for (int k = 0; k < mesh.joints; ++k) {
    const FootprintJoint& joint = scene.footprint.joints[k];
    layout.joints.push_back({joint.i, joint.j, joint.u, joint.v, k});
  }
  for (const FootprintCell& cell : scene.footprint.cells) {
    const FootprintJoint& corner = scene.footprint.joints[cell.joints[0]];
    const double half = 0.5 * scene.footprint.spacing;
    layout.cells.push_back({cell.i, cell.j, corner.u + half, corner.v + half, cell.joints});
  }
  for (int k = 0; k < mesh.edge_points; ++k) layout.edge_points.push_back(mesh.joints + k);
  layout.original_boundary = scene.original_boundary;
  layout.actuated_boundary = scene.actuated_boundary;
  for (const PointLoad& load : scene.rods.points)
    layout.loaded_joints.push_back({load.joint, load.force.normalized()});
  if (scene.net) {
    const Eigen::Matrix2Xd flat = mesh.flat.leftCols(mesh.rod_nodes());
    auto net = sample(*scene.net, flat);
    if (!net) return tl::unexpected<Error>(net.error());
    layout.net_nodes = std::move(*net);
    layout.flat_nodes = scene.flat.all(flat);
  }
  if (scene.blocks) {
    if (auto shown = record_blocks(*scene.blocks, scene.flat, layout); !shown)
      return tl::unexpected<Error>(shown.error());
  }
  return layout;
}

void put_shape(const ActuationScene& scene, const RodMesh& mesh, const Eigen::Matrix3Xd& x,
               const Eigen::VectorXd& K, record::Frame& frame) {
  frame.cell_K = K;
  frame.total_K = K.sum();
  frame.K_bins = bins_of(scene, x, K);
  frame.height_mm = x.row(2).leftCols(mesh.joints).maxCoeff() - scene.flat.origin.z();
  frame.nodes = x.leftCols(mesh.rod_nodes());
}

record::Frame frame_of(const ActuationScene& scene, NestedShell& shell) {
  const NestedState& state = shell.state();
  const Measures measures = measure(scene, shell);
  record::Frame frame;
  frame.energies = measures.energies;
  put_shape(scene, shell.mesh(shell.levels() - 1), state.x, measures.K, frame);
  frame.residual_N = state.residual_N;
  frame.negative_pivots = state.inertia.negative_pivots;
  frame.error_estimate_mm = state.error_estimate_mm;
  return frame;
}

}  // namespace gridshell::experiment
