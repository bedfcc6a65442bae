#include "render/draw/renderer.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <optional>

#include "render/context/context.h"
#include "render/draw/colour.h"
#include "render/draw/painter.h"
#include "render/draw/tiles.h"

namespace gridshell::render {
namespace {

constexpr int largest_target = 4096;  // samples a side: a tile and its depth stay near the caches
constexpr int most_samples = 16, most_passes = 4096, largest_picture = 65536;

Result<void> check(const DrawQuality& quality, int width, int height) {
  if (width < 1 || height < 1 || width > largest_picture || height > largest_picture)
    return fail(Fault::bad_input, fmt::format("a picture of {} x {} pixels: each must be 1 to {}",
                                              width, height, largest_picture));
  if (quality.supersample < 1 || quality.supersample > most_samples)
    return fail(Fault::bad_input,
                fmt::format("supersample = {}: 1 to {}", quality.supersample, most_samples));
  if (quality.jittered_passes < 1 || quality.jittered_passes > most_passes)
    return fail(Fault::bad_input,
                fmt::format("jittered_passes = {}: 1 to {}", quality.jittered_passes, most_passes));
  return {};
}

/// From colours times alpha, mixed in linear light, to colours beside alpha.
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
    auto painter = Painter::create(gl_);
    if (!painter) return tl::unexpected(painter.error());
    painter_.emplace(std::move(*painter));
    GLint limit = 0;
    gl_.GetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    target_side_ = std::min(largest_target, int(limit));
    return {};
  }

  Result<Image> draw(const Drawing& drawing, const Camera& camera, const DrawQuality& quality,
                     int width, int height) override {
    if (auto good = check(quality, width, height); !good) return tl::unexpected(good.error());
    const double sample_mm = 2 * camera.half_extent_mm / height / quality.supersample;
    auto scene = make_scene(drawing, camera, sample_mm);
    if (!scene) return tl::unexpected(scene.error());
    while (gl_.GetError() != GL_NO_ERROR) continue;  // not ours

    Image image(width, height);
    const Shot shot{*scene, drawing, camera, quality, width, height};
    if (auto ready = painter_->begin(shot); !ready) return tl::unexpected(ready.error());
    for (const Tile& tile : tiles(width, height, target_side_ / quality.supersample))
      if (auto done = painter_->paint(shot, tile, image); !done)
        return tl::unexpected(done.error());
    if (const GLenum error = gl_.GetError(); error != GL_NO_ERROR)
      return fail(Fault::io, fmt::format("OpenGL failed on a picture of {} x {} pixels, "
                                         "error {:#x}{}",
                                         width, height, error,
                                         error == GL_OUT_OF_MEMORY ? " (out of memory)" : ""));
    if (drawing.background.a < 1) unpremultiply(image);
    return image;
  }

 private:
  Gl gl_;
  std::optional<Painter> painter_;
  int target_side_ = largest_target;
};

}  // namespace

Result<std::unique_ptr<Renderer>> Renderer::create(Context& context) {
  auto gl = Gl::load(context);
  if (!gl) return tl::unexpected(gl.error());
  auto renderer = std::make_unique<GlRenderer>(*gl);
  if (auto ready = renderer->prepare(); !ready) return tl::unexpected(ready.error());
  return renderer;
}

}  // namespace gridshell::render
