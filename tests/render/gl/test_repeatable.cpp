// Pictures are the same bits from run to run, for any number of rasteriser threads and in either
// off-screen context. Mesa reads its settings once a process, so each picture is drawn by a process
// of its own: this test program, asked for the hidden test below.
#include <unistd.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <string>

#include "tests/render/gl/picture.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

constexpr const char* mark = "picture ";

/// What another process prints after `mark`: a hash, or why there is no context.
std::string drawn_with(const std::string& environment) {
  std::array<char, 4096> self{};
  if (readlink("/proc/self/exe", self.data(), self.size() - 1) < 0) return "no /proc";
  const std::string command = environment + " '" + self.data() + "' '[.picture]' 2>&1";
  std::FILE* pipe = popen(command.c_str(), "r");
  if (!pipe) return "no process";
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output.push_back(char(c));
  const int status = pclose(pipe);
  const std::size_t at = output.find(mark);
  if (status != 0 || at == std::string::npos) return "failed: " + output;
  const std::size_t from = at + std::string(mark).size();
  return output.substr(from, output.find('\n', from) - from);
}

}  // namespace

TEST_CASE("draws for another process", "[.picture]") {
  const char* kind = std::getenv("GRIDSHELL_TEST_CONTEXT");
  const bool egl = kind && std::string(kind) == "egl";
  auto studio = test::studio(egl ? ContextKind::egl : ContextKind::osmesa);
  if (!studio) {
    std::cout << mark << "none: " << studio.error().message << std::endl;
    return;
  }
  const auto run = synthetic::dome(2, 4);
  const Drawing drawing = test::dome_drawing(run);
  std::cout << mark;
  for (const DrawQuality& quality : {DrawQuality{2, true, 1}, DrawQuality{1, true, 6}}) {
    const auto image = value_of(studio->renderer->draw(drawing, {}, quality, 320, 180));
    std::cout << std::hex << test::hash(image) << ' ';
  }
  std::cout << std::endl;
}

TEST_CASE("a picture does not depend on the run or the number of threads",
          "[draw][draw][standard]") {
  const std::string first = drawn_with("LP_NUM_THREADS=2");
  CAPTURE(first);
  REQUIRE(first.rfind("failed", 0) != 0);
  if (first.rfind("none", 0) == 0) {
    WARN("no OSMesa: " << first);
    return;
  }
  REQUIRE(first.size() > 20);
  CHECK(drawn_with("LP_NUM_THREADS=2") == first);
  CHECK(drawn_with("LP_NUM_THREADS=0") == first);
  CHECK(drawn_with("LP_NUM_THREADS=1") == first);
  CHECK(drawn_with("LP_NUM_THREADS=5") == first);
}

TEST_CASE("EGL draws the same picture as OSMesa", "[draw][draw][standard]") {
  const std::string osmesa = drawn_with("GRIDSHELL_TEST_CONTEXT=osmesa");
  // on the same software rasteriser: a graphics card rounds in its own way
  const std::string egl = drawn_with("LIBGL_ALWAYS_SOFTWARE=1 GRIDSHELL_TEST_CONTEXT=egl");
  for (const std::string& drawn : {osmesa, egl})
    if (drawn.rfind("none", 0) == 0) {
      WARN("skipped, a context is missing: " << drawn);
      return;
    }
  CHECK(osmesa.rfind("failed", 0) != 0);
  CHECK(osmesa == egl);
}
