// The ground of a picture, with the shell's shadow on it.
#pragma once

#include "engine/core/result.h"
#include "render/draw/lighting.h"
#include "render/draw/shadow_map.h"
#include "render/draw/shot.h"

namespace gridshell::render {

/// It fills the picture before what stands on it is painted. The light on it is found once, in the
/// shadow map's own plane, and looked up where the map reaches; elsewhere it is that of the open.
class Ground {
 public:
  /// `gl` outlives it.
  static Result<Ground> create(const Gl& gl);

  /// The ground hides nothing when it is seen from below, or where the drawing has none.
  static bool seen(const Shot& shot);

  /// Fills the bound target. `matrix` takes the world to its clip coordinates; `shadow`, softened
  /// before, may be null.
  void draw(const Shot& shot, const Eigen::Matrix4d& matrix, const Lighting& light,
            const ShadowMap* shadow) const;

  /// Finds the light on the ground under `shadow`, before it is drawn with it. `many`: the light is
  /// one of many whose mean is shown, and so the sky's shadow is among them.
  Result<void> soften(const Shot& shot, const ShadowMap& shadow, const Lighting& light, bool many);

 private:
  struct Programs {
    Program open, cast, soften;
  };
  Ground(const Gl& gl, Programs programs);
  void draw_shadow(const Shot& shot, const Eigen::Matrix4d& matrix, const Lighting& light,
                   const ShadowMap& shadow) const;

  const Gl* gl_;
  Programs programs_;
  Target light_;  ///< on the ground, over that in the open
  VertexArray no_vertices_;
};

}  // namespace gridshell::render
