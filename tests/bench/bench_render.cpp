// CPU time of a frame by quality, off-screen: medians in ms, their ratios to a plain frame, and the
// transfer back from the graphics side. Usage: bench_render [auto|osmesa|egl] [frames] [--json]
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/gl/context.h"
#include "render/gl/opengl.h"
#include "render/gl/renderer.h"
#include "tests/bench/figures.h"
#include "tests/render/gl/square_shell.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

struct Case {
  const char* name;
  DrawQuality quality;
  std::vector<double> ms = {};
  std::unique_ptr<Renderer> renderer = nullptr;  // one per case, as each movie has its own
};

void measure(Context& context, int width, int height, int frames, Figures& figures) {
  const auto shell = test::square_shell(17, 9);
  const Drawing drawing = test::square_drawing(shell);
  Camera camera;
  camera.target = {0, 0, 15};
  camera.half_extent_mm = 105;
  Case cases[] = {{"plain", {1, false, 1}},
                  {"2x2", {2, false, 1}},
                  {"2x2 + shadow", {2, true, 1}},
                  {"movie", {1, true, 1}}};
  for (Case& c : cases) c.renderer = Renderer::create(context).value();
  // alternating, so that other load of the machine affects all of them equally
  for (int frame = -1; frame < frames; ++frame)
    for (Case& c : cases) {
      camera.azimuth_deg = 30 + 0.5 * frame;
      const double before = cpu_ms();
      c.renderer->draw(drawing, camera, c.quality, width, height).value();
      if (frame >= 0) c.ms.push_back(cpu_ms() - before);
    }
  const double plain = median(cases[0].ms);
  for (Case& c : cases) {
    figures.print("{:>5} x {:<5} {:<14} {:8.1f} ms {:6.2f} of plain\n", width, height, c.name,
                  median(c.ms), median(c.ms) / plain);
    figures.add(fmt::format("{} x {}, {}, ms", width, height, c.name), median(c.ms));
  }
}

/// The transfer of a drawn frame into memory alone.
void measure_read_back(Context& context, int width, int height, int frames, Figures& figures) {
  const Gl gl = Gl::load(context).value();
  Target target(gl, Target::Depth::none);
  Image image(width, height);
  std::vector<double> ms;
  for (int frame = 0; frame < frames; ++frame) {
    if (!target.bind(width, height, GL_SRGB8_ALPHA8)) std::exit(1);
    gl.ClearColor(0.1f * float(frame % 10), 0.5f, 0.5f, 1);
    gl.Clear(GL_COLOR_BUFFER_BIT);
    gl.Finish();
    const double before = cpu_ms();
    gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
    ms.push_back(cpu_ms() - before);
  }
  figures.print("{:>5} x {:<5} {:<14} {:8.1f} ms\n", width, height, "read-back", median(ms));
}

}  // namespace

int main(int count, char** arguments) {
  Figures figures(count, arguments);
  const auto& words = figures.words();
  const std::string kind = words.empty() ? "auto" : words[0];
  const int frames = words.size() > 1 ? std::max(1, std::atoi(words[1].c_str())) : 15;
  keep_compiled_shaders();
  const auto context = Context::create(kind == "egl"      ? ContextKind::egl
                                       : kind == "osmesa" ? ContextKind::osmesa
                                                          : ContextKind::automatic)
                           .value();
  figures.print("{}: 4896 rod segments, 289 joints, 256 cells; median CPU time of {} frames\n",
                context->kind_name(), frames);
  measure(*context, 1280, 720, frames, figures);
  measure_read_back(*context, 1280, 720, frames, figures);
  measure(*context, 1920, 1080, std::max(1, frames / 3), figures);
}
