#include "render/gl/painter.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <utility>

#include "render/gl/image.h"
#include "render/gl/mesh.h"
#include "render/gl/renderer.h"

#include "engine/core/try.h"

namespace gridshell::render {
namespace {

constexpr float shell_blur_mm = 0.8f;  // radius of the shadow's edge on the shell

Eigen::Vector3f linear(const Colour& c) { return to_linear(c).head<3>(); }

/// The size of a sample in mm; in perspective at distance 1.
double sample_size(const RenderJob& shot) {
  const double mm = 2 * shot.camera.half_extent_mm / (shot.height * shot.quality.supersample);
  return shot.camera.field_of_view_deg <= 0 ? mm : mm / camera_distance(shot.camera);
}

/// The part of a tile that the shell may cover; empty if it covers none.
Tile shell_in(const RenderJob& shot, const Tile& tile) {
  constexpr double room = 2;  // pixels, for smooth edges, which are wider than the rods
  constexpr int step = 64;    // pixels, so that targets for a moving shell have few sizes
  const Eigen::Matrix4d matrix = view_projection(shot.camera, double(shot.width) / shot.height,
                                                 shot.scene.centre(), shot.scene.radius());
  const Eigen::Vector3d *low = &shot.scene.low, *high = &shot.scene.high;
  Eigen::AlignedBox2d seen;
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector4d at(((corner & 1) ? high : low)->x(), ((corner & 2) ? high : low)->y(),
                             ((corner & 4) ? high : low)->z(), 1);
    const Eigen::Vector4d clip = matrix * at;
    // the projection of a corner behind the camera is meaningless
    if (clip.w() <= 0) return tile;
    seen.extend(Eigen::Vector2d(0.5 * (1 + clip.x() / clip.w()) * shot.width,
                                0.5 * (1 - clip.y() / clip.w()) * shot.height));
  }
  const auto within = [](double value, int from, int size) {
    return int(std::clamp(value, double(from), double(from + size)));
  };
  Tile part;
  const auto below = [](double at) { return step * std::floor((at - room) / step); };
  const auto above = [](double at) { return step * std::ceil((at + room) / step); };
  part.x = within(below(seen.min().x()), tile.x, tile.width);
  part.y = within(below(seen.min().y()), tile.y, tile.height);
  part.width = within(above(seen.max().x()), tile.x, tile.width) - part.x;
  part.height = within(above(seen.max().y()), tile.y, tile.height) - part.y;
  return part;
}

}  // namespace

Painter::Painter(const Gl& gl, Program mean, Ground ground, ShadowMap shadow)
    : gl_(&gl),
      mean_(std::move(mean)),
      ground_(std::move(ground)),
      shadow_(std::move(shadow)),
      sheets_(gl),
      ribbons_(gl),
      beads_(gl),
      no_vertices_(gl),
      layer_(gl, Target::Depth::none),
      pass_(gl, Target::Depth::none),
      sum_(gl, Target::Depth::none),
      whole_(gl, Target::Depth::none),
      pixels_(gl, Target::Depth::none) {}

Result<Painter> Painter::create(const Gl& gl) {
  TRY(shadow, ShadowMap::create(gl));
  TRY(ground, Ground::create(gl));
  TRY(mean, Program::create(gl, {"screen.vert"}, {"mean.frag"}));
  return Painter(gl, std::move(*mean), std::move(*ground), std::move(*shadow));
}

Result<Painter::Programs> Painter::create_programs(int taps) const {
  const std::string define = fmt::format("#define TAPS {}\n", taps);
  TRY(sheet, Program::create(*gl_, {"sheet.vert"}, {"sheet.frag"}, define));
  TRY(ribbon, Program::create(*gl_, {"light.glsl", "tint.glsl", "ribbon.glsl", "ribbon.vert"},
                              {"light.glsl", "shadow.glsl", "metal.glsl", "ribbon.frag"}, define));
  TRY(bead, Program::create(*gl_, {"light.glsl", "tint.glsl", "ribbon.glsl", "bead.vert"},
                            {"light.glsl", "shadow.glsl", "metal.glsl", "bead.frag"}, define));
  return Programs{std::move(*sheet), std::move(*ribbon), std::move(*bead)};
}

/// Compiles the programs that the quality needs, each at its first use.
Result<void> Painter::prepare(const DrawQuality& quality) {
  // jittered light or several samples per pixel soften the shadow by themselves
  taps_ = !quality.shadow ? 0 : quality.jittered_passes > 1 || quality.supersample > 1 ? 1 : 4;
  if (!programs_.count(taps_)) {
    TRY(programs, create_programs(taps_));
    programs_.emplace(taps_, std::move(*programs));
  }
  if (const int s = quality.supersample; s > 1 && !average_.count(s)) {
    // a loop whose length is known to the compiler costs half
    TRY(program, Program::create(*gl_, {"screen.vert"}, {"average.frag"},
                                 fmt::format("#define PER_SIDE {}\n", s)));
    average_.emplace(s, std::move(*program));
  }
  return {};
}

Result<void> Painter::begin(const RenderJob& shot) {
  TRY_DO(prepare(shot.quality));
  sheets_.upload(shot.scene.sheets);
  ribbons_.upload(shot.scene.ribbons, {shot.scene.casters});
  beads_.upload(shot.scene.beads);
  passes_ = lighting_passes(shot.camera, shot.quality.jittered_passes);
  shadow_of_ = -1;
  return {};
}

Result<void> Painter::paint(const RenderJob& shot, const Tile& tile, Image& image) {
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->Enable(GL_FRAMEBUFFER_SRGB);
  auto painted = multi_pass() ? paint_multi_pass(shot, tile) : paint_single_pass(shot, tile);
  if (!painted) return painted;
  gl_->ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, shot.width);
  gl_->ReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_UNSIGNED_BYTE,
                  image.pixel(tile.x, tile.y));
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, 0);
  return {};
}

/// Draws the shadow map of a pass, unless it is still that of this pass from the tile before.
Result<void> Painter::cast(const RenderJob& shot, int pass) {
  if (!shot.quality.shadow || shadow_of_ == pass) return {};
  const Lighting& light = passes_[std::size_t(pass)];
  auto done = shadow_.render(shot.scene, ribbons_, sheets_, light.direction,
                             shot.drawing.ground_z_mm, ShadowMap::texels_for(shot.height));
  if (!done) return done;
  shadow_of_ = pass;
  return Ground::seen(shot) ? ground_.soften(shot, shadow_, light, multi_pass()) : Result<void>{};
}

Result<void> Painter::paint_single_pass(const RenderJob& shot, const Tile& tile) {
  TRY_DO(cast(shot, 0));
  const Eigen::Matrix4d matrix = matrix_of(shot, tile, passes_[0]);
  const int s = shot.quality.supersample;
  const Tile part = s > 1 ? shell_in(shot, tile) : Tile{};
  const bool layered = part.width > 0 && part.height > 0;
  if (layered) TRY_DO(paint_shell(shot, part, passes_[0], layer_));
  TRY_DO(pixels_.bind(tile.width, tile.height, GL_SRGB8_ALPHA8));
  ground_.draw(shot, matrix, passes_[0], shot.quality.shadow ? &shadow_ : nullptr);
  if (layered)
    composite_shell(s, part, {part.x - tile.x, part.y - tile.y});
  else if (s == 1)
    draw_meshes(shot, passes_[0], matrix.cast<float>());
  return {};
}

/// Paints the mean of all passes. The shell is summed where it may be seen, and for the ground only
/// the light; the shell is then composited over the ground once.
Result<void> Painter::paint_multi_pass(const RenderJob& shot, const Tile& tile) {
  const Tile part = shell_in(shot, tile);
  const bool shell = part.width > 0 && part.height > 0;
  const bool shade = shot.quality.shadow && Ground::seen(shot);
  TRY_DO(ground_.begin_ground_light(tile, passes_));
  for (int i = 0; i < int(passes_.size()); ++i) {
    const Lighting& light = passes_[std::size_t(i)];
    TRY_DO(cast(shot, i));
    if (shade)
      TRY_DO(ground_.gather(shot, tile, matrix_of(shot, tile, light), light, shadow_,
                            int(passes_.size())));
    if (shell) TRY_DO(accumulate_shell(shot, part, light, i == 0));
  }
  TRY_DO(whole_.bind(tile.width, tile.height, GL_RGBA16F));
  const Eigen::Matrix4d still = matrix_of(shot, tile, Lighting{});
  if (Ground::seen(shot))
    ground_.draw_ground_light(shot, still);
  else
    ground_.draw(shot, still, passes_[0], nullptr);
  if (shell) {
    gl_->Enable(GL_BLEND);
    gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    gl_->Viewport(part.x - tile.x, part.y - tile.y, part.width, part.height);
    show(sum_.colour(), 1.f / float(passes_.size()), {part.x - tile.x, part.y - tile.y});
  }
  TRY_DO(pixels_.bind(tile.width, tile.height, GL_SRGB8_ALPHA8));
  gl_->Disable(GL_BLEND);
  show(whole_.colour(), 1, {0, 0});
  return {};
}

/// Adds the shell in the light of one pass to the sum.
Result<void> Painter::accumulate_shell(const RenderJob& shot, const Tile& part,
                                       const Lighting& light, bool first) {
  const int s = shot.quality.supersample;
  TRY_DO(paint_shell(shot, part, light, s > 1 ? layer_ : pass_));
  if (s > 1) {
    TRY_DO(pass_.bind(part.width, part.height, GL_RGBA16F));
    gl_->ClearColor(0, 0, 0, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
    composite_shell(s, part, {0, 0});
  }
  TRY_DO(sum_.bind(part.width, part.height, GL_RGBA32F));
  if (first) {
    gl_->ClearColor(0, 0, 0, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
  }
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE);
  show(pass_.colour(), 1, {0, 0});
  return {};
}

/// Draws the shell on a transparent target of s x s samples per pixel, premultiplied.
Result<void> Painter::paint_shell(const RenderJob& shot, const Tile& tile, const Lighting& light,
                                  Target& to) {
  const int s = shot.quality.supersample;
  const GLenum format = multi_pass() ? GL_RGBA16F : GL_SRGB8_ALPHA8;
  TRY_DO(to.bind(s * tile.width, s * tile.height, format));
  gl_->ClearColor(0, 0, 0, 0);
  gl_->Clear(GL_COLOR_BUFFER_BIT);
  draw_meshes(shot, light, matrix_of(shot, tile, light).cast<float>());
  return {};
}

/// Matrix from the world to the clip coordinates of a tile, whose target has the top row first.
Eigen::Matrix4d Painter::matrix_of(const RenderJob& shot, const Tile& tile, const Lighting& light) {
  Eigen::Matrix4d matrix =
      crop(tile, shot.width, shot.height, light.pixel_shift / shot.quality.supersample) *
      view_projection(shot.camera, double(shot.width) / shot.height, shot.scene.centre(),
                      shot.scene.radius());
  matrix.row(1) *= -1;
  return matrix;
}

/// Draws a texture, times `fraction`, to the bound target with its first texel at pixel `corner`,
/// with the current blending.
void Painter::show(GLuint texture, float fraction, const Eigen::Vector2i& corner) const {
  mean_.use();
  mean_.set("corner", Eigen::Vector2f(corner.cast<float>()));
  mean_.set("sum", 0);
  mean_.set("share", fraction);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, texture);
  screen_triangle();
}

/// Composites the samples of `part` (in layer_) over the bound target, from its pixel `corner`.
void Painter::composite_shell(int per_side, const Tile& part, const Eigen::Vector2i& corner) const {
  const Program& program = average_.at(per_side);
  program.use();
  program.set("samples", 0);
  program.set("texel_of_samples", Eigen::Vector2f(1.f / float(per_side * part.width),
                                                  1.f / float(per_side * part.height)));
  program.set("corner", Eigen::Vector2f(corner.cast<float>()));
  gl_->Viewport(corner.x(), corner.y(), part.width, part.height);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, layer_.colour());
  // one fetch between the four samples of a pixel gives their mean
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  screen_triangle();
}

void Painter::set_light(const Program& program, const RenderJob& shot,
                        const Lighting& light) const {
  const Eigen::Vector3d forward = camera_axes(shot.camera).forward;
  const bool orthographic = shot.camera.field_of_view_deg <= 0;
  const Eigen::Vector3d eye =
      orthographic ? Eigen::Vector3d(-forward)
                   : Eigen::Vector3d(shot.camera.target - camera_distance(shot.camera) * forward);
  Eigen::Vector4f eye_uniform;
  eye_uniform << eye.cast<float>(), orthographic ? 0.f : 1.f;
  // haze depends on the camera and not on the contents, so that it is the same in a movie's frames
  const double extent = shot.camera.half_extent_mm;
  const double middle = forward.dot(shot.camera.target);
  program.set("light_direction", Eigen::Vector3f(light.direction.cast<float>()));
  program.set("key", float(light.key));
  program.set("sky", float(light.sky));
  program.set("bounce", float(light.bounce));
  program.set("eye", eye_uniform);
  program.set("background", linear(shot.drawing.background));
  program.set("forward", Eigen::Vector3f(forward.cast<float>()));
  program.set("far_fade", float(shot.drawing.far_fade));
  program.set("sheen", float(shot.drawing.sheen));
  program.set("unlit", shot.drawing.node_colours.empty() ? 0.f : 1.f);
  program.set("haze", Eigen::Vector2f(float(middle), float(1 / extent)));
}

void Painter::set_shadow(const Program& program, const RenderJob& shot,
                         const Lighting& light) const {
  const double past_rod = std::max(shot.drawing.rod_diameter_mm, 1.5 * shadow_.texel_mm());
  program.set("shadow_depth", 1);
  program.set("light_matrix", shadow_.matrix());
  program.set("shadow_blur", shell_blur_mm / shadow_.texel_mm() / float(shadow_.texels()));
  program.set("shadow_offset", Eigen::Vector3f((past_rod * light.direction).cast<float>()));
}

void Painter::draw_meshes(const RenderJob& shot, const Lighting& light,
                          const Eigen::Matrix4f& matrix) {
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, shadow_.depth());
  const Programs& programs = programs_.at(taps_);
  for (const Program* program : {&programs.sheet, &programs.ribbon, &programs.bead}) {
    program->use();
    program->set("view_projection", matrix);
    if (program == &programs.sheet) continue;
    set_light(*program, shot, light);
    set_shadow(*program, shot, light);
    program->set("widest", widest_radius_mm);
    program->set("sample_size", float(sample_size(shot)));
  }
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  const std::vector<Layer>& layers = shot.scene.layers;
  const auto paint = [&](const Program& program, const VertexStore& store, std::size_t begin,
                         std::size_t end) {
    if (begin == end) return;
    program.use();
    store.draw_range(begin, end);
  };
  for (std::size_t k = 0; k + 1 < layers.size(); ++k) {
    paint(programs.sheet, sheets_, layers[k].sheets, layers[k + 1].sheets);
    paint(programs.ribbon, ribbons_, layers[k].ribbons, layers[k + 1].ribbons);
    paint(programs.bead, beads_, layers[k].beads, layers[k + 1].beads);
  }
}

void Painter::screen_triangle() const {
  gl_->Disable(GL_CULL_FACE);
  gl_->BindVertexArray(no_vertices_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace gridshell::render
