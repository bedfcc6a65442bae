// Paints one tile of a picture, pass by pass.
#pragma once

#include <map>

#include "engine/core/result.h"
#include "render/draw/lighting.h"
#include "render/draw/scene.h"
#include "render/draw/shadow_map.h"
#include "render/draw/tiles.h"

namespace gridshell::render {

/// Everything that one picture is made from.
struct Shot {
  const Scene& scene;
  const Drawing& drawing;
  const Camera& camera;
  const DrawQuality& quality;
  int width, height;
};

/// Samples of the shell go into a layer of their own (premultiplied, linear light), which is then
/// averaged over each pixel and laid over the ground; the ground is computed once a pixel.
class Painter {
 public:
  /// `gl` outlives it.
  static Result<Painter> create(const Gl& gl);

  /// Makes ready for the shot: sends the scene's triangles over. Before its first tile.
  Result<void> begin(const Shot& shot);

  /// Fills the tile's part of `image`.
  Result<void> paint(const Shot& shot, const Tile& tile, Image& image);

 private:
  struct Programs {
    Program sheet, ribbon, bead, mean;
  };
  Painter(const Gl& gl, Programs programs, ShadowMap shadow);

  Result<void> paint_layer(const Shot& shot, const Tile& tile, const Lighting& light);
  void set_light(const Program& program, const Shot& shot, const Lighting& light) const;
  void draw_meshes(const Shot& shot, const Lighting& light, const Eigen::Matrix4f& matrix);
  void resolve(const Shot& shot, const Tile& tile, const Lighting& light);
  void screen_triangle() const;
  Eigen::Matrix4d matrix(const Shot& shot, const Tile& tile, const Lighting& light) const;

  const Gl* gl_;
  Programs programs_;
  std::map<int, Program> resolve_;  ///< by samples along a pixel's side
  ShadowMap shadow_;
  VertexStore sheets_, ribbons_, beads_;
  VertexArray no_vertices_;
  Target layer_, sum_, pixels_;
  std::vector<Lighting> passes_;
  int shadow_of_ = -1;  ///< the pass whose shadow the map holds
};

}  // namespace gridshell::render
