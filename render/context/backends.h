// One function for each kind of context; Context::create chooses among them.
#pragma once

#include "render/context/context.h"

namespace gridshell::render {

/// Mesa's off-screen software rasteriser; asks for OpenGL 3.3 core.
Result<std::unique_ptr<Context>> create_osmesa_context();

/// EGL without a display (EGL_MESA_platform_surfaceless); asks for OpenGL 3.3 core.
Result<std::unique_ptr<Context>> create_egl_context();

/// A hidden GLFW window; needs a display.
Result<std::unique_ptr<Context>> create_window_context();

}  // namespace gridshell::render
