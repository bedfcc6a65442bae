#include "render/gl/context.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("automatic finds a context off-screen", "[context]") {
  const auto context = Context::create(ContextKind::automatic);
  REQUIRE(context);
  const std::string kind = (*context)->kind_name();
  CHECK((kind == "osmesa" || kind == "egl"));
  CHECK((*context)->proc_address("glDrawElements") != nullptr);
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

TEST_CASE("EGL gives a context without a display", "[context]") {
  const auto context = Context::create(ContextKind::egl);
  if (!context) {
    WARN("no EGL: " << context.error().message);
    return;
  }
  CHECK(std::string((*context)->kind_name()) == "egl");
  CHECK((*context)->proc_address("glDrawElements") != nullptr);
}

TEST_CASE("compiled shaders are kept in a folder", "[context]") {
  keep_compiled_shaders();
  if (std::getenv("HOME") || std::getenv("XDG_CACHE_HOME"))
    CHECK(std::getenv("MESA_SHADER_CACHE_DIR") != nullptr);
}

TEST_CASE("a window needs a display, and says so", "[context]") {
  const auto context = Context::create(ContextKind::window);
  if (context) {
    CHECK(std::string((*context)->kind_name()) == "window");
    CHECK((*context)->proc_address("glDrawElements") != nullptr);
    return;
  }
  CHECK(context.error().fault == Fault::io);
  CHECK(context.error().message.rfind("window: ", 0) == 0);
}
