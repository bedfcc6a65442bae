// Laths as boxes along their frames: the thickness along the shell's normal at the joints.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl/lighting.h"
#include "render/gl/mesh.h"
#include "render/gl/renderer.h"

namespace gridshell::render {

/// For every node the cross product of its rods' tangents: the shell's normal at a joint, next to
/// nothing elsewhere.
std::vector<Eigen::Vector3f> shell_normals(const Drawing& drawing);

/// Width and thickness of a rod, mm; 0 of one that is round or drawn as if it were.
Eigen::Vector2f lath_size(const Drawing& drawing, std::size_t rod);

/// Unit normals at the points of a rod, at right angles to it: those of its joints, and between
/// them in proportion. Of a rod without joints: as near to z as may be.
std::vector<Eigen::Vector3f> lath_normals(const Drawing& drawing, std::size_t rod,
                                          const std::vector<Eigen::Vector3f>& shell_normals);

/// How wide a box appears from `sight` (a unit vector) across its tangent, mm.
float apparent_width(const Eigen::Vector2f& size, const Eigen::Vector3f& tangent,
                     const Eigen::Vector3f& normal, const Eigen::Vector3f& sight);

/// A piece of a lath, from joint to joint.
struct LathPiece {
  std::span<const Eigen::Vector3f> points, normals;
  std::span<const Eigen::Vector4f> colours;  ///< linear, one a point
  Eigen::Vector2f size;                      ///< width and thickness, mm
};

/// What its faces are seen by: the eye, and the light; without a light they have their own colours.
struct LathView {
  Eigen::Vector3f eye;  ///< the camera, or the direction towards it
  bool orthographic = false;
  const Lighting* light = nullptr;
};

/// Adds the faces that are turned to the eye, those at both ends too, and returns their triangles.
std::vector<std::uint32_t> add_lath(Mesh& mesh, const LathPiece& piece, const LathView& view);

}  // namespace gridshell::render
