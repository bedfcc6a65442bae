// Painting of a picture, tile by tile and pass by pass: the ground with the shell's shadow, then
// the shell.
#pragma once

#include <map>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/lighting.h"
#include "render/gl/scene.h"

namespace gridshell::render {

/// The ground, which fills the picture before the shell is painted. The light on the part of it
/// that the shadow map contains is computed once, in the map's plane; elsewhere it is that in the
/// open.
class Ground {
 public:
  /// `gl` outlives it.
  static Result<Ground> create(const Gl& gl);

  /// Whether the picture shows the ground: the drawing has one and the camera is above it.
  static bool seen(const RenderJob& shot);

  /// Fills the bound target. `matrix` maps the world to the target's clip coordinates. `shadow`,
  /// for which soften() was called, may be null.
  void draw(const RenderJob& shot, const Eigen::Matrix4d& matrix, const Lighting& light,
            const ShadowMap* shadow) const;

  // With many passes the mean light at every pixel is computed first, and the ground drawn once:
  // begin_ground_light(), gather() for each pass, draw_ground_light().

  /// Sets the light at every pixel to the mean of all passes in the open.
  Result<void> begin_ground_light(const Tile& tile, const std::vector<Lighting>& passes);
  /// Subtracts the light that the shadow of one of `passes` passes removes; soften() was called.
  Result<void> gather(const RenderJob& shot, const Tile& tile, const Eigen::Matrix4d& matrix,
                      const Lighting& light, const ShadowMap& shadow, int passes);
  /// Fills the bound target with the ground in the light of all passes.
  void draw_ground_light(const RenderJob& shot, const Eigen::Matrix4d& matrix) const;

  /// Computes the light on the ground under `shadow`, before draw() or gather(). `many`: the light
  /// is one of many passes, whose directions include the sky's, so that no shadow of the sky is
  /// added.
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
  Target light_;     ///< light on the ground over that in the open, in the plane of the shadow map
  Target gathered_;  ///< mean light of many passes at every pixel
  VertexArray no_vertices_;
};

/// Paints a picture tile by tile. The ground is drawn first, then the shell over it from far to
/// near; with many passes, the mean of the shell over the ground in the mean light. With several
/// samples per pixel the shell is drawn into a layer of its own (premultiplied, linear light),
/// whose mean over each pixel is composited over the ground.
class Painter {
 public:
  /// `gl` outlives it.
  static Result<Painter> create(const Gl& gl);

  /// Copies the scene's triangles to the graphics processor; to be called before the first tile.
  Result<void> begin(const RenderJob& shot);

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
  std::map<int, Programs> programs_;  ///< by the taps of the shadow on the shell (shadow.glsl)
  int taps_ = 0;                      ///< of the current picture
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
