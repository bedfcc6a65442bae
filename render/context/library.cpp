#include "render/context/library.h"

#include <dlfcn.h>

namespace gridshell::render {

Result<Library> Library::open(std::initializer_list<const char*> names) {
  std::string reasons;
  for (const char* name : names) {
    if (void* handle = dlopen(name, RTLD_NOW | RTLD_LOCAL)) return Library(handle);
    if (!reasons.empty()) reasons += "; ";
    const char* reason = dlerror();
    reasons += reason ? reason : name;
  }
  return fail(Fault::io, reasons);
}

void* Library::symbol(const char* name) const { return dlsym(handle_, name); }

}  // namespace gridshell::render
