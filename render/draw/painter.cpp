#include "render/draw/painter.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <utility>

#include "render/draw/camera.h"
#include "render/draw/colour.h"
#include "render/draw/ribbon.h"

namespace gridshell::render {
namespace {

constexpr double ground_from = 1.2, ground_to = 4;  // where it pales, in half extents of the view
constexpr float penumbra_least = 0.8f;              // mm, where rod and ground touch
constexpr float roof = 0.35f;  // of the sky's light that a closed roof takes from the ground
constexpr float shell_blur_mm = 0.8f;  // radius of the shadow's edge on the shell

Eigen::Vector3f linear(const Colour& c) { return to_linear(c).head<3>(); }

/// Takes (x, y, 1) of clip coordinates to the point (X, Y, 1) of the plane z, over its depth w.
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

/// Of a sample: mm at distance 1 in perspective, else anywhere.
double sample_size(const Shot& shot) {
  const double mm = 2 * shot.camera.half_extent_mm / (shot.height * shot.quality.supersample);
  return shot.camera.field_of_view_deg <= 0 ? mm : mm / camera_distance(shot.camera);
}

/// The ground hides nothing when it is seen from below.
bool ground_seen(const Shot& shot) {
  const Camera& camera = shot.camera;
  const Eigen::Vector3d forward = camera_axes(camera).forward;
  const double eye_z = camera.target.z() - camera_distance(camera) * forward.z();
  const bool above =
      camera.field_of_view_deg <= 0 ? forward.z() < 0 : eye_z > shot.drawing.ground_z_mm;
  return shot.drawing.ground && above;
}

}  // namespace

Painter::Painter(const Gl& gl, Programs programs, ShadowMap shadow)
    : gl_(&gl),
      programs_(std::move(programs)),
      shadow_(std::move(shadow)),
      sheets_(gl),
      ribbons_(gl),
      beads_(gl),
      no_vertices_(gl),
      layer_(gl, Target::Depth::none),
      sum_(gl, Target::Depth::none),
      pixels_(gl, Target::Depth::none) {}

Result<Painter> Painter::create(const Gl& gl) {
  auto shadow = ShadowMap::create(gl);
  if (!shadow) return tl::unexpected(shadow.error());
  auto sheet = Program::create(gl, {"light.glsl", "sheet.vert"}, {"shadow.glsl", "sheet.frag"});
  if (!sheet) return tl::unexpected(sheet.error());
  auto ribbon = Program::create(gl, {"light.glsl", "ribbon.glsl", "ribbon.vert"},
                                {"light.glsl", "shadow.glsl", "metal.glsl", "ribbon.frag"});
  if (!ribbon) return tl::unexpected(ribbon.error());
  auto bead = Program::create(gl, {"light.glsl", "ribbon.glsl", "bead.vert"},
                              {"light.glsl", "shadow.glsl", "metal.glsl", "bead.frag"});
  if (!bead) return tl::unexpected(bead.error());
  auto mean = Program::create(gl, {"screen.vert"}, {"mean.frag"});
  if (!mean) return tl::unexpected(mean.error());
  return Painter(gl, {std::move(*sheet), std::move(*ribbon), std::move(*bead), std::move(*mean)},
                 std::move(*shadow));
}

Result<void> Painter::begin(const Shot& shot) {
  if (const int s = shot.quality.supersample; !resolve_.count(s)) {
    // a loop of known length costs half of one that is not
    auto program = Program::create(*gl_, {"resolve.vert"}, {"ground.glsl", "resolve.frag"},
                                   fmt::format("#define PER_SIDE {}\n", s));
    if (!program) return tl::unexpected(program.error());
    resolve_.emplace(s, std::move(*program));
  }
  sheets_.upload(shot.scene.sheets);
  ribbons_.upload(shot.scene.ribbons, {shot.scene.casters});
  beads_.upload(shot.scene.beads);
  passes_ = lighting_passes(shot.camera, shot.quality.jittered_passes);
  shadow_of_ = -1;
  return {};
}

Result<void> Painter::paint(const Shot& shot, const Tile& tile, Image& image) {
  const bool many = passes_.size() > 1;
  if (many) {
    if (auto bound = sum_.bind(tile.width, tile.height, GL_RGBA32F); !bound) return bound;
    gl_->ClearColor(0, 0, 0, 0);
    gl_->Clear(GL_COLOR_BUFFER_BIT);
  }
  for (int i = 0; i < int(passes_.size()); ++i) {
    if (shot.quality.shadow && shadow_of_ != i) {
      auto done = shadow_.render(shot.scene, ribbons_, sheets_, passes_[i].direction,
                                 shot.drawing.ground_z_mm);
      if (!done) return done;
      shadow_of_ = i;
    }
    if (auto done = paint_layer(shot, tile, passes_[i]); !done) return done;
    Target& to = many ? sum_ : pixels_;
    if (auto bound = to.bind(tile.width, tile.height, many ? GL_RGBA32F : GL_SRGB8_ALPHA8); !bound)
      return bound;
    resolve(shot, tile, passes_[i]);
  }
  if (many) {
    if (auto bound = pixels_.bind(tile.width, tile.height, GL_SRGB8_ALPHA8); !bound) return bound;
    programs_.mean.use();
    programs_.mean.set("sum", 0);
    programs_.mean.set("share", 1.f / float(passes_.size()));
    gl_->ActiveTexture(GL_TEXTURE0);
    gl_->BindTexture(GL_TEXTURE_2D, sum_.colour());
    gl_->Disable(GL_BLEND);
    screen_triangle();
  }
  gl_->ReadBuffer(GL_COLOR_ATTACHMENT0);
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, shot.width);
  gl_->ReadPixels(0, 0, tile.width, tile.height, GL_RGBA, GL_UNSIGNED_BYTE,
                  image.pixel(tile.x, tile.y));
  gl_->PixelStorei(GL_PACK_ROW_LENGTH, 0);
  return {};
}

Eigen::Matrix4d Painter::matrix(const Shot& shot, const Tile& tile, const Lighting& light) const {
  return crop(tile, shot.width, shot.height, light.pixel_shift / shot.quality.supersample) *
         view_projection(shot.camera, double(shot.width) / shot.height, shot.scene.centre(),
                         shot.scene.radius());
}

Result<void> Painter::paint_layer(const Shot& shot, const Tile& tile, const Lighting& light) {
  // light of a single pass may be brighter than white
  const GLenum format = passes_.size() > 1 ? GL_RGBA16F : GL_SRGB8_ALPHA8;
  const int s = shot.quality.supersample;
  if (auto bound = layer_.bind(s * tile.width, s * tile.height, format); !bound) return bound;
  gl_->Disable(GL_SCISSOR_TEST);
  gl_->Enable(GL_FRAMEBUFFER_SRGB);
  gl_->Disable(GL_DEPTH_TEST);
  gl_->Disable(GL_CULL_FACE);
  gl_->ClearColor(0, 0, 0, 0);
  gl_->Clear(GL_COLOR_BUFFER_BIT);

  // the ground hides what dips below it
  const bool dips = ground_seen(shot) && shot.scene.low.z() < shot.drawing.ground_z_mm;
  if (dips) gl_->Enable(GL_CLIP_DISTANCE0);
  draw_meshes(shot, light, matrix(shot, tile, light).cast<float>());
  if (dips) gl_->Disable(GL_CLIP_DISTANCE0);
  return {};
}

void Painter::set_light(const Program& program, const Shot& shot, const Lighting& light) const {
  const Eigen::Vector3d forward = camera_axes(shot.camera).forward;
  const bool orthographic = shot.camera.field_of_view_deg <= 0;
  const Eigen::Vector3d eye =
      orthographic ? Eigen::Vector3d(-forward)
                   : Eigen::Vector3d(shot.camera.target - camera_distance(shot.camera) * forward);
  Eigen::Vector4f eye_uniform;
  eye_uniform << eye.cast<float>(), orthographic ? 0.f : 1.f;
  // what the camera shows, not what the scene holds: a movie's frames must not differ by it
  const double extent = shot.camera.half_extent_mm;
  const double middle = forward.dot(shot.camera.target);
  program.set("ground_z", float(shot.drawing.ground_z_mm));
  program.set("light_direction", Eigen::Vector3f(light.direction.cast<float>()));
  program.set("key", float(light.key));
  program.set("sky", float(light.sky));
  program.set("bounce", float(light.bounce));
  program.set("eye", eye_uniform);
  program.set("background", linear(shot.drawing.background));
  program.set("forward", Eigen::Vector3f(forward.cast<float>()));
  program.set("far_fade", float(shot.drawing.far_fade));
  program.set("sheen", float(shot.drawing.sheen));
  program.set("haze", Eigen::Vector2f(float(middle), float(1 / extent)));
  program.set("shadow_on", int(shot.quality.shadow));
  program.set("shadow_depth", 1);
  program.set("light_matrix", shadow_.matrix());
  // jittered light softens the shadow by itself
  program.set("shadow_blur", passes_.size() > 1
                                 ? 0.f
                                 : shell_blur_mm / shadow_.texel_mm() / float(ShadowMap::texels));
  const double past_rod = std::max(shot.drawing.rod_diameter_mm, 1.5 * shadow_.texel_mm());
  program.set("shadow_offset", Eigen::Vector3f((past_rod * light.direction).cast<float>()));
}

void Painter::draw_meshes(const Shot& shot, const Lighting& light, const Eigen::Matrix4f& matrix) {
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, shadow_.depth());
  for (const Program* program : {&programs_.sheet, &programs_.ribbon, &programs_.bead}) {
    program->use();
    program->set("view_projection", matrix);
    set_light(*program, shot, light);
    if (program == &programs_.sheet) continue;
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
    paint(programs_.sheet, sheets_, layers[k].sheets, layers[k + 1].sheets);
    paint(programs_.ribbon, ribbons_, layers[k].ribbons, layers[k + 1].ribbons);
    paint(programs_.bead, beads_, layers[k].beads, layers[k + 1].beads);
  }
}

void Painter::resolve(const Shot& shot, const Tile& tile, const Lighting& light) {
  const double extent = shot.camera.half_extent_mm;
  const Program& program = resolve_.at(shot.quality.supersample);
  program.use();
  program.set("samples", 0);
  program.set("texel_of_samples",
              Eigen::Vector2f(1.f / float(shot.quality.supersample * tile.width),
                              1.f / float(shot.quality.supersample * tile.height)));
  program.set("cover", 1);
  program.set("rows", tile.height);
  program.set("to_ground", to_ground(matrix(shot, tile, light), shot.drawing.ground_z_mm));
  program.set("ground_on", int(ground_seen(shot)));
  program.set("ground_z", float(shot.drawing.ground_z_mm));
  program.set("ground_colour", linear(shot.drawing.ground_colour));
  program.set("background", linear(shot.drawing.background));
  program.set("background_alpha", shot.drawing.background.a);
  program.set("middle", Eigen::Vector2f(shot.camera.target.head<2>().cast<float>()));
  program.set("fade", Eigen::Vector2f(float(ground_from * extent), float(ground_to * extent)));
  program.set("shadow_on", int(shot.quality.shadow));
  program.set("light_matrix", shadow_.matrix());
  program.set("height_range", shadow_.height_range_mm());
  program.set("texel", shadow_.texel_mm());
  const bool many = passes_.size() > 1;
  program.set("key_part", float(light.key * light.direction.z()));
  program.set("sky_part", many ? 0.f : roof * float(light.sky));
  program.set("open", float(light.key * light.direction.z() + light.sky));
  program.set("penumbra", Eigen::Vector2f(penumbra_least, float(light.spread)));

  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, layer_.colour());
  // four samples of a pixel in one fetch between them
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_->ActiveTexture(GL_TEXTURE1);
  gl_->BindTexture(GL_TEXTURE_2D, shadow_.cover());
  gl_->Disable(GL_DEPTH_TEST);
  if (many) {
    gl_->Enable(GL_BLEND);
    gl_->BlendFunc(GL_ONE, GL_ONE);
  } else {
    gl_->Disable(GL_BLEND);
  }
  screen_triangle();
}

void Painter::screen_triangle() const {
  gl_->Disable(GL_CULL_FACE);
  gl_->BindVertexArray(no_vertices_.id());
  gl_->DrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace gridshell::render
