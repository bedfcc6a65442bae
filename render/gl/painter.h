// A picture, tile by tile and pass by pass: the ground with the shell's shadow on it, and the
// shell.
#pragma once

#include <map>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/lighting.h"
#include "render/gl/scene.h"

namespace gridshell::render {

/// It fills the picture before what is on it is painted. The light on it is found once, in the
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

  /// The light alone is gathered over many passes, pixel by pixel, and the ground drawn once with
  /// it. Begins with that of all in the open.
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

/// Paints one tile of a picture. The ground is drawn first, then the shell over it from far to
/// near; of many passes the shell's mean over the ground in the mean of their light. With several
/// samples a pixel the shell's go into a layer of their own (premultiplied, linear light), whose
/// mean over each pixel is laid over the ground.
class Painter {
 public:
  /// `gl` outlives it.
  static Result<Painter> create(const Gl& gl);

  /// Makes ready for the shot: sends the scene's triangles over. Before its first tile.
  Result<void> begin(const RenderJob& shot);

  /// Fills the tile's part of `image`.
  Result<void> paint(const RenderJob& shot, const Tile& tile, Image& image);

 private:
  struct Programs {
    Program sheet, ribbon, bead;
  };
  Painter(const Gl& gl, Program mean, Ground ground, ShadowMap shadow);

  Result<Programs> create_programs(int taps) const;
  Result<void> prepare(const DrawQuality& quality);

  Result<void> cast(const RenderJob& shot, int pass);
  Result<void> paint_single_pass(const RenderJob& shot, const Tile& tile);
  Result<void> paint_multi_pass(const RenderJob& shot, const Tile& tile);
  Result<void> accumulate_shell(const RenderJob& shot, const Tile& part, const Lighting& light,
                                bool first);
  Result<void> paint_shell(const RenderJob& shot, const Tile& tile, const Lighting& light,
                           Target& to);
  static Eigen::Matrix4d matrix_of(const RenderJob& shot, const Tile& tile, const Lighting& light);
  void composite_shell(int per_side, const Tile& part, const Eigen::Vector2i& corner) const;
  void show(GLuint texture, float fraction, const Eigen::Vector2i& corner) const;
  void set_light(const Program& program, const RenderJob& shot, const Lighting& light) const;
  void set_shadow(const Program& program, const RenderJob& shot, const Lighting& light) const;
  void draw_meshes(const RenderJob& shot, const Lighting& light, const Eigen::Matrix4f& matrix);
  void screen_triangle() const;
  bool multi_pass() const { return passes_.size() > 1; }

  const Gl* gl_;
  Program mean_;
  std::map<int, Programs> programs_;  ///< by taps of the shadow that falls on the shell
  int taps_ = 0;                      ///< of the shot
  std::map<int, Program> average_;    ///< by samples along a pixel's side
  Ground ground_;
  ShadowMap shadow_;
  VertexStore sheets_, ribbons_, beads_;
  VertexArray no_vertices_;
  Target layer_, pass_, sum_, whole_, pixels_;
  std::vector<Lighting> passes_;
  int shadow_of_ = -1;  ///< the pass whose shadow the map contains
};

}  // namespace gridshell::render
