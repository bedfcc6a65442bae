#include <cstdlib>
#include <string>

#include "render/gl/context.h"
#include "render/gl/opengl.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("automatic finds a context off-screen", "[context]") {
  const auto context = value_of(Context::create(ContextKind::automatic));
  const std::string kind = context->kind_name();
  CHECK((kind == "osmesa" || kind == "egl"));
  CHECK(context->proc_address("glDrawElements") != nullptr);
}

TEST_CASE("a context can be made again after one is gone", "[context]") {
  for (int k = 0; k < 3; ++k) {
    const auto context = Context::create(ContextKind::osmesa);
    if (!context) {
      WARN("no OSMesa: " << context.error().message);
      return;
    }
    CHECK(std::string((*context)->kind_name()) == "osmesa");
  }
}

TEST_CASE("compiled shaders are kept in a folder", "[context]") {
  keep_compiled_shaders();
  if (std::getenv("HOME") || std::getenv("XDG_CACHE_HOME"))
    CHECK(std::getenv("MESA_SHADER_CACHE_DIR") != nullptr);
}

TEST_CASE("shaders are part of the program", "[gl]") {
  CHECK(shader_text("ribbon.vert").find("void main()") != std::string_view::npos);
  CHECK(shader_text("no_such.vert").empty());
}

TEST_CASE("a shader that does not compile is an error with the compiler's log", "[gl]") {
  const auto context = Context::create(ContextKind::automatic);
  REQUIRE(context);
  const auto gl = value_of(Gl::load(**context));
  CHECK(Program::create(gl, {"screen.vert"}, {"mean.frag"}));

  CHECK(refusal(Program::create(gl, {"screen.vert"}, {"no_such.frag"}), Fault::io) ==
        "no shader of the name no_such.frag");

  // its functions are in light.glsl
  CHECK_THAT(refusal(Program::create(gl, {"screen.vert"}, {"ribbon.frag"}), Fault::io),
             Catch::Contains("ribbon.frag does not compile"));
}
