// The only file that sees <GL/osmesa.h>: it declares the functions of libGL, which must not be
// linked together with libOSMesa.
#include <GL/osmesa.h>

#include <array>

#include "render/gl/context_backends.h"

#define GRIDSHELL_OSMESA(X)             \
  X(create, OSMesaCreateContextAttribs) \
  X(destroy, OSMesaDestroyContext)      \
  X(make_current, OSMesaMakeCurrent)    \
  X(proc_address, OSMesaGetProcAddress)

namespace gridshell::render {
namespace {

GRIDSHELL_FUNCTIONS(Osmesa, GRIDSHELL_OSMESA);

class OsmesaContext final : public Context {
 public:
  OsmesaContext(const Osmesa& osmesa, OSMesaContext context) : osmesa_(osmesa), context_(context) {}
  ~OsmesaContext() override {
    osmesa_.make_current(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
    osmesa_.destroy(context_);
  }
  OsmesaContext(const OsmesaContext&) = delete;
  OsmesaContext& operator=(const OsmesaContext&) = delete;

  bool make_current() {
    return osmesa_.make_current(context_, pixels_.data(), GL_UNSIGNED_BYTE, side, side);
  }
  const char* kind_name() const override { return "osmesa"; }
  void* proc_address(const char* function) const override {
    return reinterpret_cast<void*>(osmesa_.proc_address(function));
  }

 private:
  static constexpr int side = 4;  // of the default framebuffer, which is not used
  Osmesa osmesa_;
  OSMesaContext context_;
  std::array<unsigned char, 4 * side * side> pixels_{};
};

}  // namespace

Result<std::unique_ptr<Context>> create_osmesa_context() {
  auto library = SharedLibrary::open({"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"});
  if (!library) return fail(Fault::io, "OSMesa: " + library.error().message);
  Osmesa osmesa;
  if (!osmesa.load(*library)) return fail(Fault::io, "OSMesa: the library is too old");

  // clang-format off
  const int requested[] = {OSMESA_FORMAT, OSMESA_RGBA, OSMESA_PROFILE, OSMESA_CORE_PROFILE,
                        OSMESA_CONTEXT_MAJOR_VERSION, 3, OSMESA_CONTEXT_MINOR_VERSION, 3, 0};
  // clang-format on
  OSMesaContext raw = osmesa.create(requested, nullptr);
  if (!raw) return fail(Fault::io, "OSMesa: no OpenGL 3.3 core context");
  auto context = std::make_unique<OsmesaContext>(osmesa, raw);
  if (!context->make_current()) return fail(Fault::io, "OSMesa: the context cannot be current");
  return context;
}

}  // namespace gridshell::render
