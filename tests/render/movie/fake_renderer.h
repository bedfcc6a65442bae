// A renderer without OpenGL for tests of what surrounds it: a grey picture with a dot for every
// node, where the camera puts it.
#pragma once

#include <cmath>

#include "render/gl/renderer.h"

namespace gridshell::test {

class FakeRenderer : public render::Renderer {
 public:
  Result<render::Image> draw(const render::Drawing& drawing, const render::Camera& camera,
                             const render::DrawQuality& quality, int width, int height) override {
    ++drawn;
    last_quality = quality;
    if (fail_at == drawn) return fail(Fault::io, "the context was lost");
    render::Image image(width, height);
    for (std::size_t k = 0; k < image.rgba.size(); ++k) image.rgba[k] = k % 4 == 3 ? 255 : 230;
    for (long n = 0; n < drawing.nodes.cols(); ++n) {
      const Eigen::Vector2d p = render::to_pixel(camera, width, height, drawing.nodes.col(n));
      const int x = int(std::floor(p.x())), y = int(std::floor(p.y()));
      if (x < 0 || y < 0 || x >= width || y >= height)
        ++outside;
      else
        image.pixel(x, y)[0] = image.pixel(x, y)[1] = image.pixel(x, y)[2] = 40;
    }
    return image;
  }

  int drawn = 0, outside = 0;  ///< pictures made; nodes that fell outside of them
  int fail_at = -1;            ///< the picture that fails, from 1
  render::DrawQuality last_quality;
};

}  // namespace gridshell::test
