#include "render/context/backends.h"

namespace gridshell::render {

Result<std::unique_ptr<Context>> create_window_context() {
  return fail(Fault::io, "this build has no window yet: use --context auto, osmesa or egl");
}

}  // namespace gridshell::render
