#include "render/gl/lighting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/core/try.h"
#include "render/gl/mesh.h"

namespace gridshell::render {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double key_azimuth = -70 * pi / 180;  // relative to the camera's, to its left
constexpr double key_elevation = 60 * pi / 180;
constexpr double key_disc = 5 * pi / 180;  // radius of the light's disc
constexpr double key_spread = 0.04;  // less than the disc's, so that thin rods cast visible shadows
constexpr double key_fraction = 0.55;    // of the light on level ground
constexpr double ground_fraction = 0.5;  // of the sky's light that the ground reflects

Eigen::Vector3d key_direction(const Camera& camera) {
  // a camera straight above has +y upwards in the picture, so its light is that of a camera in the
  // direction of -y
  const bool straight = std::abs(camera.elevation_deg) > 90 - 1e-6;
  const double azimuth = (straight ? -pi / 2 : camera.azimuth_deg * pi / 180) + key_azimuth;
  return {std::cos(key_elevation) * std::cos(azimuth), std::cos(key_elevation) * std::sin(azimuth),
          std::sin(key_elevation)};
}

/// Point i of the two-dimensional sequence whose steps are 1/p and 1/p^2, p the plastic number.
Eigen::Vector2d sequence(int i, double start) {
  constexpr double plastic = 1.32471795724474602596;
  const double x = start + (i + 1) / plastic, y = start + (i + 1) / (plastic * plastic);
  return {x - std::floor(x), y - std::floor(y)};
}

/// A direction on the disc of angular radius `key_disc` about `axis`, uniform for p in [0, 1]^2.
Eigen::Vector3d on_disc(const Eigen::Vector3d& axis, const Eigen::Vector2d& p) {
  const Eigen::Vector3d across = axis.unitOrthogonal();
  const double r = std::tan(key_disc) * std::sqrt(p.x()), angle = 2 * pi * p.y();
  return (axis + r * (std::cos(angle) * across + std::sin(angle) * axis.cross(across)))
      .normalized();
}

/// A direction of the upper half sphere, uniform for p in [0, 1]^2, but not near the horizon, where
/// shadows are very long.
Eigen::Vector3d on_sky(const Eigen::Vector2d& p) {
  const double z = 0.08 + 0.92 * p.x(), r = std::sqrt(1 - z * z), angle = 2 * pi * p.y();
  return {r * std::cos(angle), r * std::sin(angle), z};
}

/// Sets the key light of passes [first, last) so that in the mean of all passes level ground
/// receives `fraction` from them.
void normalise(std::vector<Lighting>& passes, int first, int last, double fraction) {
  double sum = 0;
  for (int i = first; i < last; ++i) sum += passes[i].direction.z();
  for (int i = first; i < last; ++i) passes[i].key = fraction * double(passes.size()) / sum;
}

constexpr float cell_density = 0.4f;  // thin coloured sheets let most of the light through
constexpr float margin = 1.12f;       // empty rim, so that the blur's coarse levels end at zero

}  // namespace

std::vector<Lighting> lighting_passes(const Camera& camera, int passes) {
  const Eigen::Vector3d key = key_direction(camera);
  const double sky = 1 - key_fraction, bounce = ground_fraction * sky;
  if (passes <= 1) return {{key, key_fraction / key.z(), sky, bounce, key_spread}};
  std::vector<Lighting> result(passes);
  const int keys = std::clamp(int(std::lround(key_fraction * passes)), 1, passes - 1);
  for (int i = 0; i < passes; ++i) {
    const Eigen::Vector2d p = sequence(i, 0.5);
    result[i].direction = i < keys ? on_disc(key, p) : on_sky(p);
    result[i].bounce = bounce;
    // a direction represents a part of the sky, and its shadow is blurred as wide as this part
    result[i].spread = i < keys ? 0.01 : std::sqrt(2 * pi / (passes - keys));
    result[i].pixel_shift = sequence(i, 0.25) - Eigen::Vector2d::Constant(0.5);
  }
  normalise(result, 0, keys, key_fraction);
  normalise(result, keys, passes, sky);
  return result;
}

ShadowMap::ShadowMap(const Gl& gl, Program caster, Program halve)
    : gl_(&gl),
      caster_(std::move(caster)),
      halve_(std::move(halve)),
      target_(gl, Target::Depth::compared, levels),
      level_(gl),
      no_vertices_(gl) {}

Result<ShadowMap> ShadowMap::create(const Gl& gl) {
  TRY(caster, Program::create(gl, {"ribbon.glsl", "caster.vert"}, {"caster.frag"}));
  TRY(halve, Program::create(gl, {"screen.vert"}, {"halve.frag"}));
  return ShadowMap(gl, std::move(*caster), std::move(*halve));
}

void ShadowMap::fit(const Scene& scene, const Eigen::Vector3d& light, double ground_z) {
  Eigen::Matrix3f axes;  // rows: right, up, towards the light
  const Eigen::Vector3d right = light.unitOrthogonal();
  axes.row(0) = right.transpose().cast<float>();
  axes.row(1) = light.cross(right).transpose().cast<float>();
  axes.row(2) = light.transpose().cast<float>();
  Eigen::AlignedBox3f box;
  auto top = float(ground_z);
  for (const Mesh* mesh : {&scene.ribbons, &scene.sheets})
    for (const Vertex& v : mesh->vertices) {
      box.extend(axes * v.position);
      top = std::max(top, v.position.z());
    }
  if (box.isEmpty()) box.extend(Eigen::Vector3f::Zero());
  const Eigen::Vector3f middle = box.center();
  const float side = std::max(1e-3f, margin * std::max(box.sizes().x(), box.sizes().y()));
  texel_mm_ = side / float(texels_);
  height_range_mm_ = std::max(1e-3f, top - float(ground_z));
  const float depth = std::max(1e-3f, margin * box.sizes().z());

  const Eigen::Vector3f scale(2 / side, 2 / side, -2 / depth);
  matrix_.setIdentity();
  matrix_.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  matrix_.topRightCorner<3, 1>() = -scale.cwiseProduct(middle);
}

Result<void> ShadowMap::render(const Scene& scene, const VertexStore& ribbons,
                               const VertexStore& sheets, const Eigen::Vector3d& light,
                               double ground_z, int texels) {
  texels_ = texels;
  TRY_DO(target_.bind(texels, texels, GL_RG8));
  fit(scene, light, ground_z);
  caster_.use();
  caster_.set("light_matrix", matrix_);
  caster_.set("light", Eigen::Vector3f(light.cast<float>()));
  caster_.set("widest", widest_radius_mm);
  caster_.set("ground_z", float(ground_z));
  caster_.set("height_scale", 1 / height_range_mm_);
  draw_casters(ribbons, sheets);
  blur();
  return {};
}

void ShadowMap::draw_casters(const VertexStore& ribbons, const VertexStore& sheets) const {
  gl_->ClearColor(0, 0, 0, 0);
  gl_->Enable(GL_DEPTH_TEST);
  gl_->DepthFunc(GL_LESS);
  gl_->DepthMask(GL_TRUE);
  gl_->Disable(GL_BLEND);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_->Disable(GL_CULL_FACE);
  caster_.set("density", 1.f);
  caster_.set("ribbons", 1);
  ribbons.draw(1);
  caster_.set("ribbons", 0);

  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DepthMask(GL_FALSE);
  caster_.set("density", cell_density);
  sheets.draw();
  gl_->DepthMask(GL_TRUE);
}

void ShadowMap::blur() {
  gl_->Disable(GL_BLEND);
  gl_->Disable(GL_DEPTH_TEST);
  gl_->ActiveTexture(GL_TEXTURE0);
  gl_->BindTexture(GL_TEXTURE_2D, cover());
  gl_->BindFramebuffer(GL_FRAMEBUFFER, level_.id());
  gl_->BindVertexArray(no_vertices_.id());
  halve_.use();
  halve_.set("finer", 0);
  for (int level = 1; level < levels; ++level) {
    const int side = texels_ >> level;
    // the shader reads only this level and writes the next
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, level - 1);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, level - 1);
    gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, cover(), level);
    gl_->Viewport(0, 0, side, side);
    halve_.set("finer_texel", 0.5f / float(side));
    gl_->DrawArrays(GL_TRIANGLES, 0, 3);
  }
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_BASE_LEVEL, 0);
  gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, levels - 1);
}

}  // namespace gridshell::render
