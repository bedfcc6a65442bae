#include "render/draw/scene.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <vector>

#include "render/draw/camera.h"
#include "render/draw/colour.h"
#include "render/draw/skin.h"

namespace gridshell::render {
namespace {

using Points = std::vector<Eigen::Vector3f>;
using Colours = std::vector<Eigen::Vector4f>;

/// Rods, rings and joints are never translucent.
Eigen::Vector4f opaque(const Colour& c) { return to_linear({c.r, c.g, c.b, 1}); }

int sides_for(double diameter_in_samples) {
  if (diameter_in_samples < 4) return 6;
  if (diameter_in_samples < 16) return 8;
  return diameter_in_samples < 48 ? 12 : 24;
}

/// The first mismatch that would make drawing read past an array or draw NaN; empty when sound.
std::string mismatch(const Drawing& drawing) {
  if (!drawing.layout) return "has no layout";
  const auto nodes = std::size_t(drawing.nodes.cols());
  const auto& layout = *drawing.layout;
  if (!drawing.nodes.allFinite()) return "has a node that is not finite";
  if (!drawing.node_colours.empty() && drawing.node_colours.size() != nodes)
    return fmt::format("has {} node colours for {} nodes", drawing.node_colours.size(), nodes);
  if (!drawing.cell_colours.empty() && drawing.cell_colours.size() != layout.cells.size())
    return fmt::format("has {} cell colours for {} cells", drawing.cell_colours.size(),
                       layout.cells.size());
  const auto outside = [](const std::vector<std::vector<int>>& rods, std::size_t count) {
    for (const auto& rod : rods)
      for (int node : rod)
        if (node < 0 || std::size_t(node) >= count) return true;
    return false;
  };
  if (outside(layout.rods, nodes)) return fmt::format("has a rod beyond its {} nodes", nodes);
  for (const auto& joint : layout.joints)
    if (joint.node < 0 || std::size_t(joint.node) >= nodes)
      return fmt::format("has joint ({}, {}) beyond its {} nodes", joint.i, joint.j, nodes);
  for (const auto& ghost : drawing.ghosts)
    if (!ghost.nodes.allFinite() || outside(ghost.rods, std::size_t(ghost.nodes.cols())))
      return "has ghost rods with a node that is missing or not finite";
  for (const auto& ring : drawing.rings)
    if (!ring.points.allFinite()) return "has a ring with a point that is not finite";
  return {};
}

/// Tubes of a given diameter, drawn no thinner than a sample.
class TubeMaker {
 public:
  TubeMaker(double diameter_mm, double mm_per_sample)
      : radius_(float(0.5 * std::max(diameter_mm, 1.1 * mm_per_sample))),
        sides_(sides_for(2 * radius_ / mm_per_sample)) {}

  void add(Mesh& mesh, const Points& points, const Colours& colours, bool closed) const {
    add_tube(mesh, {points, colours, radius_, sides_, closed});
  }

 private:
  float radius_;
  int sides_;
};

void add_rods(Mesh& mesh, const Drawing& drawing, double mm_per_sample) {
  const TubeMaker tube(drawing.rod_diameter_mm, mm_per_sample);
  Colours of_node(drawing.node_colours.size());
  std::transform(drawing.node_colours.begin(), drawing.node_colours.end(), of_node.begin(), opaque);
  const Eigen::Vector4f plain = opaque(drawing.rod_colour);
  Points points;
  Colours colours;
  for (const auto& rod : drawing.layout->rods) {
    points.clear();
    colours.clear();
    for (int node : rod) {
      points.push_back(drawing.nodes.col(node).cast<float>());
      colours.push_back(of_node.empty() ? plain : of_node[node]);
    }
    tube.add(mesh, points, colours, false);
  }
}

void add_rings(Mesh& mesh, const Drawing& drawing, double mm_per_sample) {
  for (const Ring& ring : drawing.rings) {
    Points points(ring.points.cols());
    for (int k = 0; k < int(points.size()); ++k) points[k] = ring.points.col(k).cast<float>();
    // a last point that repeats the first would be an edge without length
    while (points.size() > 1 && (points.back() - points.front()).norm() < 1e-6f) points.pop_back();
    const Colours colours(points.size(), opaque(ring.colour));
    TubeMaker(ring.diameter_mm, mm_per_sample).add(mesh, points, colours, true);
  }
}

void add_ghosts(Mesh& mesh, const Drawing& drawing, double mm_per_sample) {
  for (const GhostRods& ghost : drawing.ghosts) {
    const TubeMaker tube(ghost.diameter_mm, mm_per_sample);
    for (const auto& rod : ghost.rods) {
      Points points;
      for (int node : rod) points.push_back(ghost.nodes.col(node).cast<float>());
      tube.add(mesh, points, Colours(points.size(), to_linear(ghost.colour)), false);
    }
  }
}

/// For every node the cross product of its rods' tangents: the shell's normal at a joint.
std::vector<Eigen::Vector3f> shell_normals(const Drawing& drawing) {
  const auto count = std::size_t(drawing.nodes.cols());
  std::vector<Eigen::Vector3f> tangent(count, Eigen::Vector3f::Zero()), normal = tangent;
  for (const auto& rod : drawing.layout->rods)
    for (std::size_t k = 0; k < rod.size(); ++k) {
      const int before = rod[k ? k - 1 : 0], after = rod[std::min(k + 1, rod.size() - 1)];
      const Eigen::Vector3f t =
          (drawing.nodes.col(after) - drawing.nodes.col(before)).cast<float>().stableNormalized();
      normal[rod[k]] = tangent[rod[k]].cross(t);
      tangent[rod[k]] = t;
    }
  return normal;
}

void add_joints(Mesh& mesh, const Drawing& drawing, double mm_per_sample) {
  if (drawing.joint_diameter_mm <= 0) return;
  const auto normals = shell_normals(drawing);
  const auto radius = float(0.5 * std::max(drawing.joint_diameter_mm, 1.1 * mm_per_sample));
  const float half_height = std::max(0.6f * radius, float(0.8 * drawing.rod_diameter_mm));
  const int sides = std::clamp(2 * sides_for(2 * radius / mm_per_sample), 12, 32);
  const Eigen::Vector4f colour = opaque(drawing.joint_colour);
  for (const auto& joint : drawing.layout->joints) {
    const float length = normals[joint.node].norm();
    const Eigen::Vector3f axis =
        length > 1e-6f ? Eigen::Vector3f(normals[joint.node] / length) : Eigen::Vector3f::UnitZ();
    add_button(mesh, drawing.nodes.col(joint.node).cast<float>(), axis, radius, half_height, sides,
               colour);
  }
}

void enclose(Scene& scene) {
  Eigen::AlignedBox3f box;
  for (const Mesh* mesh : {&scene.solids, &scene.ghosts, &scene.cells})
    for (const Vertex& v : mesh->vertices) box.extend(v.position);
  if (box.isEmpty()) box.extend(Eigen::Vector3f::Zero());
  scene.low = box.min().cast<double>() - Eigen::Vector3d::Constant(1e-3);
  scene.high = box.max().cast<double>() + Eigen::Vector3d::Constant(1e-3);
}

}  // namespace

Result<Scene> make_scene(const Drawing& drawing, const Camera& camera, double mm_per_sample) {
  if (const std::string fault = mismatch(drawing); !fault.empty())
    return fail(Fault::bad_input, "the drawing " + fault);
  Scene scene;
  add_rods(scene.solids, drawing, mm_per_sample);
  add_rings(scene.solids, drawing, mm_per_sample);
  add_joints(scene.solids, drawing, mm_per_sample);
  add_ghosts(scene.ghosts, drawing, mm_per_sample);
  if (!drawing.cell_colours.empty()) {
    Colours colours(drawing.cell_colours.size());
    std::transform(drawing.cell_colours.begin(), drawing.cell_colours.end(), colours.begin(),
                   [](const Colour& c) { return to_linear(c); });
    add_cells(scene.cells, *drawing.layout, drawing.nodes, colours, camera_axes(camera).forward);
  }
  enclose(scene);
  return scene;
}

}  // namespace gridshell::render
