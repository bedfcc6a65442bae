// What the light sees of a scene: the depth of the first solid, for shadows on the shell, and how
// much light is held back at which height above the ground, for the ground's soft shadow.
#pragma once

#include <Eigen/Core>

#include "engine/core/result.h"
#include "render/draw/scene.h"
#include "render/gl/program.h"
#include "render/gl/target.h"
#include "render/gl/vertex_store.h"

namespace gridshell::render {

class ShadowMap {
 public:
  static constexpr int texels = 1024;  ///< along a side
  static constexpr int levels = 7;     ///< of the cover, each half the size before

  static Result<ShadowMap> create(const Gl& gl);

  /// Draws the scene from the direction of the unit vector `light`. `ribbons` and `sheets` hold the
  /// scene's meshes, `ribbons` with its casters as list 1. A sheet holds back part of the light
  /// that its alpha would.
  Result<void> render(const Scene& scene, const VertexStore& ribbons, const VertexStore& sheets,
                      const Eigen::Vector3d& light, double ground_z);

  GLuint cover() const { return target_.colour(); }
  GLuint depth() const { return target_.depth(); }
  const Eigen::Matrix4f& matrix() const { return matrix_; }   ///< world to the map's [-1, 1]^3
  float texel_mm() const { return texel_mm_; }                ///< of the finest level
  float height_range_mm() const { return height_range_mm_; }  ///< ground to the shell's top

 private:
  ShadowMap(const Gl& gl, Program caster, Program halve);
  void fit(const Scene& scene, const Eigen::Vector3d& light, double ground_z);
  void draw_casters(const VertexStore& ribbons, const VertexStore& sheets) const;
  void blur();

  const Gl* gl_;
  Program caster_, halve_;
  Target target_;
  Framebuffer level_;
  VertexArray no_vertices_;
  Eigen::Matrix4f matrix_ = Eigen::Matrix4f::Identity();
  float texel_mm_ = 1, height_range_mm_ = 1;
};

}  // namespace gridshell::render
