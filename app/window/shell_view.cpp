// What is seen of the shell in hand: the sight is made anew after every command.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/window/edit_session.h"
#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

constexpr double same_shape = 2e-3;        // of the length scale
constexpr double least_shortening = 1e-3;  // nearer to the flat no path is followed

/// Where each of the motions' parameters is as near to the flat as a path goes, as a progress.
double least_progress_of(const Session& session) {
  if (session.scene().drawn_in_space) return 0;
  const NestedShell& shell = session.shell();
  PinnedMotion motion = pinned_motion(shell.mesh(0), session.scene().motion);
  const auto t = parameter_of_shortening(shell.mesh(0), motion, least_shortening);
  return t ? std::min(1.0, progress_at(*t)) : 0;
}

/// Of a group by Schoenflies' name.
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

/// Why a state at rest is less than what the tolerance asks for.
std::string EditSession::accuracy_warning() const {
  if (!refined_ || scene_->edges_per_segment != 0) return "";
  if (only_coarse_mesh_) return "on coarse meshes alone";
  const double asked_mm = scene_->tolerance * scene_->length_scale_mm;
  const double error_mm = shell_view_.certificate.error_estimate_mm;
  if (std::isnan(error_mm)) return "its error not known";
  return error_mm <= asked_mm ? "" : fmt::format("error above the {:.2g} mm asked for", asked_mm);
}

void EditSession::look() {
  ShellView& s = shell_view_;
  s.undo_steps = int(undo_.size());
  s.redo_steps = int(redo_.size());
  s.preset = preset_;
  if (!session_) return;
  look_at_layout();
  if (!s.layout) return;
  s.frame = experiment::frame_of(*session_);
  s.frame.progress = s.frame.actuation = s.progress = boundary_.progress;
  s.frame.boundary_radius_mm = scene_->radius_at(boundary_.progress);
  if (s.preset.footprint.kind == preset::FootprintKind::circle)
    s.preset.set_radii(scene_->radius_begin_mm, s.frame.boundary_radius_mm);
  s.certificate = session_->certificate();
  s.meshes = session_->shell().plan().edges_per_segment;
  s.leader = coarse_plan(*scene_).edges_per_segment.front();
  s.refined = refined_;
  s.accuracy_warning = accuracy_warning();
  s.steps = steps_;
  s.radius_end_mm = scene_->radius_end_mm;
  s.edges_dragged.clear();
  for (Eigen::Index k = 0; k < boundary_.dragged.cols(); ++k)
    if (!boundary_.dragged.col(k).isZero(0))
      s.edges_dragged.push_back({int(k), boundary_.dragged.col(k).norm()});
  s.rods_changed_late = changed_late_;
  s.snapped = snapped_;
  s.design = design_;
  look_at_normals();
  s.held.clear();
  for (std::size_t k = 0; k < session_->holds().size(); ++k) {
    const Constraint& hold = session_->holds()[k];
    const Eigen::Vector3d from =
        grip_origins_.count(hold.node) ? grip_origins_[hold.node] : s.frame.nodes.col(hold.node);
    // what is free to move across the push is no part of its depth
    HeldJoint held{hold.node, hold.part(session_->force(k)),
                   hold.part(s.frame.nodes.col(hold.node) - from)};
    if (hold.directions.cols() == 1) held.along = hold.directions.col(0);
    // outwards, whichever way it was pushed
    if (held.along.dot(s.normals.col(hold.node)) < 0) held.along *= -1;
    s.held.push_back(held);
  }
  look_at_symmetry();
  look_at_rods();
  look_at_soft_mode();
  if (!s.first) s.first = std::make_shared<const record::Frame>(s.frame);
  ++s.equilibria;
}

/// The layout belongs to a scene and a mesh; both change seldom.
void EditSession::look_at_layout() {
  const RodMesh& mesh = session_->shell().finest();
  if (shell_view_.layout && nodes_shown_ == mesh.rod_nodes()) return;
  auto layout = experiment::layout_of(*scene_, mesh);
  if (!layout) {
    shell_view_.trouble = layout.error().message;
    return;
  }
  // a record has it beside a net alone
  if (layout->flat_nodes.cols() == 0)
    layout->flat_nodes = drawn_nodes(mesh, scene_->flat).leftCols(mesh.rod_nodes());
  shell_view_.layout = std::make_shared<const record::Layout>(std::move(*layout));
  shell_view_.least_progress = least_progress_of(*session_);
  nodes_shown_ = mesh.rod_nodes();
  // joints come first on every mesh, and the coarsest is the quickest to look at
  const NestedShell& shell = session_->shell();
  const RodMesh& coarsest = shell.mesh(0);
  symmetries_ = study::symmetries_of_shell(*scene_, coarsest,
                                                symmetries_of(coarsest, shell.motion(0).at(1)));
}

/// Of the shape, whatever holds it. A square that is mapped onto itself alone has none to tell of.
void EditSession::look_at_symmetry() {
  shell_view_.symmetry.clear();
  if (!refined_ || symmetries_.size() < 2) return;
  const Eigen::Matrix3Xd joints =
      shell_view_.frame.nodes.leftCols(Eigen::Index(shell_view_.layout->joints.size()));
  const double within_mm = same_shape * scene_->length_scale_mm;
  shell_view_.symmetry = words_of_group(name_of_group(group_of(symmetries_, joints, within_mm)));
}

/// Of the net where there is one, as a preset's push has it; else of the shell as it stands.
void EditSession::look_at_normals() {
  const Footprint& footprint = scene_->footprint;
  Eigen::Matrix3Xd& normals = shell_view_.normals;
  const JointTangents tangents =
      joint_tangents(footprint, session_->shell().finest(), session_->nodes());
  normals.resize(3, tangents.u.cols());
  for (Eigen::Index k = 0; k < tangents.u.cols(); ++k) {
    normals.col(k) = tangents.normal(k);
    if (!scene_->net) continue;
    const FootprintJoint& joint = footprint.joints[std::size_t(k)];
    if (const auto point = scene_->net->at(joint.u, joint.v)) normals.col(k) = point->normal();
  }
}

/// What colours show: axial force and bending energy at the nodes, and the cells' deviation.
void EditSession::look_at_rods() {
  const record::Layout& layout = *shell_view_.layout;
  shell_view_.axial_N = record::axial_force_of_nodes_N(layout, shell_view_.frame);
  shell_view_.bending_mJ_m = record::bending_of_nodes_mJ_per_m(layout, shell_view_.frame);
  shell_view_.deviation = record::deviation_of_cells(layout, shell_view_.frame);
  if (!design_ || !target_) return;
  const Eigen::Index joints = Eigen::Index(layout.joints.size());
  look_at_deviation(target_->distances(shell_view_.frame.nodes.leftCols(joints)).size());
}

/// From what a design aims at.
void EditSession::look_at_deviation(const Eigen::VectorXd& of_joints_mm) {
  const record::Layout& layout = *shell_view_.layout;
  shell_view_.deviation.resize(Eigen::Index(layout.cells.size()));
  for (std::size_t k = 0; k < layout.cells.size(); ++k) {
    double sum_mm = 0;
    for (const int joint : layout.cells[k].joints) sum_mm += of_joints_mm[joint];
    shell_view_.deviation[Eigen::Index(k)] = sum_mm / 4 / layout.length_scale_mm;
  }
}

/// How a state that is not stable would leave: its softest mode on the finest mesh, its largest
/// move 1.
void EditSession::look_at_soft_mode() {
  shell_view_.soft_mode.resize(3, 0);
  if (shell_view_.stable()) return;
  NestedShell& shell = session_->shell();
  const RodMesh& mesh = shell.mesh(0);
  Linearisation& system = shell.system(0);
  system.at(shell.state().levels[0], false);
  const Eigen::Matrix3Xd mode = softest_mode(system, {}, unwatched);
  const Eigen::Matrix3Xd coarse = nodes_of(mesh, shell.model(0), mode);
  Eigen::Matrix3Xd fine;
  if (shell.levels() > 1)
    MeshTransfer(mesh, shell.finest()).nodes(coarse, fine);
  else
    fine = coarse;
  shell_view_.soft_mode = fine.leftCols(shell_view_.frame.nodes.cols());
  shell_view_.soft_mode /=
      std::max(1e-12, std::sqrt(shell_view_.soft_mode.colwise().squaredNorm().maxCoeff()));
}

}  // namespace gridshell::window
