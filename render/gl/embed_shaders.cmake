# Writes OUTPUT, a C++ file with the function shader_text() (render/gl/opengl.h), which returns the
# shaders of FOLDER by name.
file(GLOB FILES ${FOLDER}/*.vert ${FOLDER}/*.frag ${FOLDER}/*.glsl)
list(SORT FILES)
set(ENTRIES "")
foreach(FILE IN LISTS FILES)
  get_filename_component(NAME ${FILE} NAME)
  file(READ ${FILE} TEXT)
  string(APPEND ENTRIES "  if (name == \"${NAME}\") return R\"glsl(${TEXT})glsl\";\n")
endforeach()
file(WRITE ${OUTPUT} "// Generated from shaders/ at build time.
#include \"render/gl/opengl.h\"

namespace gridshell::render {

std::string_view shader_text(std::string_view name) {
${ENTRIES}  return {};
}

}  // namespace gridshell::render
")
