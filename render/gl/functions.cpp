#include "render/gl/functions.h"

#include "render/context/context.h"

namespace gridshell::render {

Result<Gl> Gl::load(const Context& context) {
  Gl gl;
  const char* missing = nullptr;
#define GRIDSHELL_GL_LOAD(type, name)                                 \
  gl.name = reinterpret_cast<type>(context.proc_address("gl" #name)); \
  if (!gl.name && !missing) missing = "gl" #name;
  GRIDSHELL_GL_FUNCTIONS(GRIDSHELL_GL_LOAD)
#undef GRIDSHELL_GL_LOAD
  if (missing)
    return fail(Fault::io, std::string("the ") + context.kind_name() + " context has no function " +
                               missing + "; OpenGL 3.3 core is needed");
  return gl;
}

}  // namespace gridshell::render
