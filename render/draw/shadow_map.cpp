#include "render/draw/shadow_map.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace gridshell::render {
namespace {

constexpr float cell_density = 0.4f;  // thin coloured sheets let most of the light through
constexpr float margin = 1.12f;       // empty rim, so that the blur's coarse levels end at zero

}  // namespace

Result<ShadowMap> ShadowMap::create(const Gl& gl) {
  auto program = Program::create(gl, {"caster.vert"}, {"caster.frag"});
  if (!program) return tl::unexpected(program.error());
  return ShadowMap(gl, std::move(*program));
}

void ShadowMap::fit(const Scene& scene, const Eigen::Vector3d& light) {
  Eigen::Matrix3f axes;  // rows: right, up, towards the light
  const Eigen::Vector3d right = light.unitOrthogonal();
  axes.row(0) = right.transpose().cast<float>();
  axes.row(1) = light.cross(right).transpose().cast<float>();
  axes.row(2) = light.transpose().cast<float>();
  Eigen::AlignedBox3f box;
  for (const Mesh* mesh : {&scene.solids, &scene.cells})
    for (const Vertex& v : mesh->vertices) box.extend(axes * v.position);
  if (box.isEmpty()) box.extend(Eigen::Vector3f::Zero());
  const Eigen::Vector3f middle = box.center();
  size_mm_ = std::max(1e-3f, margin * std::max(box.sizes().x(), box.sizes().y()));
  const float depth = std::max(1e-3f, margin * box.sizes().z());

  const Eigen::Vector3f scale(2 / size_mm_, 2 / size_mm_, -2 / depth);
  matrix_.setIdentity();
  matrix_.topLeftCorner<3, 3>() = scale.asDiagonal() * axes;
  matrix_.topRightCorner<3, 1>() = -scale.cwiseProduct(middle);
}

Result<void> ShadowMap::render(const Scene& scene, const VertexStore& solids,
                               const VertexStore& cells, const Eigen::Vector3d& light,
                               double ground_z) {
  if (auto bound = target_.bind(texels, texels, GL_RG8); !bound) return bound;
  fit(scene, light);
  height_range_mm_ = float(std::max(1e-3, scene.high.z() - ground_z));
  program_.use();
  program_.set("light_matrix", matrix_);
  program_.set("ground_z", float(ground_z));
  program_.set("height_scale", 1 / height_range_mm_);

  gl_->ClearColor(0, 0, 0, 0);
  gl_->Enable(GL_DEPTH_TEST);
  gl_->DepthMask(GL_TRUE);
  gl_->Disable(GL_BLEND);
  gl_->Disable(GL_CULL_FACE);
  gl_->Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  gl_->Enable(GL_CULL_FACE);
  program_.set("density", 1.f);
  solids.draw();

  gl_->Disable(GL_CULL_FACE);
  gl_->Enable(GL_BLEND);
  gl_->BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
  gl_->DepthMask(GL_FALSE);
  program_.set("density", cell_density);
  cells.draw();
  gl_->DepthMask(GL_TRUE);

  gl_->BindTexture(GL_TEXTURE_2D, cover());
  gl_->GenerateMipmap(GL_TEXTURE_2D);
  return {};
}

}  // namespace gridshell::render
