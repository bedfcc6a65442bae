// Helpers of tests of pictures.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "render/gl/context.h"
#include "render/gl/renderer.h"

namespace gridshell::render::test {

/// A context and a renderer in it, which is destroyed before it.
struct Studio {
  std::unique_ptr<Context> context;
  std::unique_ptr<Renderer> renderer;
};

inline Result<Studio> studio(ContextKind kind = ContextKind::automatic) {
  keep_compiled_shaders();
  auto context = Context::create(kind);
  if (!context) return tl::unexpected(context.error());
  auto renderer = Renderer::create(**context);
  if (!renderer) return tl::unexpected(renderer.error());
  return Studio{std::move(*context), std::move(*renderer)};
}

/// The last frame of the made-up actuation, with its ring and cells half opaque.
inline Drawing dome_drawing(const record::Trajectory& run) {
  Drawing drawing;
  drawing.layout = &run.layout;
  drawing.nodes = run.frames.back().nodes;
  drawing.rings.push_back({run.layout.actuated_boundary, 1.6, {0.85f, 0.45f, 0.1f}});
  drawing.cell_colours.assign(run.layout.cells.size(), {0.2f, 0.4f, 0.8f, 0.5f});
  drawing.ground_z_mm = drawing.nodes.row(2).minCoeff() - 3;
  return drawing;
}

}  // namespace gridshell::render::test
