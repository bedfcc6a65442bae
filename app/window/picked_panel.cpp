// The values of what was clicked: a joint, a point of a rod, a cell.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/window/panel.h"
#include "engine/gridshell.h"
#include "render/movie/run_summary.h"

namespace gridshell::window {
namespace {

/// "u-rod 3", with the index that its joints have in common; "Rod 12" in a network, whose joints
/// have a single index.
std::string rod_name(const record::Layout& layout, int rod) {
  if (std::ranges::all_of(layout.joints, [](const record::Joint& joint) { return joint.j == 0; }))
    return fmt::format("Rod {}", rod);
  const std::string family =
      layout.families.empty() ? std::string() : layout.families[std::size_t(rod)];
  for (const int node : layout.rods[std::size_t(rod)]) {
    if (node >= int(layout.joints.size())) continue;
    const record::Joint& joint = layout.joints[std::size_t(node)];
    if (family == "u") return fmt::format("u-rod {}", joint.j);
    if (family == "v") return fmt::format("v-rod {}", joint.i);
  }
  return fmt::format("Rod {}", rod);
}

/// The value of a quantity at a node; unknown if the state does not have it.
double value_at(const ShellView& shell, ColourBy by, int node) {
  const Eigen::VectorXd all =
      render::coloured_values(by, *shell.layout, shell.frame, {*shell.first});
  return node < all.size() ? all[node] : record::unknown;
}

void write_lines(const std::vector<std::string>& lines) {
  for (const std::string& line : lines) ImGui::TextUnformatted(line.c_str());
}

void picked_rod(const Panel& panel, const PointOnRod& at) {
  const ShellView& shell = *panel.viewer.shell;
  const record::Layout& layout = *shell.layout;
  const std::vector<int>& nodes = layout.rods[std::size_t(at.rod)];
  const std::size_t k = std::min(std::size_t(at.point), nodes.size() - 1);
  double along = 0, length = 0;
  for (std::size_t n = 1; n < nodes.size(); ++n) {
    length += (shell.frame.nodes.col(nodes[n]) - shell.frame.nodes.col(nodes[n - 1])).norm();
    if (n == k) along = length;
  }
  heading(panel, rod_name(layout, at.rod).c_str());
  ImGui::Text("%.1f of %.1f mm along it", along, length);
  const auto force = record::axial_force_N(layout, shell.frame, std::size_t(at.rod));
  const double curvature = record::curvature_per_mm(layout, shell.frame, std::size_t(at.rod))[k];
  write_lines(known_values(shell, nodes[k], force[k], curvature));
}

/// A slider for the depth to which the joint is pushed inwards.
void push_depth(const Panel& panel, int joint) {
  ViewerState& viewer = panel.viewer;
  const ShellView& shell = *viewer.shell;
  Eigen::Vector3d along = shell.normals.col(joint), from = shell.frame.nodes.col(joint);
  for (const ConstrainedJoint& one : shell.constrained)
    if (one.joint == joint && !one.along.isZero(0)) along = one.along, from -= one.moved_mm;
  float depth = -float((shell.frame.nodes.col(joint) - from).dot(along));
  if (std::abs(depth) < 5e-4f) depth = 0;
  const float most = float(0.5 * shell.layout->length_scale_mm);
  slider(panel, "push_depth", depth, -most, most, "%.2f mm",
         "pushed in: along its normal to this depth, inwards above 0", [&](float to) {
           viewer.post(Push{joint, from - four_digits(to) * along, along}, true);
         });
}

}  // namespace

std::vector<std::string> known_values(const ShellView& shell, int node, double axial_force_N,
                                      double curvature_per_mm) {
  const double bending = value_at(shell, ColourBy::energy, node),
               stress = value_at(shell, ColourBy::stress, node),
               used = value_at(shell, ColourBy::utilisation, node);
  std::vector<std::string> lines;
  const auto add = [&](double value, std::string line) {
    if (std::isfinite(value)) lines.push_back(std::move(line));
  };
  add(axial_force_N, fmt::format("axial force {:.3g} N", axial_force_N));
  add(curvature_per_mm, fmt::format("curvature {:#.3g} 1/mm", curvature_per_mm));
  add(bending, fmt::format("bending {:.3g} mJ/m", bending));
  add(stress, fmt::format("stress {:.3g} MPa", stress));
  if (std::isfinite(stress) && std::isfinite(used))
    lines.back() += fmt::format(", {:.2g} of the strength", used);
  return lines;
}

void picked_figures(const Panel& panel) {
  const ViewerState& viewer = panel.viewer;
  const ShellView& shell = *viewer.shell;
  const record::Layout& layout = *shell.layout;
  if (viewer.picked_joint >= 0 && viewer.picked_joint < int(layout.joints.size())) {
    const record::Joint& joint = layout.joints[std::size_t(viewer.picked_joint)];
    // prevents -0.00
    const Eigen::Vector3d at = shell.frame.nodes.col(viewer.picked_joint).unaryExpr([](double x) {
      return std::abs(x) < 5e-3 ? 0.0 : x;
    });
    heading(panel, fmt::format("Joint ({}, {})", joint.i, joint.j).c_str());
    push_depth(panel, viewer.picked_joint);
    ImGui::Text("x %.2f  y %.2f  z %.2f mm", at.x(), at.y(), at.z());
    const double force = value_at(shell, ColourBy::axial_force, viewer.picked_joint);
    write_lines(known_values(shell, viewer.picked_joint, force));
  }
  if (viewer.picked_rod.rod >= 0 && viewer.picked_rod.rod < int(layout.rods.size()))
    picked_rod(panel, viewer.picked_rod);
  if (viewer.picked_cell >= 0 && viewer.picked_cell < int(layout.cells.size())) {
    const record::Cell& cell = layout.cells[std::size_t(viewer.picked_cell)];
    heading(panel, fmt::format("Cell ({}, {})", cell.i, cell.j).c_str());
    ImGui::Text("K□ = %.4f rad", shell.frame.cell_K[viewer.picked_cell]);
    if (shell.deviation.size() > 0)
      ImGui::Text("Δ/ρ = %.2f %%", 100 * shell.deviation[viewer.picked_cell]);
  }
}

}  // namespace gridshell::window
