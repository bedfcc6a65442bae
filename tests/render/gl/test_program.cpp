#include "render/gl/shader_program.h"

#include <catch2/catch.hpp>

#include "render/gl/context.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("shaders are part of the program", "[gl]") {
  CHECK(shader_text("ribbon.vert").find("void main()") != std::string_view::npos);
  CHECK(shader_text("no_such.vert").empty());
}

TEST_CASE("a shader that does not compile is an error with the compiler's log", "[gl]") {
  const auto context = Context::create(ContextKind::automatic);
  REQUIRE(context);
  const auto gl = Gl::load(**context);
  REQUIRE(gl);
  CHECK(Program::create(*gl, {"screen.vert"}, {"mean.frag"}));

  const auto missing = Program::create(*gl, {"screen.vert"}, {"no_such.frag"});
  REQUIRE_FALSE(missing);
  CHECK(missing.error().message == "no shader of the name no_such.frag");

  // its functions are in light.glsl
  const auto wrong = Program::create(*gl, {"screen.vert"}, {"ribbon.frag"});
  REQUIRE_FALSE(wrong);
  CHECK(wrong.error().fault == Fault::io);
  CHECK_THAT(wrong.error().message, Catch::Matchers::Contains("ribbon.frag does not compile"));
}
