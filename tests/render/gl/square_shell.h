// A square net over a dome, for benches and for pictures whose size in rods is given: n + n
// rods on a square grid, n^2 joints, (n-1)^2 cells, 2 n (n-1) k rod segments of one edge. Geometry
// alone.
#pragma once

#include <cmath>
#include <vector>

#include "engine/record/trajectory.h"
#include "render/gl/renderer.h"

namespace gridshell::render::test {

struct SquareShell {
  record::Layout layout;
  Eigen::Matrix3Xd nodes;
};

/// `rods` rods per direction, `edges` edges between two joints, on a square of `half` mm half side.
inline SquareShell square_shell(int rods, int edges, double half = 100) {
  SquareShell shell;
  auto& layout = shell.layout;
  const double spacing = 2 * half / (rods - 1);
  std::vector<Eigen::Vector3d> points;
  const auto add = [&](double x, double y) {
    const double bow = std::cos(1.5 * x / half) * std::cos(1.5 * y / half);
    points.push_back({x, y, 0.6 * half * bow});
    return int(points.size()) - 1;
  };
  layout.spacing_mm = spacing;
  layout.rod_diameter_mm = 0.254;
  layout.length_scale_mm = half;
  for (int j = 0; j < rods; ++j)
    for (int i = 0; i < rods; ++i) {
      const double x = i * spacing - half, y = j * spacing - half;
      layout.joints.push_back({i, j, x, y, add(x, y)});
    }
  for (bool along_x : {true, false})
    for (int r = 0; r < rods; ++r) {
      const double across = r * spacing - half;
      std::vector<int> rod;
      for (int k = 0; k < rods; ++k) {
        rod.push_back(along_x ? r * rods + k : k * rods + r);
        for (int e = 1; e < edges && k + 1 < rods; ++e) {
          const double s = (k + double(e) / edges) * spacing - half;
          rod.push_back(along_x ? add(s, across) : add(across, s));
        }
      }
      layout.edge_points.insert(layout.edge_points.end(), {rod.front(), rod.back()});
      layout.rods.push_back(rod);
    }
  for (int j = 0; j + 1 < rods; ++j)
    for (int i = 0; i + 1 < rods; ++i) {
      const int a = j * rods + i;
      layout.cells.push_back({i,
                              j,
                              (i + 0.5) * spacing - half,
                              (j + 0.5) * spacing - half,
                              {a, a + 1, a + rods + 1, a + rods}});
    }
  shell.nodes.resize(3, long(points.size()));
  for (std::size_t k = 0; k < points.size(); ++k) shell.nodes.col(long(k)) = points[k];
  return shell;
}

/// The shell with its cells from blue (low) to red (high).
inline Drawing square_drawing(const SquareShell& shell) {
  Drawing drawing;
  drawing.layout = &shell.layout;
  drawing.nodes = shell.nodes;
  drawing.ground_z_mm = shell.nodes.row(2).minCoeff() - 3;
  const double top = shell.nodes.row(2).maxCoeff();
  for (const auto& cell : shell.layout.cells) {
    const double z = shell.nodes(2, shell.layout.joints[cell.joints[0]].node) / top;
    const auto x = float(z < 0 ? 0 : z);
    drawing.cell_colours.push_back({0.25f + 0.6f * x, 0.45f, 0.85f - 0.6f * x, 0.75f});
  }
  return drawing;
}

}  // namespace gridshell::render::test
