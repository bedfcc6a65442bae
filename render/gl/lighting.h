// Light and shadows. The light is a key light (a small disc in the sky, to the left of the camera),
// a uniform sky and the light that the ground reflects. An unshadowed surface that faces up
// receives exactly 1, and so shows its own colour.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/opengl.h"
#include "render/gl/renderer.h"
#include "render/gl/scene.h"

namespace gridshell::render {

/// The light of one pass. Irradiance on a surface of normal n:
/// key max(n.l, 0) + sky (1 + n_z) / 2 + bounce (1 - n_z) / 2.
struct Lighting {
  Eigen::Vector3d direction;  ///< unit vector l towards the shadow-casting light
  double key = 0, sky = 0, bounce = 0;
  double spread = 0;  ///< width of a shadow's edge over the height of the part that casts it
  Eigen::Vector2d pixel_shift = Eigen::Vector2d::Zero();  ///< in samples, within +-1/2
};

/// The light of every pass. A single pass has a sky that casts no shadow. More passes sample the
/// key light's disc and the sky (uniform over the half sphere) by a fixed low-discrepancy sequence
/// [Roberts 2018], each pass with one direction that casts a shadow. Their mean tends to the same
/// light, but the sky casts shadows too.
std::vector<Lighting> lighting_passes(const Camera& camera, int passes);

/// A scene seen from the light: the depth of the first solid, for shadows on the shell, and the
/// fraction of light that is blocked (cover) with its height above the ground, for the soft shadow
/// on the ground.
class ShadowMap {
 public:
  static constexpr int levels = 7;  ///< of the cover, each half the size of the one before

  static Result<ShadowMap> create(const Gl& gl);

  /// Number of texels along a side for a picture of this height (pixels), equal for all frames of a
  /// movie.
  static int texels_for(int height) { return height > 800 ? 1024 : 512; }

  /// Draws the scene from the direction of the unit vector `light`. `ribbons` and `sheets` contain
  /// the scene's meshes, `ribbons` with its casters as list 1. A sheet blocks a fraction of the
  /// light in proportion to its alpha.
  Result<void> render(const Scene& scene, const VertexStore& ribbons, const VertexStore& sheets,
                      const Eigen::Vector3d& light, double ground_z, int texels);

  GLuint cover() const { return target_.colour(); }
  GLuint depth() const { return target_.depth(); }
  int texels() const { return texels_; }
  const Eigen::Matrix4f& matrix() const { return matrix_; }   ///< world to the map's [-1, 1]^3
  float texel_mm() const { return texel_mm_; }                ///< of the finest level
  float height_range_mm() const { return height_range_mm_; }  ///< ground to the shell's top

 private:
  ShadowMap(const Gl& gl, Program caster, Program halve);
  void fit(const Scene& scene, const Eigen::Vector3d& light, double ground_z);
  void draw_casters(const VertexStore& ribbons, const VertexStore& sheets) const;
  void blur();
  int texels_ = 1024;

  const Gl* gl_;
  Program caster_, halve_;
  Target target_;
  Framebuffer level_;
  VertexArray no_vertices_;
  Eigen::Matrix4f matrix_ = Eigen::Matrix4f::Identity();
  float texel_mm_ = 1, height_range_mm_ = 1;
};

}  // namespace gridshell::render
