// CPU time of a movie frame in addition to its 3D picture: captions, colour bar, top view, PNG.
// `--json` writes the figures as JSON.
#include <vector>

#include "render/gl/image.h"
#include "render/movie/stage.h"
#include "tests/bench/figures.h"
#include "tests/render/synthetic.h"

using namespace gridshell;

namespace {

// as smooth as a ground and as busy as a net: grey ramps crossed by fine dark lines
render::Image busy_picture(int width, int height) {
  render::Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* p = image.pixel(x, y);
      const bool line = (x + y / 3) % 23 == 0 || (x - y / 2 + height) % 29 == 0;
      p[0] = p[1] = p[2] = static_cast<std::uint8_t>(line ? 50 : 190 + 50 * y / height);
      p[3] = 255;
    }
  return image;
}

}  // namespace

int main(int count, char** arguments) {
  Figures figures(count, arguments);
  const record::Trajectory run = synthetic::dome(25, 16);
  for (const auto& [width, height] : {std::pair{1280, 720}, std::pair{1920, 1080}}) {
    render::MovieStyle style;
    style.size = {width, height};
    style.scale_bar_mm = 20;
    style.title = "Actuation of a circular gridshell";
    const render::Stage stage(run, style);
    const render::Image blank = busy_picture(width, height);
    std::vector<double> overlay, encode;
    for (int k = 0; k < stage.frames(); ++k) {
      render::Image picture = blank;
      const double start = cpu_ms();
      stage.finish(picture, {run.frames[std::size_t(k)], k});
      const double finished = cpu_ms();
      const auto bytes = render::encode_png(picture);
      overlay.push_back(finished - start);
      encode.push_back(cpu_ms() - finished);
      if (!bytes) return 1;
    }
    figures.print("{} x {}: overlay {:.1f} ms, PNG {:.1f} ms CPU (medians of {} frames)\n", width,
                  height, median(overlay), median(encode), overlay.size());
    figures.add(fmt::format("{} x {}, overlay, ms", width, height), median(overlay));
    figures.add(fmt::format("{} x {}, PNG, ms", width, height), median(encode));
  }
}
