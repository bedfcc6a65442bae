// A made-up actuation for tests of pictures: the paper's circular footprint (R_o 126 mm, 12 + 12
// rods, d 20 mm) drawn in to 94.5 mm as a smooth dome with two dimples. Geometry alone: no
// equilibrium, no engine.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "engine/record/trajectory.h"

namespace gridshell::synthetic {

inline constexpr double original_radius = 126, actuated_radius = 94.5, spacing = 20;

/// Height (mm) over the flat position (u, v) when the radius has shrunk to `scale` of its first.
inline double height(double u, double v, double scale) {
  const double r2 = (u * u + v * v) / (original_radius * original_radius);
  // a parabola of height h over radius R is longer than 2R by 8/3 h²/(2R)
  const double h = original_radius * std::sqrt(1.5 * std::max(0.0, 1 - scale) * scale);
  const double dimple = 0.45 * (u - v) * (u - v) / (2 * original_radius * original_radius);
  return h * (1 - r2) * (1 - 1.6 * dimple);
}

/// Gauss curvature of a cell, integrated, by differences of the height over the drawn-in plane.
inline double cell_curvature(double u, double v, double scale) {
  const double e = 0.5, s = scale;
  const auto z = [&](double du, double dv) { return height(u + du, v + dv, s); };
  const double zx = (z(e, 0) - z(-e, 0)) / (2 * e * s), zy = (z(0, e) - z(0, -e)) / (2 * e * s);
  const double zxx = (z(e, 0) - 2 * z(0, 0) + z(-e, 0)) / (e * e * s * s);
  const double zyy = (z(0, e) - 2 * z(0, 0) + z(0, -e)) / (e * e * s * s);
  const double zxy = (z(e, e) - z(e, -e) - z(-e, e) + z(-e, -e)) / (4 * e * e * s * s);
  const double metric = 1 + zx * zx + zy * zy;
  return (zxx * zyy - zxy * zxy) / std::pow(metric, 1.5) * spacing * spacing * s * s;
}

/// The flat footprint's layout; `flat` receives the nodes' (u, v).
inline record::Layout make_layout(int edges_per_segment,
                                  std::vector<std::pair<double, double>>& flat) {
  record::Layout layout;
  layout.spacing_mm = spacing;
  layout.rod_diameter_mm = 0.254;
  layout.length_scale_mm = original_radius;
  std::map<std::pair<int, int>, int> joint_at;
  const auto add_node = [&](double u, double v) {
    flat.emplace_back(u, v);
    return int(flat.size()) - 1;
  };
  for (int i = -6; i < 6; ++i)
    for (int j = -6; j < 6; ++j) {
      const double u = (i + 0.5) * spacing, v = (j + 0.5) * spacing;
      if (std::hypot(u, v) >= original_radius) continue;
      joint_at[{i, j}] = int(layout.joints.size());
      layout.joints.push_back({i, j, u, v, add_node(u, v)});
    }
  // a rod: edge point, joints, edge point, with `edges_per_segment` edges between
  const auto add_rod = [&](bool along_u, int index) {
    const double across = (index + 0.5) * spacing;
    const double end = std::sqrt(original_radius * original_radius - across * across);
    std::vector<std::pair<double, int>> stops;
    const auto at = [&](double s) { return along_u ? add_node(s, across) : add_node(across, s); };
    stops.emplace_back(-end, at(-end));
    for (int k = -6; k < 6; ++k)
      if (const auto found = joint_at.find(along_u ? std::pair{k, index} : std::pair{index, k});
          found != joint_at.end())
        stops.emplace_back((k + 0.5) * spacing, layout.joints[found->second].node);
    stops.emplace_back(end, at(end));
    layout.edge_points.push_back(stops.front().second);
    layout.edge_points.push_back(stops.back().second);
    std::vector<int> rod{stops.front().second};
    for (std::size_t s = 1; s < stops.size(); ++s) {
      for (int k = 1; k < edges_per_segment; ++k)
        rod.push_back(
            at(stops[s - 1].first + (stops[s].first - stops[s - 1].first) * k / edges_per_segment));
      rod.push_back(stops[s].second);
    }
    layout.rods.push_back(rod);
  };
  for (bool along_u : {true, false})
    for (int index = -6; index < 6; ++index) add_rod(along_u, index);

  for (const auto& [key, corner] : joint_at) {
    const auto [i, j] = key;
    const auto b = joint_at.find({i + 1, j}), c = joint_at.find({i + 1, j + 1}),
               d = joint_at.find({i, j + 1});
    if (b == joint_at.end() || c == joint_at.end() || d == joint_at.end()) continue;
    layout.cells.push_back(
        {i, j, (i + 1) * spacing, (j + 1) * spacing, {corner, b->second, c->second, d->second}});
  }
  const int points = 240;
  layout.original_boundary.resize(3, points);
  for (int k = 0; k < points; ++k) {
    const double angle = 2 * std::numbers::pi * k / points;
    layout.original_boundary.col(k) =
        original_radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
  }
  layout.actuated_boundary = layout.original_boundary * (actuated_radius / original_radius);
  return layout;
}

/// The trajectory, `frames` evenly spaced states from flat to drawn in; frame 2/3 of the way names
/// an event.
inline record::Trajectory dome(int frames = 24, int edges_per_segment = 8) {
  record::Trajectory run;
  std::vector<std::pair<double, double>> flat;
  run.layout = make_layout(edges_per_segment, flat);
  for (int k = 0; k < frames; ++k) {
    const double t = frames > 1 ? double(k) / (frames - 1) : 1;
    record::Frame frame;
    frame.index = k;
    frame.progress = frame.actuation = t;
    frame.boundary_radius_mm = original_radius + t * (actuated_radius - original_radius);
    const double scale = frame.boundary_radius_mm / original_radius;
    frame.nodes.resize(3, long(flat.size()));
    for (std::size_t n = 0; n < flat.size(); ++n)
      frame.nodes.col(long(n)) << scale * flat[n].first, scale * flat[n].second,
          height(flat[n].first, flat[n].second, scale);
    for (const record::Joint& joint : run.layout.joints)
      frame.height_mm = std::max(frame.height_mm, frame.nodes(2, joint.node));
    frame.cell_K.resize(long(run.layout.cells.size()));
    for (std::size_t c = 0; c < run.layout.cells.size(); ++c)
      frame.cell_K[long(c)] =
          cell_curvature(run.layout.cells[c].u_mm, run.layout.cells[c].v_mm, scale);
    frame.total_K = frame.cell_K.sum();
    frame.energies[Term::bend] = 40 * t;
    frame.residual_N = 3.2e-9;
    if (frames > 2 && k == 2 * frames / 3) frame.event = "snap at a radius of 104.9 mm";
    run.frames.push_back(std::move(frame));
  }
  return run;
}

}  // namespace gridshell::synthetic
