#include "render/draw/shadow_map.h"

#include <Eigen/Geometry>
#include <algorithm>

#include "render/draw/ribbon.h"

namespace gridshell::render {
namespace {

constexpr float cell_density = 0.4f;  // thin coloured sheets let most of the light through
constexpr float margin = 1.12f;       // empty rim, so that the blur's coarse levels end at zero

}  // namespace

ShadowMap::ShadowMap(const Gl& gl, Program caster, Program halve)
    : gl_(&gl),
      caster_(std::move(caster)),
      halve_(std::move(halve)),
      target_(gl, Target::Depth::compared, levels),
      level_(gl),
      no_vertices_(gl) {}

Result<ShadowMap> ShadowMap::create(const Gl& gl) {
  auto caster = Program::create(gl, {"ribbon.glsl", "caster.vert"}, {"caster.frag"});
  if (!caster) return tl::unexpected(caster.error());
  auto halve = Program::create(gl, {"screen.vert"}, {"halve.frag"});
  if (!halve) return tl::unexpected(halve.error());
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
  texel_mm_ = side / texels;
  height_range_mm_ = std::max(1e-3f, top - float(ground_z));
  const float depth = std::max(1e-3f, margin * box.sizes().z());

  const Eigen::Vector3f scale(2 / side, 2 / side, -2 / depth);
  matrix_.setIdentity();
  matrix_.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  matrix_.topRightCorner<3, 1>() = -scale.cwiseProduct(middle);
}

Result<void> ShadowMap::render(const Scene& scene, const VertexStore& ribbons,
                               const VertexStore& sheets, const Eigen::Vector3d& light,
                               double ground_z) {
  if (auto bound = target_.bind(texels, texels, GL_RG8); !bound) return bound;
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
    const int side = texels >> level;
    // reads one level only, writes the next
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
