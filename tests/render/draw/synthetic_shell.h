// A shell that needs no solver: a square grid clipped by a circle and lifted onto a dome.
#pragma once

#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "engine/record/snapshot.h"
#include "render/draw/drawing.h"

namespace gridshell::render::test {

/// A layout with positions for its nodes.
struct SyntheticShell {
  record::Layout layout;
  Eigen::Matrix3Xd nodes;
};

/// `rods` rods a direction, `edges` edges a segment, over a circle of `radius` mm; the dome is
/// `height` mm high and meets the plane z = 0 on the circle.
inline SyntheticShell synthetic_dome(int rods, int edges, double radius, double height) {
  SyntheticShell shell;
  const double spacing = 2 * radius / (rods + 0.6);
  const auto place = [&](int i) { return (i - 0.5 * (rods - 1)) * spacing; };
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](double x, double y) {
    const double part = std::min(1.0, (x * x + y * y) / (radius * radius));
    points.push_back({x, y, height * std::pow(1 - part, 0.75)});
    return int(points.size()) - 1;
  };
  auto& layout = shell.layout;
  layout.spacing_mm = spacing;
  layout.rod_diameter_mm = 0.254;
  layout.length_scale_mm = radius;
  std::map<std::pair<int, int>, int> joint_of;
  for (int i = 0; i < rods; ++i)
    for (int j = 0; j < rods; ++j) {
      if (std::hypot(place(i), place(j)) >= radius) continue;
      joint_of[{i, j}] = int(layout.joints.size());
      layout.joints.push_back({i, j, place(i), place(j), add(place(i), place(j))});
    }
  const auto piece = [&](std::vector<int>& rod, Eigen::Vector2d a, Eigen::Vector2d b) {
    for (int k = 1; k < edges; ++k) {
      const Eigen::Vector2d p = a + (b - a) * k / edges;
      rod.push_back(add(p.x(), p.y()));
    }
  };
  for (int direction = 0; direction < 2; ++direction)
    for (int i = 0; i < rods; ++i) {
      const double across = place(i), half = std::sqrt(radius * radius - across * across);
      const auto at = [&](double s) {
        return direction ? Eigen::Vector2d(across, s) : Eigen::Vector2d(s, across);
      };
      Eigen::Vector2d before = at(-half);
      std::vector<int> rod{add(before.x(), before.y())};
      layout.edge_points.push_back(rod.front());
      for (int j = 0; j < rods; ++j) {
        const auto found = joint_of.find(direction ? std::pair{i, j} : std::pair{j, i});
        if (found == joint_of.end()) continue;
        piece(rod, before, at(place(j)));
        rod.push_back(layout.joints[found->second].node);
        before = at(place(j));
      }
      piece(rod, before, at(half));
      rod.push_back(add(at(half).x(), at(half).y()));
      layout.edge_points.push_back(rod.back());
      layout.rods.push_back(rod);
    }
  for (const auto& [ij, joint] : joint_of) {
    const auto [i, j] = ij;
    if (!joint_of.count({i + 1, j}) || !joint_of.count({i + 1, j + 1}) ||
        !joint_of.count({i, j + 1}))
      continue;
    layout.cells.push_back({i, j, place(i) + 0.5 * spacing, place(j) + 0.5 * spacing,
                            {joint, joint_of[{i + 1, j}], joint_of[{i + 1, j + 1}],
                             joint_of[{i, j + 1}]}});
  }
  shell.nodes.resize(3, points.size());
  for (std::size_t k = 0; k < points.size(); ++k) shell.nodes.col(k) = points[k];
  return shell;
}

inline Eigen::Matrix3Xd circle(double radius, int points) {
  Eigen::Matrix3Xd result(3, points);
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * 3.14159265358979323846 * k / points;
    result.col(k) << radius * std::cos(angle), radius * std::sin(angle), 0;
  }
  return result;
}

/// The shell with its ring and, if asked, tinted cells (blue below, white, red above).
inline Drawing synthetic_drawing(const SyntheticShell& shell, bool cells) {
  Drawing drawing;
  drawing.layout = &shell.layout;
  drawing.nodes = shell.nodes;
  drawing.rings.push_back({circle(shell.layout.length_scale_mm, 180), 1.6, {0.85f, 0.45f, 0.1f}});
  drawing.ground_z_mm = -4;
  if (!cells) return drawing;
  const double top = shell.nodes.row(2).maxCoeff();
  for (const auto& cell : shell.layout.cells) {
    const float x = float(shell.nodes(2, shell.layout.joints[cell.joints[0]].node) / top);
    drawing.cell_colours.push_back(x < 0.5f ? Colour{0.3f + 1.2f * x, 0.5f + 0.8f * x, 0.85f, 0.8f}
                                            : Colour{0.85f, 1.3f - 0.8f * x, 1.4f - x, 0.8f});
  }
  return drawing;
}

}  // namespace gridshell::render::test
