#include "render/gl/painter.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <utility>

#include "render/gl/image.h"
#include "render/gl/renderer.h"

#include "engine/core/try.h"

namespace gridshell::render {
namespace {

// distances from the middle at which the ground begins and ends to fade, in half extents of the
// view
constexpr double ground_from = 1.2, ground_to = 4;
constexpr double penumbra_least = 0.8;  // width of a shadow's edge where rod and ground touch, mm
constexpr float roof = 0.35f;           // fraction of the sky's light that a closed roof blocks

/// Matrix (upper left 3 x 3) from clip coordinates (x, y, 1) to the point (X, Y, 1) of the plane z,
/// divided by its depth w.
Eigen::Matrix4f to_ground(const Eigen::Matrix4d& matrix, double z) {
  Eigen::Matrix3d plane;
  for (int k = 0; k < 3; ++k) {
    const int row = k < 2 ? k : 3;
    plane.row(k) << matrix(row, 0), matrix(row, 1), matrix(row, 2) * z + matrix(row, 3);
  }
  Eigen::Matrix4f result = Eigen::Matrix4f::Identity();
  result.topLeftCorner<3, 3>() = plane.inverse().cast<float>();
  return result;
}

/// Matrix from (u, v, 1, 0), with coordinates u and v on the shadow map from 0 to 1, to the points
/// of the plane z that the light reaches through them.
Eigen::Matrix4f on_ground(const Eigen::Matrix4f& light_matrix, double z) {
  const Eigen::Matrix4d m = light_matrix.cast<double>();
  const Eigen::Matrix2d back = m.topLeftCorner<2, 2>().inverse();
  const Eigen::Vector2d origin = m.block<2, 1>(0, 2) * z + m.block<2, 1>(0, 3);
  Eigen::Matrix4f result = Eigen::Matrix4f::Identity();
  result.topLeftCorner<2, 2>() = (2 * back).cast<float>();
  result.block<2, 1>(0, 2) = (-back * (origin + Eigen::Vector2d::Ones())).cast<float>();
  return result;
}

/// Number of texels along a side of the map of light: finer than the narrowest penumbra and than
/// the pixels, and equal in all frames of a movie.
int light_texels(int height) { return std::clamp(64 * int(std::lround(height / 90.0)), 512, 1024); }

/// Disables blending, depth test and culling, so that every pixel is overwritten.
void fill_only(const Gl& gl) {
  for (const GLenum state : {GL_BLEND, GL_DEPTH_TEST, GL_CULL_FACE}) gl.Disable(state);
}

/// The light on level ground in the open.
float open_light(const Lighting& light) {
  return float(light.key * light.direction.z() + light.sky);
}

void set_look(const Program& program, const RenderJob& shot, const Lighting& light) {
  const double extent = shot.camera.half_extent_mm;
  const Eigen::Vector4f ground = to_linear(shot.drawing.ground_colour);
  program.set("ground_colour", Eigen::Vector3f(ground[0], ground[1], ground[2]));
  program.set("background", to_linear(shot.drawing.background));
  program.set("middle", Eigen::Vector2f(shot.camera.target.head<2>().cast<float>()));
  program.set("fade", Eigen::Vector2f(float(ground_from * extent), float(ground_to * extent)));
  program.set("open", open_light(light));
}

}  // namespace

Ground::Ground(const Gl& gl, Programs programs)
    : gl_(&gl),
      programs_(std::move(programs)),
      light_(gl, Target::Depth::none),
      gathered_(gl, Target::Depth::none),
      no_vertices_(gl) {}

Result<Ground> Ground::create(const Gl& gl) {
  TRY(open, Program::create(gl, {"ground.vert"}, {"ground.glsl", "ground.frag"}));
  TRY(cast, Program::create(gl, {"cast.vert"}, {"ground.glsl", "cast.frag"}));
  TRY(soften, Program::create(gl, {"screen.vert"}, {"soften.frag"}));
  TRY(dim, Program::create(gl, {"cast.vert"}, {"dim.frag"}));
  TRY(gathered,
      Program::create(gl, {"ground.vert"}, {"ground.glsl", "ground.frag"}, "#define GATHERED\n"));
  return Ground(gl, {std::move(*open), std::move(*cast), std::move(*soften), std::move(*dim),
                     std::move(*gathered)});
}

bool Ground::seen(const RenderJob& shot) {
  const Camera& camera = shot.camera;
  const Eigen::Vector3d forward = camera_axes(camera).forward;
  const double eye_z = camera.target.z() - camera_distance(camera) * forward.z();
  const bool above =
      camera.field_of_view_deg <= 0 ? forward.z() < 0 : eye_z > shot.drawing.ground_z_mm;
  return shot.drawing.ground && above;
}

void Ground::draw(const RenderJob& shot, const Eigen::Matrix4d& matrix, const Lighting& light,
                  const ShadowMap* shadow) const {
  fill_only(*gl_);
  if (!seen(shot)) {
    const Eigen::Vector4f behind = to_linear(shot.drawing.background);
    const float alpha = shot.drawing.background.a;
    gl_->ClearColor(alpha * behind[0], alpha * behind[1], alpha * behind[2], alpha);
    return gl_->Clear(GL_COLOR_BUFFER_BIT);
  }
  draw_open(programs_.open, shot, matrix, light);
  if (shadow) draw_shadow(shot, matrix, light, *shadow);
}

void Ground::draw_open(const Program& program, const RenderJob& shot, const Eigen::Matrix4d& matrix,
                       const Lighting& light) const {
  program.use();
  set_look(program, shot, light);
  program.set("to_ground", to_ground(matrix, shot.drawing.ground_z_mm));
  gl_->BindVertexArray(no_vertices_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

/// Draws the part of the ground that the shadow map contains with `program`.
void Ground::set_shadow_uniforms(const Program& program, const RenderJob& shot,
                                 const Eigen::Matrix4d& matrix, const ShadowMap& shadow) const {
  program.set("view_projection", Eigen::Matrix4f(matrix.cast<float>()));
  program.set("on_ground", on_ground(shadow.matrix(), shot.drawing.ground_z_mm));
  program.set("ground_z", float(shot.drawing.ground_z_mm));
  program.set("lit", 0);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, light_.colour());
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_->BindVertexArray(no_vertices_.id());
  gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void Ground::draw_shadow(const RenderJob& shot, const Eigen::Matrix4d& matrix,
                         const Lighting& light, const ShadowMap& shadow) const {
  programs_.cast.use();
  set_look(programs_.cast, shot, light);
  set_shadow_uniforms(programs_.cast, shot, matrix, shadow);
}

Result<void> Ground::begin_ground_light(const Tile& tile, const std::vector<Lighting>& passes) {
  TRY_DO(gathered_.bind(tile.width, tile.height, GL_R32F));
  float open = 0;
  for (const Lighting& light : passes) open += open_light(light) / float(passes.size());
  gl_->ClearColor(open, 0, 0, 0);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  return {};
}

Result<void> Ground::gather(const RenderJob& shot, const Tile& tile, const Eigen::Matrix4d& matrix,
                            const Lighting& light, const ShadowMap& shadow, int passes) {
  TRY_DO(gathered_.bind(tile.width, tile.height, GL_R32F));
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE);
  programs_.dim.use();
  programs_.dim.set("part", open_light(light) / float(passes));
  set_shadow_uniforms(programs_.dim, shot, matrix, shadow);
  return {};
}

void Ground::draw_ground_light(const RenderJob& shot, const Eigen::Matrix4d& matrix) const {
  fill_only(*gl_);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, gathered_.colour());
  programs_.gathered.use();
  programs_.gathered.set("gathered", 0);
  draw_open(programs_.gathered, shot, matrix, {});
}

Result<void> Ground::soften(const RenderJob& shot, const ShadowMap& shadow, const Lighting& light,
                            bool many) {
  const int texels = light_texels(shot.height);
  TRY_DO(light_.bind(texels, texels, GL_R16F));
  const Program& program = programs_.soften;
  program.use();
  program.set("cover", 0);
  program.set("side", 1.f / float(texels));
  const double open = open_light(light);
  program.set("key_part", float(light.key * light.direction.z() / open));
  program.set("sky_part", many ? 0.f : float(roof * light.sky / open));
  const double texel = shadow.texel_mm();
  const double least = penumbra_least / texel,
               growth = light.spread * shadow.height_range_mm() / texel;
  program.set("wide_level", float(std::log2(2 * (least + growth))));
  program.set("least", float(least));
  program.set("growth", float(growth));
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, shadow.cover());
  fill_only(*gl_);
  gl_->BindVertexArray(no_vertices_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  return {};
}

}  // namespace gridshell::render
