#include "render/movie/movie_style.h"

#include <catch2/catch.hpp>

#include "render/movie/stage.h"
#include "tests/render/synthetic.h"

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("laths have the ink of wood unless the user chose a colour, even the usual one") {
  preset::Preset preset;
  preset.rod.width_mm = 6;
  preset.rod.thickness_mm = 2;
  const record::Trajectory run = synthetic::dome(2, 2);
  const auto drawn = [&] { return Stage(run, movie_style(preset)).drawing(run.frames[1]); };
  const Colour usual = Appearance{}.rod;
  CHECK(drawn().rod_colour != usual);
  preset.style.rod_colour = "#292b33";
  CHECK(std::abs(drawn().rod_colour.r - usual.r) < 0.01f);
  MovieStyle style = movie_style(preset);
  style.look.rod = usual;
  CHECK(Stage(run, style).drawing(run.frames[1]).rod_colour == usual);
}
