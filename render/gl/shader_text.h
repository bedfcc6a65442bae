// The GLSL files of shaders/, embedded at build time.
#pragma once

#include <string_view>

namespace gridshell::render {

/// The text of a file of shaders/ ("solid.vert"); empty when there is no such file.
std::string_view shader_text(std::string_view name);

}  // namespace gridshell::render
