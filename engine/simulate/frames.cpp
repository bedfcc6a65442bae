#include "engine/simulate/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "engine/core/algorithms.h"
#include "engine/core/try.h"
#include "engine/elastic/model.h"
#include "engine/preset/consistency.h"
#include "engine/record/frame_values.h"
#include "engine/record/shape_measures.h"
#include "engine/scene/rod_ends.h"
#include "engine/simulate/frame_forces.h"
#include "engine/simulate/frame_joints.h"

namespace gridshell::simulate {
namespace {

constexpr int most_frames_in_motion = 24;
constexpr double still_move = 0.01;  // in d: motion nearer to the equilibrium is not visible

Eigen::VectorXd curvature(const Simulation& simulation, int level) {
  const NestedShell& shell = simulation.shell();
  const RodMesh& mesh = shell.mesh(level);
  const Eigen::Matrix3Xd nodes =
      nodes_of(mesh, shell.model(level), shell.state().levels[std::size_t(level)].x);
  const Footprint& footprint = simulation.scene().footprint;
  return cell_curvature(footprint, joint_tangents(footprint, mesh, nodes));
}

Eigen::Vector3d normal_on(const Footprint& footprint, const NestedShell& shell, int level,
                          int joint) {
  const RodMesh& mesh = shell.mesh(level);
  const Eigen::Matrix3Xd nodes =
      nodes_of(mesh, shell.model(level), shell.state().levels[std::size_t(level)].x);
  return joint_tangents(footprint, mesh, nodes).normal(joint);
}

/// K of the cells in bins of x/L, L the half-span of the actuated boundary and x from its middle,
/// at the nodes x; rows: bins, columns: mean, deviation, cells.
Eigen::MatrixX3d bins_of(const Scene& scene, const Eigen::Matrix3Xd& x, const Eigen::VectorXd& K) {
  // the centre of an assemblage need not be the origin
  if (K.size() == 0) return {};
  const auto ends = scene.actuated_boundary.row(0);
  const double middle = 0.5 * (ends.minCoeff() + ends.maxCoeff()), L = ends.maxCoeff() - middle;
  if (!(L > 0)) return {};
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

void put_contacts(const record::Contacts& found, record::Frame& frame) {
  frame.contacts = int(found.interpenetrations.size());
  frame.rod_gap_mm = found.rod_gap_mm;
  frame.joint_gap_mm = found.joint_gap_mm;
}

void put_reactions(Eigen::Matrix3Xd reactions, record::Frame& frame) {
  frame.largest_force_N = reactions.cols() > 0 ? max_column_norm(reactions) : 0;
  frame.reactions_N = std::move(reactions);
}

/// Energies of a mesh and their sum, one per column.
Eigen::Matrix3Xd columns_of(const Energies& energies) {
  Eigen::Matrix3Xd columns = Eigen::Matrix3Xd::Zero(3, Energies::size + 1);
  for (const TermName& term : energy_terms) columns(0, long(term.term)) = energies[term.term];
  columns(0, Energies::size) = energies.total();
  return columns;
}

/// Writes reactions and energies by the last meshes; values along the rods are those of the finest
/// mesh.
void put_forces(const Simulation& simulation, record::Frame& frame) {
  const NestedShell& shell = simulation.shell();
  const int last = shell.levels() - 1;
  std::vector<Eigen::Matrix3Xd> reactions, energies;
  std::vector<Energies> by_term;
  for (int k = shell.first_of_last_three(); k <= last; ++k) {
    const Assembly at = shell.forces(k);
    reactions.push_back(reactions_of(shell.mesh(k), shell.model(k), at, simulation.constraints()));
    energies.push_back(columns_of(at.energies));
    by_term.push_back(at.energies);
    if (k == last)
      put_rods(simulation.scene(), shell.mesh(k), shell.model(k), shell.state().levels.back(), at,
               frame);
  }
  const bool extrapolate = shell.extrapolates();
  CertifiedVectors force =
      certify_forces(reactions, extrapolate, shell.model(last), by_term.back());
  put_reactions(std::move(force.value), frame);
  frame.force_error_N = force.error;
  frame.loads_N = loads_on(shell.finest(), shell.model(last), shell.state().levels.back().x,
                           shell.outside(last));
  frame.brace_force_N =
      brace_forces(simulation.scene().footprint, shell.model(last), shell.state().levels.back().x);
  frame.energies = by_term.back();
  if (extrapolate && by_term.size() > 1)
    frame.energies = extrapolated(by_term.back(), by_term[by_term.size() - 2]);
  frame.energy_error_mJ = std::max(
      certify_forces(energies, extrapolate, shell.model(last), by_term.back()).error,
      least_energy_error(shell.model(last), by_term.back(), shell.finest().edges_per_segment));
  put_joints(simulation, frame);
}

/// Adds the blocks on their own nets and the rods across their seams to a layout.
Result<void> record_blocks(const Assemblage& blocks, const FlatFrame& flat,
                           record::Layout& layout) {
  for (int k = 0; k < blocks.blocks(); ++k) {
    TRY(rods, blocks.rods(k, blocks.block(k).spacing / 8));
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

Eigen::Vector3d joint_normal(const Footprint& footprint, const NestedShell& shell, int joint) {
  const Eigen::Vector3d fine = normal_on(footprint, shell, shell.last(), joint);
  if (shell.state().measured == shell.last()) return fine;
  return (4 * fine - normal_on(footprint, shell, shell.last() - 1, joint)).normalized();
}

record::Summary summary_before(const preset::Preset& preset, const Scene& scene) {
  record::Summary s;
  s.preset = preset.name;
  s.model = word_of(scene.rod_model);
  s.model_reason = preset::model_reason(preset);
  if (const std::string balls = ends_on_balls(scene); !balls.empty())
    s.model_reason += "; " + balls;
  s.solved = scene.rod_model != RodModel::net;
  s.rods = int(scene.footprint.rods.size());
  s.joints = int(scene.footprint.joints.size());
  s.cells = int(scene.footprint.cells.size());
  return s;
}

std::string ends_on_balls(const Scene& scene) {
  const auto passes = [&](int joint) { return scene.rods.law(joint).twist_Nmm > 0; };
  const auto joints = int(scene.footprint.joints.size());
  int connected = 0, ends = 0;
  for (int joint = 0; joint < joints; ++joint) connected += passes(joint);
  if (connected == 0 || connected == joints || scene.rod_model != RodModel::twist) return "";
  std::set<int> balls;
  for (const FootprintRod& rod : scene.footprint.rods)
    for (const auto& [end, joint] :
         {std::pair(rod.begin, rod.joints.front()), {rod.end, rod.joints.back()}}) {
      if (end != RodEnd::joined || rod.closed() || passes(joint)) continue;
      ++ends;
      balls.insert(joint);
    }
  if (ends == 0) return "";
  std::string text = fmt::format(
      "{} ends of rods are balls, at {} joints without a law ([{}, {}] first), though laws connect "
      "{} other joints: rods turn freely there and pass no bending or twist to one another",
      ends, balls.size(), scene.footprint.joints[std::size_t(*balls.begin())].i,
      scene.footprint.joints[std::size_t(*balls.begin())].j, connected);
  return text + "; \"law\": \"hinge\" in the network's file gives all joints one";
}

record::Layout parts_of(const Scene& scene, const RodMesh& mesh) {
  record::Layout layout;
  layout.spacing_mm = scene.footprint.spacing;
  layout.rod_diameter_mm = scene.rod_diameter_mm;
  const auto other = [&](double diameter) { return diameter != scene.rod_diameter_mm; };
  if (std::ranges::any_of(scene.drawn_diameters_mm, other))
    layout.diameters_mm = scene.drawn_diameters_mm;
  layout.laths_mm = scene.laths_mm;
  layout.strength_MPa = scene.strength_MPa;
  layout.length_scale_mm = scene.length_scale_mm;
  for (const std::vector<int>& nodes : mesh.rods) {
    layout.rods.emplace_back();
    for (int node : nodes)
      if (!mesh.is_ghost(node)) layout.rods.back().push_back(node);
  }
  for (int k = 0; k < mesh.joints; ++k) {
    const FootprintJoint& joint = scene.footprint.joints[k];
    layout.joints.push_back({joint.i, joint.j, joint.u, joint.v, k});
    if (!mesh.eccentric.empty()) layout.above.push_back(k);
  }
  for (const EccentricJoint& at : mesh.eccentric) layout.above[std::size_t(at.joint)] = at.node;
  layout.joint_diameter_mm = scene.joint_diameter_mm;
  layout.joint_height_mm = scene.joint_height_mm;
  if (scene.table) layout.table_mm = scene.flat.origin.z();
  return layout;
}

Result<record::Layout> layout_of(const Scene& scene, const RodMesh& mesh) {
  record::Layout layout = parts_of(scene, mesh);
  for (const FootprintRod& rod : scene.footprint.rods)
    layout.families.emplace_back(rod.family == Family::other ? "other" : name_of(rod.family));
  layout.supports = supports_of(mesh);
  layout.spring_N_per_mm.resize(3, Eigen::Index(mesh.springs.size()));
  for (const MeshSpring& spring : mesh.springs) {
    layout.spring_N_per_mm.col(Eigen::Index(layout.sprung.size())) = spring.N_per_mm;
    layout.sprung.push_back(spring.node);
  }
  for (const FootprintCell& cell : scene.footprint.cells) {
    const FootprintJoint& corner = scene.footprint.joints[cell.joints[0]];
    const double half = 0.5 * scene.footprint.spacing;
    layout.cells.push_back({cell.i, cell.j, corner.u + half, corner.v + half, cell.joints});
  }
  for (int k = 0; k < mesh.edge_points; ++k) layout.edge_points.push_back(end_node(mesh, k));
  layout.original_boundary = scene.original_boundary;
  layout.actuated_boundary = scene.actuated_boundary;
  if (scene.net) {
    const Eigen::Matrix2Xd flat = mesh.flat.leftCols(mesh.rod_nodes());
    TRY(net, positions_on_net(scene, mesh));
    layout.net_nodes = std::move(*net);
    layout.flat_nodes = scene.flat.all(flat);
  }
  if (scene.blocks) {
    TRY_DO(record_blocks(*scene.blocks, scene.flat, layout));
  }
  return layout;
}

Result<record::Layout> layout_of(const Simulation& simulation) {
  TRY(layout, layout_of(simulation.scene(), simulation.shell().finest()));
  layout->extrapolated = simulation.shell().plan().extrapolate;
  return layout;
}

void fill_shape(const Scene& scene, const RodMesh& mesh, const Eigen::Matrix3Xd& x,
                const Eigen::VectorXd& K, record::Frame& frame) {
  frame.cell_K = K;
  frame.total_K = K.sum();
  frame.K_bins = bins_of(scene, x, K);
  frame.height_mm = x.row(2).leftCols(mesh.joints).maxCoeff() - scene.flat.origin.z();
  frame.nodes = x.leftCols(mesh.rod_nodes());
  frame.lowest_mm = frame.nodes.row(2).minCoeff() - scene.flat.origin.z();
}

record::Frame frame_of(const Simulation& simulation) {
  const NestedShell& shell = simulation.shell();
  const int last = shell.levels() - 1;
  Eigen::VectorXd K = curvature(simulation, last);
  if (shell.extrapolates()) K = richardson(K, curvature(simulation, last - 1));
  record::Frame frame;
  fill_shape(simulation.scene(), shell.finest(), simulation.nodes(), K, frame);
  const Certificate certificate = simulation.certificate();
  frame.residual_N = certificate.residual_N;
  frame.negative_pivots = certificate.negative_pivots;
  frame.error_estimate_mm = certificate.error_estimate_mm;
  put_contacts(simulation.contacts(), frame);
  put_forces(simulation, frame);
  return frame;
}

void complete_shape(const Simulation& simulation, const record::Contacts& contacts,
                    record::Frame& frame) {
  const NestedShell& shell = simulation.shell();
  const RodMesh& mesh = shell.finest();
  const Scene& scene = simulation.scene();
  fill_shape(scene, mesh, Eigen::Matrix3Xd(frame.nodes), Eigen::VectorXd(frame.cell_K), frame);
  put_contacts(contacts, frame);
  put_reactions(std::move(frame.reactions_N), frame);
  const Model& model = shell.model(shell.levels() - 1);
  std::vector<double> strain;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    for (const int node : mesh.rods[r])
      if (!mesh.is_ghost(node))
        strain.push_back(
            model.rods[r].fibres.strain(frame.curvature_per_mm[Eigen::Index(strain.size())]));
  put_strains(scene, mesh, model, strain, frame);
}

double utilisation_of(const Simulation& simulation) {
  const NestedShell& shell = simulation.shell();
  const int last = shell.levels() - 1;
  return utilisation_of(simulation.scene(), shell.finest(), shell.model(last),
                        shell.state().levels.back(), shell.forces(last));
}

double utilisation_of(const Scene& scene, const RodMesh& mesh, const Model& model,
                      const State& state, const Assembly& forces) {
  record::Frame frame;
  put_rods(scene, mesh, model, state, forces, frame);
  return frame.utilisation;
}

record::Frame frame_of(const Scene& scene, const RodMesh& mesh, const Model& model,
                       const State& state, const Assembly& forces) {
  const Eigen::Matrix3Xd nodes = nodes_of(mesh, model, state.x);
  record::Frame frame;
  fill_shape(scene, mesh, nodes,
             cell_curvature(scene.footprint, joint_tangents(scene.footprint, mesh, nodes)), frame);
  frame.energies = forces.energies;
  put_contacts(record::ContactSearch(parts_of(scene, mesh)).in(frame.nodes), frame);
  put_rods(scene, mesh, model, state, forces, frame);
  put_reactions(reactions_of(mesh, model, forces, {}), frame);
  return frame;
}

record::Frame flat_frame(Simulation& simulation) {
  const Report flat = simulation.begin_flat();
  record::Frame frame;
  const Scene& scene = simulation.scene();
  fill_shape(scene, simulation.shell().finest(), simulation.nodes(),
             Eigen::VectorXd::Zero(Eigen::Index(scene.footprint.cells.size())), frame);
  frame.negative_pivots = flat.certificate.negative_pivots;
  frame.residual_N = flat.certificate.residual_N;
  frame.error_estimate_mm = 0;
  frame.boundary_radius_mm = scene.radius_begin_mm;
  put_contacts(simulation.contacts(), frame);
  put_forces(simulation, frame);
  // a state without energy is a minimum, whatever sign round-off gives the pivots of laths that can
  // rotate about their axes
  constexpr double nothing_mJ = 1e-15;
  if (std::abs(frame.energies.total()) < nothing_mJ) frame.negative_pivots = 0;
  return frame;
}

namespace {

/// The moments to show.
std::vector<const TimedState*> shown(const std::vector<TimedState>& all, double spacing) {
  std::size_t end = all.size();
  while (end > 1 &&
         max_column_norm(all[end - 1].state.x - all.back().state.x) < still_move * spacing)
    --end;
  std::vector<const TimedState*> few;
  const double until = all[end - 1].time;
  for (std::size_t k = 0; k < end; ++k)
    if (all[k].time >= until * double(few.size() + 1) / most_frames_in_motion)
      few.push_back(&all[k]);
  return few;
}

}  // namespace

std::vector<record::Frame> frames_in_motion(Simulation& simulation, double t,
                                            const std::vector<TimedState>& moments) {
  std::vector<record::Frame> frames;
  if (moments.empty()) return frames;
  const Scene& scene = simulation.scene();
  NestedShell& shell = simulation.shell();
  const RodMesh& mesh = shell.finest();
  Linearisation& system = shell.system();
  shell.motion().apply_loads(system, t);
  for (const TimedState* moment : shown(moments, scene.footprint.spacing)) {
    const Eigen::Matrix3Xd nodes = nodes_of(mesh, shell.model(), moment->state.x);
    record::Frame frame;
    fill_shape(scene, mesh, nodes,
               cell_curvature(scene.footprint, joint_tangents(scene.footprint, mesh, nodes)),
               frame);
    system.gradient_at(moment->state);
    frame.energies = system.assembly().energies;
    frame.residual_N = system.residual();
    frame.negative_pivots = -1;
    frame.time_s = moment->time;
    frame.event = "in motion";
    frames.push_back(std::move(frame));
  }
  shell.apply_loads();
  return frames;
}

}  // namespace gridshell::simulate
