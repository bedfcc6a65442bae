// Laths as boxes along their rods, with the thickness along the shell's normal at the joints.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl/lighting.h"
#include "render/gl/mesh.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

/// Draws rods as laths with these widths and thicknesses (Drawing::laths_mm), in the colour of
/// wood, and joints, if they are drawn, as bolts, which are narrower. Without laths it changes
/// nothing.
void put_laths(std::vector<double> laths_mm, Drawing& drawing);

/// For every node the cross product of the unit tangents of its rods: along the shell's normal at a
/// joint, near zero at nodes of one rod.
std::vector<Eigen::Vector3f> shell_normals(const Drawing& drawing);

/// Width and thickness of a rod, mm; zero for a rod that is drawn round.
Eigen::Vector2f lath_size(const Drawing& drawing, std::size_t rod);

/// Unit normals at the points of a rod, at right angles to it: the shell's normals at its joints,
/// interpolated linearly between them; those nearest to z for a rod without joints.
std::vector<Eigen::Vector3f> lath_normals(const Drawing& drawing, std::size_t rod,
                                          const std::vector<Eigen::Vector3f>& shell_normals);

/// Width (mm) that a box of width and thickness `size` appears to have across its tangent, seen
/// from the direction `sight` (a unit vector).
float apparent_width(const Eigen::Vector2f& size, const Eigen::Vector3f& tangent,
                     const Eigen::Vector3f& normal, const Eigen::Vector3f& sight);

/// A piece of a lath, from joint to joint.
struct LathPiece {
  std::span<const Eigen::Vector3f> points, normals;
  std::span<const Eigen::Vector4f> colours;  ///< linear, one per point
  Eigen::Vector2f size;                      ///< width and thickness, mm
};

/// Eye and light by which the faces of laths are drawn.
struct LathView {
  Eigen::Vector3f eye;  ///< the camera, or the direction towards it
  bool orthographic = false;
  const Lighting* light = nullptr;  ///< null: faces have their own colours
};

/// Adds the faces that are turned to the eye, including those at the ends, and returns their
/// triangles.
std::vector<std::uint32_t> add_lath(Mesh& mesh, const LathPiece& piece, const LathView& view);

}  // namespace gridshell::render
