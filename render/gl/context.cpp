#include "render/gl/context.h"

#include <dlfcn.h>
#include <cstdlib>
#include <filesystem>

#include "render/gl/context_backends.h"

namespace gridshell::render {

Result<SharedLibrary> SharedLibrary::open(std::initializer_list<const char*> names) {
  std::string reasons;
  for (const char* name : names) {
    if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return SharedLibrary(handle);
    if (!reasons.empty()) reasons += "; ";
    const char* reason = dlerror();
    reasons += reason ? reason : name;
  }
  return fail(Fault::io, reasons);
}

void* SharedLibrary::symbol(const char* name) const { return dlsym(handle_, name); }

void keep_compiled_shaders() {
  if (std::getenv("MESA_SHADER_CACHE_DIR")) return;
  const char* cache = std::getenv("XDG_CACHE_HOME");
  const char* home = std::getenv("HOME");
  std::filesystem::path folder;
  if (cache && *cache)
    folder = cache;
  else if (home && *home)
    folder = std::filesystem::path(home) / ".cache";
  else
    return;
  folder /= "gridshell/shaders";
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!error) setenv("MESA_SHADER_CACHE_DIR", folder.c_str(), 0);
}

namespace {

Result<std::unique_ptr<Context>> create_off_screen() {
  auto osmesa = create_osmesa_context();
  if (osmesa) return osmesa;
  auto egl = create_egl_context();
  if (egl) return egl;
  return fail(Fault::io, "no OpenGL context: " + osmesa.error().message + "; " +
                             egl.error().message +
                             "; install libosmesa6 or libegl1 with Mesa's drivers");
}

}  // namespace

Result<std::unique_ptr<Context>> Context::create(ContextKind kind) {
  switch (kind) {
    case ContextKind::osmesa:
      return create_osmesa_context();
    case ContextKind::egl:
      return create_egl_context();
    case ContextKind::window:
      return create_window_context();
    case ContextKind::automatic:
      break;
  }
  return create_off_screen();
}

}  // namespace gridshell::render
