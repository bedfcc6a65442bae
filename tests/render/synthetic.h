// A made-up actuation for tests of pictures: the paper's circular footprint (R_o 126 mm, 12 + 12
// rods, d 20 mm) contracted to 94.5 mm as a smooth dome with two dimples. It is geometry alone, not
// an equilibrium.
#pragma once

#include <algorithm>
#include <cmath>

#include "engine/record/trajectory.h"
#include "engine/simulate/frames.h"

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

/// Gauss curvature of a cell, integrated, by differences of the height over the contracted plane.
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

/// The trajectory, `frames` evenly spaced states from flat to contracted; the frame at two thirds
/// of them names an event.
inline record::Trajectory dome(int frames = 24, int edges_per_segment = 8) {
  record::Trajectory run;
  // the layout of the default preset, without sizes of joints, families and supports
  const Scene scene = scene_of(preset::Preset{}).value();
  const RodMesh mesh = mesh_rods(scene.footprint, edges_per_segment);
  run.layout = simulate::layout_of(scene, mesh).value();
  run.layout.joint_diameter_mm = run.layout.joint_height_mm = 0;
  run.layout.families.clear(), run.layout.supports.clear();
  const Eigen::Matrix2Xd& flat = mesh.flat;
  for (int k = 0; k < frames; ++k) {
    const double t = frames > 1 ? double(k) / (frames - 1) : 1;
    record::Frame frame;
    frame.index = k;
    frame.progress = frame.actuation = t;
    frame.boundary_radius_mm = original_radius + t * (actuated_radius - original_radius);
    const double scale = frame.boundary_radius_mm / original_radius;
    frame.nodes.resize(3, flat.cols());
    for (long n = 0; n < flat.cols(); ++n)
      frame.nodes.col(n) << scale * flat.col(n), height(flat(0, n), flat(1, n), scale);
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
