// The view of the edited shell, made again after every command.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/window/edit_session.h"

namespace gridshell::window {
namespace {

constexpr double same_shape = 2e-3;        // of the length scale
constexpr double least_shortening = 1e-3;  // nearer to the flat state no path is followed

/// The least progress of the boundary to which a path is followed.
double least_progress_of(const Simulation& session) {
  if (session.scene().from_drawing) return 0;
  const NestedShell& shell = session.shell();
  PinnedMotion motion = pinned_motion(shell.mesh(0), session.scene().motion);
  const auto t = parameter_of_shortening(shell.mesh(0), motion, least_shortening);
  return t ? std::min(1.0, progress_at(*t)) : 0;
}

/// Text for a symmetry group, by its Schoenflies name.
std::string words_of_group(const std::string& group) {
  static const std::map<std::string, std::string> words{{"C1", "no symmetry"},
                                                        {"Cs_axis", "one axial mirror"},
                                                        {"Cs_diagonal", "one diagonal mirror"},
                                                        {"C2", "half turn"},
                                                        {"C2v_axes", "two axial mirrors"},
                                                        {"C2v_diagonals", "two diagonal mirrors"},
                                                        {"C4", "quarter turns"},
                                                        {"C4v", "all symmetries of the square"}};
  const auto found = words.find(group);
  return found == words.end() ? "symmetry " + group : found->second;
}

}  // namespace

PlotPoint plot_point_of(const ShellView& shell) {
  const record::Frame& frame = shell.frame;
  PlotPoint now{.equilibrium = double(shell.equilibria),
                .radius_mm = frame.boundary_radius_mm,
                .progress = shell.progress,
                .height_mm = frame.height_mm,
                .energy_mJ = frame.energies.total(),
                .total_K = frame.total_K,
                .residual_N = shell.certificate.residual_N,
                .error_mm = shell.certificate.error_estimate_mm,
                .steps = int(shell.steps.size()),
                .refined = shell.refined,
                .stable = shell.stable(),
                .coarse = !shell.refined && shell.meshes.size() < 2};
  if (!shell.constrained.empty()) {
    const ConstrainedJoint& joint = shell.constrained.back();
    now.joint = joint.joint;
    now.depth_mm = joint.moved_mm.norm();
    const double along = joint.force_N.dot(joint.moved_mm.normalized());
    now.force_N = std::isfinite(along) ? along : 0;
  }
  return now;
}

std::shared_ptr<const ShellView> view_of(record::Layout layout, record::Frame frame,
                                         record::Frame first) {
  auto shell = std::make_shared<ShellView>();
  shell->layout = std::make_shared<const record::Layout>(std::move(layout));
  shell->frame = std::move(frame);
  shell->first = std::make_shared<const record::Frame>(std::move(first));
  shell->deviation = record::deviation_of_cells(*shell->layout, shell->frame);
  return shell;
}

/// Why an equilibrium is less accurate than the tolerance requires.
std::string EditSession::accuracy_warning() const {
  if (!now_.refined || now_.scene->edges_per_segment != 0) return "";
  if (only_coarse_mesh_) return "on coarse meshes alone";
  const double requested_mm = now_.scene->tolerance * now_.scene->length_scale_mm;
  const double error_mm = view_.certificate.error_estimate_mm;
  if (std::isnan(error_mm)) return "its error not known";
  return error_mm <= requested_mm
             ? ""
             : fmt::format("error above the requested {:.2g} mm", requested_mm);
}

void EditSession::update_view() {
  ShellView& s = view_;
  s.undo_steps = int(undo_.size());
  s.redo_steps = int(redo_.size());
  static_cast<ViewedState&>(s) = now_;
  if (!session_) return;
  update_layout();
  if (!s.layout) return;
  s.frame = simulate::frame_of(*session_);
  s.frame.progress = s.frame.actuation = s.progress = session_->progress();
  s.frame.boundary_radius_mm = now_.scene->radius_at(session_->progress());
  if (s.preset.footprint.kind == preset::FootprintKind::circle)
    s.preset.set_radii(now_.scene->radius_begin_mm, s.frame.boundary_radius_mm);
  s.certificate = session_->certificate();
  s.meshes = session_->shell().plan().edges_per_segment;
  s.accuracy_warning = accuracy_warning();
  s.radius_end_mm = now_.scene->radius_end_mm;
  s.edges_dragged.clear();
  for (Eigen::Index k = 0; k < session_->dragged().cols(); ++k)
    if (!session_->dragged().col(k).isZero(0))
      s.edges_dragged.push_back({int(k), session_->dragged().col(k).norm()});
  update_normals();
  s.constrained.clear();
  const auto& origins = session_->constraint_origins;
  for (std::size_t k = 0; k < session_->constraints().size(); ++k) {
    const Constraint& constraint = session_->constraints()[k];
    const Eigen::Vector3d from = origins.contains(constraint.node)
                                     ? origins.at(constraint.node)
                                     : s.frame.nodes.col(constraint.node);
    // displacements in free directions are not part of the depth
    ConstrainedJoint joint{constraint.node, constraint.part(session_->force(k)),
                           constraint.part(s.frame.nodes.col(constraint.node) - from)};
    if (constraint.directions.cols() == 1) joint.along = constraint.directions.col(0);
    // outwards, regardless of the direction of the push
    if (joint.along.dot(s.normals.col(constraint.node)) < 0) joint.along *= -1;
    s.constrained.push_back(joint);
  }
  update_symmetry();
  update_deviation();
  update_lowest_mode();
  if (!s.first) s.first = now_.first = std::make_shared<const record::Frame>(s.frame);
  ++s.equilibria;
}

/// Makes the layout again if the scene or the mesh changed.
void EditSession::update_layout() {
  const RodMesh& mesh = session_->shell().finest();
  if (view_.layout && nodes_shown_ == mesh.rod_nodes()) return;
  auto layout = simulate::layout_of(*now_.scene, mesh);
  if (!layout) {
    view_.error = layout.error().message;
    return;
  }
  // layout_of() gives flat nodes only for shells on nets
  if (layout->flat_nodes.cols() == 0)
    layout->flat_nodes = drawn_nodes(mesh, now_.scene->flat).leftCols(mesh.rod_nodes());
  view_.layout = std::make_shared<const record::Layout>(std::move(*layout));
  const Footprint& footprint = now_.scene->footprint;
  const Eigen::Matrix3Xd& net = view_.layout->net_nodes;
  view_.net_K.resize(0);
  if (net.cols() > 0) view_.net_K = cell_curvature(footprint, joint_tangents(footprint, mesh, net));
  view_.least_progress = least_progress_of(*session_);
  nodes_shown_ = mesh.rod_nodes();
  // on the coarsest mesh, which is the fastest; joints come first on every mesh
  const NestedShell& shell = session_->shell();
  const RodMesh& coarsest = shell.mesh(0);
  symmetries_ = study::symmetries_of_shell(*now_.scene, coarsest,
                                           symmetries_of(coarsest, shell.motion(0).at(1)));
}

/// Finds the symmetry of the shape, regardless of constraints. It is not named if the footprint has
/// none.
void EditSession::update_symmetry() {
  view_.symmetry.clear();
  if (!now_.refined || symmetries_.size() < 2) return;
  const Eigen::Matrix3Xd joints =
      view_.frame.nodes.leftCols(Eigen::Index(view_.layout->joints.size()));
  const double within_mm = same_shape * now_.scene->length_scale_mm;
  view_.symmetry = words_of_group(name_of_group(group_of(symmetries_, joints, within_mm)));
}

/// Normals at the joints: those of the net if there is one, as for the push of a preset; else those
/// of the current shell.
void EditSession::update_normals() {
  const Footprint& footprint = now_.scene->footprint;
  Eigen::Matrix3Xd& normals = view_.normals;
  const JointTangents tangents =
      joint_tangents(footprint, session_->shell().finest(), session_->nodes());
  normals.resize(3, tangents.u.cols());
  for (Eigen::Index k = 0; k < tangents.u.cols(); ++k) {
    normals.col(k) = tangents.normal(k);
    if (!now_.scene->net) continue;
    const FootprintJoint& joint = footprint.joints[std::size_t(k)];
    if (const auto point = now_.scene->net->at(joint.u, joint.v)) normals.col(k) = point->normal();
  }
}

/// Computes the deviation of the cells; that of a designed shell is from its target.
void EditSession::update_deviation() {
  view_.deviation = record::deviation_of_cells(*view_.layout, view_.frame);
  if (!now_.design || !now_.target) return;
  const Eigen::Index joints = Eigen::Index(view_.layout->joints.size());
  update_deviation(now_.target->distances(view_.frame.nodes.leftCols(joints)).size());
}

/// Deviation of the cells, from the distances of the joints to the target of a design.
void EditSession::update_deviation(const Eigen::VectorXd& of_joints_mm) {
  view_.deviation =
      record::mean_of_cells(*view_.layout, of_joints_mm) / view_.layout->length_scale_mm;
}

/// Computes the lowest mode of an unstable state on the mesh next to the finest, and interpolates
/// it to that, with a largest displacement of 1.
void EditSession::update_lowest_mode() {
  view_.soft_mode.resize(3, 0);
  if (view_.stable()) return;
  NestedShell& shell = session_->shell();
  const int level = std::max(0, shell.last() - 1);
  const RodMesh& mesh = shell.mesh(level);
  Linearisation& system = shell.system(level);
  system.at(shell.state().levels[std::size_t(level)], false);
  const Eigen::Matrix3Xd mode = softest_mode(system, {}, unwatched);
  const Eigen::Matrix3Xd coarse = nodes_of(mesh, shell.model(level), mode);
  Eigen::Matrix3Xd fine;
  if (shell.levels() > 1)
    MeshTransfer(mesh, shell.finest()).nodes(coarse, fine);
  else
    fine = coarse;
  view_.soft_mode = fine.leftCols(view_.frame.nodes.cols());
  view_.soft_mode /= std::max(1e-12, std::sqrt(view_.soft_mode.colwise().squaredNorm().maxCoeff()));
}

}  // namespace gridshell::window
