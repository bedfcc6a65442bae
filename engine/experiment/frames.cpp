#include "engine/experiment/frames.h"

#include "engine/measure/bins.h"
#include "engine/measure/gauss.h"
#include "engine/preset/rung.h"
#include "engine/scene/second_ring.h"

namespace gridshell::experiment {
namespace {

constexpr int most_frames_in_motion = 24;
constexpr double still_move = 0.01;  // of d: nearer to the rest nothing is seen to move

Eigen::VectorXd curvature(const Session& session, int level) {
  const NestedShell& shell = session.shell();
  const RodMesh& mesh = shell.mesh(level);
  const Eigen::Matrix3Xd nodes =
      nodes_of(mesh, shell.model(level), shell.state().levels[std::size_t(level)].x);
  const Footprint& footprint = session.scene().footprint;
  return cell_curvature(footprint, joint_tangents(footprint, mesh, nodes));
}

/// K of the cells in bins of x/L, L the half-span of the actuated boundary and x from its middle,
/// at the nodes x; rows: bins, columns: mean, deviation, cells.
Eigen::MatrixX3d bins_of(const Scene& scene, const Eigen::Matrix3Xd& x, const Eigen::VectorXd& K) {
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

/// Adds the blocks on their own nets and the rods across their seams to a layout.
Result<void> record_blocks(const Assemblage& blocks, const FlatFrame& flat,
                           record::Layout& layout) {
  for (int k = 0; k < blocks.blocks(); ++k) {
    const auto rods = blocks.rods(k, blocks.block(k).spacing / 8);
    if (!rods) return tl::unexpected(rods.error());
    record::Part part;
    part.name = blocks.block(k).name;
    Eigen::Index points = 0;
    for (const BlockRod& rod : *rods) points += rod.net.cols();
    part.net.resize(3, points);
    part.flat.resize(3, points);
    int next = 0;
    for (const BlockRod& rod : *rods) {
      part.net.middleCols(next, rod.net.cols()) = rod.net;
      part.flat.middleCols(next, rod.net.cols()) = flat.all(rod.flat);
      part.rods.emplace_back();
      for (Eigen::Index n = 0; n < rod.net.cols(); ++n) part.rods.back().push_back(next++);
    }
    layout.parts.push_back(std::move(part));
  }
  for (const Seam& seam : blocks.seams())
    for (const SeamRod& rod : seam.rods)
      layout.seam_rods.push_back(
          {seam.name, rod.family == Family::u ? 'u' : 'v', rod.line_mm, rod.gap_mm, rod.kink_deg});
  return {};
}

}  // namespace

record::Summary summary_before(const preset::Preset& preset, const Scene& scene) {
  record::Summary s;
  s.preset = preset.name;
  s.model = word_of(scene.rung);
  s.model_reason = preset::model_reason(preset);
  s.solved = scene.rung != preset::Rung::net;
  s.rods = int(scene.footprint.rods.size());
  s.joints = int(scene.footprint.joints.size());
  s.cells = int(scene.footprint.cells.size());
  return s;
}

Result<record::Layout> layout_of(const Scene& scene, const RodMesh& mesh) {
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
    if (load.force.norm() > 0)
      layout.loaded_joints.push_back({load.joint, load.force.normalized()});
  if (scene.net) {
    const Eigen::Matrix2Xd flat = mesh.flat.leftCols(mesh.rod_nodes());
    auto net = places_on_net(scene, mesh);
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

void put_shape(const Scene& scene, const RodMesh& mesh, const Eigen::Matrix3Xd& x,
               const Eigen::VectorXd& K, record::Frame& frame) {
  frame.cell_K = K;
  frame.total_K = K.sum();
  frame.K_bins = bins_of(scene, x, K);
  frame.height_mm = x.row(2).leftCols(mesh.joints).maxCoeff() - scene.flat.origin.z();
  frame.nodes = x.leftCols(mesh.rod_nodes());
}

record::Frame frame_of(const Session& session) {
  const NestedShell& shell = session.shell();
  const int last = shell.levels() - 1;
  Eigen::VectorXd K = curvature(session, last);
  if (shell.plan().extrapolate && last > 0) K = ((4 * K - curvature(session, last - 1)) / 3).eval();
  record::Frame frame;
  put_shape(session.scene(), shell.finest(), session.nodes(), K, frame);
  frame.energies = session.energies();
  const Certificate certificate = session.certificate();
  frame.residual_N = certificate.residual_N;
  frame.negative_pivots = certificate.negative_pivots;
  frame.error_estimate_mm = certificate.error_estimate_mm;
  return frame;
}

record::Frame flat_frame(Session& session) {
  const Checkpoint before = session.save();
  const Report flat = session.begin_flat();
  record::Frame frame;
  const Scene& scene = session.scene();
  put_shape(scene, session.shell().finest(), session.nodes(),
            Eigen::VectorXd::Zero(Eigen::Index(scene.footprint.cells.size())), frame);
  frame.energies = session.shell().energies(session.shell().levels() - 1);
  frame.negative_pivots = flat.certificate.negative_pivots;
  frame.residual_N = flat.certificate.residual_N;
  frame.error_estimate_mm = 0;
  frame.boundary_radius_mm = scene.radius_begin_mm;
  session.restore(before);
  return frame;
}

namespace {

/// the moments to show
std::vector<const Moment*> shown(const std::vector<Moment>& all, double spacing) {
  std::size_t end = all.size();
  while (end > 1 &&
         largest_column(all[end - 1].state.x - all.back().state.x) < still_move * spacing)
    --end;
  std::vector<const Moment*> few;
  const double until = all[end - 1].time;
  for (std::size_t k = 0; k < end; ++k)
    if (all[k].time >= until * double(few.size() + 1) / most_frames_in_motion)
      few.push_back(&all[k]);
  return few;
}

}  // namespace

std::vector<record::Frame> frames_in_motion(Session& session, const std::vector<Moment>& moments) {
  std::vector<record::Frame> frames;
  if (moments.empty()) return frames;
  const Scene& scene = session.scene();
  NestedShell& shell = session.shell();
  const RodMesh& mesh = shell.mesh(0);
  const MeshTransfer to_finest(mesh, shell.finest());
  Linearisation& system = shell.system(0);
  for (const Moment* moment : shown(moments, scene.footprint.spacing)) {
    const Eigen::Matrix3Xd nodes = nodes_of(mesh, shell.model(0), moment->state.x);
    Eigen::Matrix3Xd x;
    to_finest.nodes(nodes, x);
    record::Frame frame;
    put_shape(scene, shell.finest(), x,
              cell_curvature(scene.footprint, joint_tangents(scene.footprint, mesh, nodes)), frame);
    system.gradient_at(moment->state);
    frame.energies = system.assembly().energies;
    frame.residual_N = system.residual();
    frame.negative_pivots = -1;
    frame.time_s = moment->time;
    frame.event = "in motion";
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace gridshell::experiment
