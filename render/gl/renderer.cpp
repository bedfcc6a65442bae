#include "render/gl/renderer.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "render/gl/context.h"
#include "render/gl/painter.h"
#include "render/gl/scene.h"

#include "engine/core/try.h"

namespace gridshell::render {
namespace {

constexpr double radian = std::numbers::pi / 180;

constexpr int largest_target = 4096;  // samples per side of a tile, for the sake of the caches
constexpr int most_samples = 16, most_passes = 4096, longest_side = 32767;

Result<void> check(const DrawQuality& quality, int width, int height) {
  if (width < 1 || height < 1 || width > longest_side || height > longest_side ||
      std::size_t(width) * std::size_t(height) > most_pixels)
    return invalid("size: got {} x {} pixels, expected 1 to {} each and at most {} million", width,
                   height, longest_side, most_pixels / 1000000);
  if (quality.supersample < 1 || quality.supersample > most_samples)
    return invalid("supersample: got {}, expected 1 to {}", quality.supersample, most_samples);
  if (quality.jittered_passes < 1 || quality.jittered_passes > most_passes)
    return invalid("jittered_passes: got {}, expected 1 to {}", quality.jittered_passes,
                   most_passes);
  return {};
}

/// Divides the colours, which were multiplied by alpha in linear light, by alpha.
void unpremultiply(Image& image) {
  for (std::size_t k = 0; k < image.rgba.size(); k += 4) {
    const float alpha = float(image.rgba[k + 3]) / 255;
    for (int c = 0; c < 3 && alpha > 0 && alpha < 1; ++c) {
      const float linear = std::min(1.f, to_linear(float(image.rgba[k + c]) / 255) / alpha);
      image.rgba[k + c] = std::uint8_t(255 * to_srgb(linear) + 0.5f);
    }
  }
}

class GlRenderer final : public Renderer {
 public:
  GlRenderer(const Gl& gl) : gl_(gl) {}

  Result<void> prepare() {
    TRY(painter, Painter::create(gl_));
    painter_.emplace(std::move(*painter));
    GLint limit = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    target_side_ = std::min(largest_target, int(limit));
    return {};
  }

  Result<Image> draw(const Drawing& drawing, const Camera& camera, const DrawQuality& quality,
                     int width, int height) override {
    TRY_DO(check(quality, width, height));
    const double sample_mm = 2 * camera.half_extent_mm / height / quality.supersample;
    TRY(scene, make_scene(drawing, camera, sample_mm, quality));
    while (gl_.GetError() != GL_NO_ERROR) continue;  // ignore errors of earlier callers

    Image image(width, height);
    const RenderJob shot{*scene, drawing, camera, quality, width, height};
    TRY_DO(painter_->begin(shot));
    for (const Tile& tile : tiles(width, height, target_side_ / quality.supersample))
      TRY_DO(painter_->paint(shot, tile, image));
    if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR)
      return fail(Fault::io,
                  "OpenGL failed on a picture of {} x {} pixels, "
                  "error {:#x}{}",
                  width, height, error, error == GL_OUT_OF_MEMORY ? " (out of memory)" : "");
    if (drawing.background.a < 1) unpremultiply(image);
    return image;
  }

 private:
  Gl gl_;
  std::optional<Painter> painter_;
  int target_side_ = largest_target;
};

}  // namespace

CameraAxes camera_axes(const Camera& camera) {
  const double azimuth = camera.azimuth_deg * radian, elevation = camera.elevation_deg * radian;
  CameraAxes axes;
  axes.forward = -Eigen::Vector3d(std::cos(elevation) * std::cos(azimuth),
                                  std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
  // seen straight from above or below the z axis has no direction in the picture
  const bool straight = std::abs(axes.forward.z()) > 1 - 1e-9;
  const Eigen::Vector3d top = straight ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitZ();
  axes.right = axes.forward.cross(top).normalized();
  axes.up = axes.right.cross(axes.forward);
  return axes;
}

double camera_distance(const Camera& camera) {
  if (camera.field_of_view_deg <= 0) return 10 * camera.half_extent_mm;
  return camera.half_extent_mm / std::tan(0.5 * camera.field_of_view_deg * radian);
}

Eigen::Matrix4d view_projection(const Camera& camera, double aspect, const Eigen::Vector3d& centre,
                                double radius) {
  const CameraAxes axes = camera_axes(camera);
  const double distance = camera_distance(camera);
  const Eigen::Vector3d eye = camera.target - distance * axes.forward;
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = axes.right.transpose();
  view.block<1, 3>(1, 0) = axes.up.transpose();
  view.block<1, 3>(2, 0) = -axes.forward.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * eye;

  const bool orthographic = camera.field_of_view_deg <= 0;
  const double middle = axes.forward.dot(centre - eye);
  double near = middle - radius, far = middle + radius;
  if (!orthographic) {
    near = std::max(near, 0.01 * distance);
    far = std::max(far, 1.01 * near);
  }
  const double scale = orthographic ? 1 / camera.half_extent_mm : distance / camera.half_extent_mm;
  Eigen::Matrix4d projection = Eigen::Matrix4d::Zero();
  projection(0, 0) = scale / aspect;
  projection(1, 1) = scale;
  if (orthographic) {
    projection(2, 2) = -2 / (far - near);
    projection(2, 3) = -(far + near) / (far - near);
    projection(3, 3) = 1;
  } else {
    projection(2, 2) = -(far + near) / (far - near);
    projection(2, 3) = -2 * far * near / (far - near);
    projection(3, 2) = -1;
  }
  return projection * view;
}

Eigen::Vector2d to_pixel(const Camera& camera, int width, int height,
                         const Eigen::Vector3d& point) {
  const Eigen::Matrix4d m =
      view_projection(camera, double(width) / height, camera.target, camera.half_extent_mm);
  const Eigen::Vector4d clip = m * point.homogeneous();
  return {(0.5 + 0.5 * clip.x() / clip.w()) * width, (0.5 - 0.5 * clip.y() / clip.w()) * height};
}

Result<std::unique_ptr<Renderer>> Renderer::create(Context& context) {
  TRY(gl, Gl::load(context));
  auto renderer = std::make_unique<GlRenderer>(*gl);
  TRY_DO(renderer->prepare());
  return renderer;
}

}  // namespace gridshell::render
