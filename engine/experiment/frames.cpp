#include "engine/experiment/frames.h"

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
  fine.energies.bend = (4 * fine.energies.bend - coarse.energies.bend) / 3;
  fine.energies.stretch = (4 * fine.energies.stretch - coarse.energies.stretch) / 3;
  return fine;
}

/// Rows: bins of x/L, L the half-span of the actuated boundary; columns: mean, deviation, cells.
Eigen::MatrixX3d bins_of(const ActuationScene& scene, const Eigen::Matrix3Xd& x,
                         const Eigen::VectorXd& K) {
  const double L = scene.actuated_boundary.row(0).cwiseAbs().maxCoeff();
  Eigen::VectorXd along(K.size());
  for (Eigen::Index k = 0; k < K.size(); ++k) {
    const auto& joints = scene.footprint.cells[std::size_t(k)].joints;
    along[k] = 0.25 * (x(0, joints[0]) + x(0, joints[1]) + x(0, joints[2]) + x(0, joints[3])) / L;
  }
  const CurvatureBins bins = curvature_bins(along, K);
  Eigen::MatrixX3d rows(bins.mean.size(), 3);
  rows << bins.mean, bins.deviation, bins.cells.cast<double>();
  return rows;
}

}  // namespace

record::Frame frame_of(const ActuationScene& scene, NestedShell& shell) {
  const NestedState& state = shell.state();
  const Measures measures = measure(scene, shell);
  record::Frame frame;
  frame.energy_bend_mJ = measures.energies.bend;
  frame.energy_stretch_mJ = measures.energies.stretch;
  frame.cell_K = measures.K;
  frame.total_K = measures.K.sum();
  frame.K_bins = bins_of(scene, state.x, measures.K);
  frame.height_mm =
      state.x.row(2).leftCols(shell.mesh(0).joints).maxCoeff() - scene.flat.origin.z();
  frame.residual_N = state.residual_N;
  frame.negative_pivots = state.inertia.negative_pivots;
  frame.error_estimate_mm = state.error_estimate_mm;
  frame.nodes = state.x.leftCols(shell.mesh(shell.levels() - 1).rod_nodes());
  return frame;
}

}  // namespace gridshell::experiment
