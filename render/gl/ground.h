// The ground of a picture, with the shell's shadow on it.
#pragma once

#include <vector>

#include "engine/core/result.h"
#include "render/gl/lighting.h"
#include "render/gl/scene.h"

namespace gridshell::render {

/// It fills the picture before what stands on it is painted. The light on it is found once, in the
/// shadow map's own plane, and looked up where the map reaches; elsewhere it is that of the open.
class Ground {
 public:
  /// `gl` outlives it.
  static Result<Ground> create(const Gl& gl);

  /// The ground hides nothing when it is seen from below, or where the drawing has none.
  static bool seen(const RenderJob& shot);

  /// Fills the bound target. `matrix` takes the world to its clip coordinates; `shadow`, softened
  /// before, may be null.
  void draw(const RenderJob& shot, const Eigen::Matrix4d& matrix, const Lighting& light,
            const ShadowMap* shadow) const;

  /// Of many passes the light alone is gathered, pixel by pixel, and the ground drawn once with it.
  /// Begins with that of all in the open.
  Result<void> begin_ground_light(const Tile& tile, const std::vector<Lighting>& passes);
  /// Takes away what a pass's shadow does, softened before.
  Result<void> gather(const RenderJob& shot, const Tile& tile, const Eigen::Matrix4d& matrix,
                      const Lighting& light, const ShadowMap& shadow, int passes);
  /// Fills the bound target.
  void draw_ground_light(const RenderJob& shot, const Eigen::Matrix4d& matrix) const;

  /// Finds the light on the ground under `shadow`, before it is drawn with it. `many`: the light is
  /// one of many whose mean is shown, and so the sky's shadow is among them.
  Result<void> soften(const RenderJob& shot, const ShadowMap& shadow, const Lighting& light,
                      bool many);

 private:
  struct Programs {
    Program open, cast, soften, dim, gathered;
  };
  Ground(const Gl& gl, Programs programs);
  void draw_open(const Program& program, const RenderJob& shot, const Eigen::Matrix4d& matrix,
                 const Lighting& light) const;
  void set_shadow_uniforms(const Program& program, const RenderJob& shot,
                           const Eigen::Matrix4d& matrix, const ShadowMap& shadow) const;
  void draw_shadow(const RenderJob& shot, const Eigen::Matrix4d& matrix, const Lighting& light,
                   const ShadowMap& shadow) const;

  const Gl* gl_;
  Programs programs_;
  Target light_;     ///< on the ground, over that in the open
  Target gathered_;  ///< that of many passes, in pixels
  VertexArray no_vertices_;
};

}  // namespace gridshell::render
