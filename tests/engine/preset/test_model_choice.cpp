// Which rung a preset runs on, and what is refused with its reason.
#include <catch2/catch.hpp>

#include "engine/preset/consistency.h"
#include "engine/preset/preset_file.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

Preset good(const std::string& text) {
  const auto presets = read_preset_text(text, "good.toml", "good");
  if (!presets) FAIL(presets.error().message);
  return presets->base;
}

std::string fault(const std::string& text) {
  const auto presets = read_preset_text(text, "bad.toml", "bad");
  return presets ? "" : presets.error().message;
}

}  // namespace

TEST_CASE("auto takes the lowest rung that is exact") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, rung] = GENERATE(values<Row>({
      {"", "bend"},
      {"[loads]\nfield_N_per_mm = 1e-6\npoints = [[0, 0, 0, 0, -0.1]]", "bend"},
      {"[rod_v]\ndiffers = true\ndiameter_mm = 0.3", "bend"},
      {"[rod]\nwidth_mm = 0.2\nthickness_mm = 0.2", "bend"},
      {"[rod]\ntwist_rad_per_mm = 0.1", "bend"},
      {"[ends]\nkind = \"tangent\"\n[footprint]\nkind = \"net\"", "bend"},
      {"[rod]\nshear_GPa = 31\n[ends]\nkind = \"clamped\"", "twist"},
      {"[rod]\nshear_GPa = 31\nwidth_mm = 0.2\nthickness_mm = 0.3", "twist"},
      {"[rod]\nshear_GPa = 31\ncurvature_per_mm = 0.001", "twist"},
      {"[rod]\nshear_GPa = 31\ncurvature_sideways_per_mm = 0.001", "twist"},
      {"[rod]\nshear_GPa = 31\n[joints]\ntwist_Nmm = 1", "twist"},
      {"[rod]\nshear_GPa = 31\n[joints]\nshear_Nmm = 1", "twist"},
      {"[rod]\nshear_GPa = 31\n[joints]\nkind = \"spring\"\nstiffness_N_per_mm = 1", "twist"},
      {"[rod]\nshear_GPa = 31\n[accuracy]\nmodel = \"twist\"", "twist"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\ntolerance = 0.05", "net"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\ntolerance = 0.04", "bend"},
      {"[footprint]\nkind = \"net\"\n[net]\nkind = \"cylinder\"\n[accuracy]\ntolerance = 0.05",
       "bend"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\ntolerance = 0.05\n[indentation]\ndepth = 0.1",
       "bend"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\ntolerance = 0.05\n[loads]\nfield_N_per_mm = 1e-6",
       "bend"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\ntolerance = 0.05\n[movie]\ncolour_by = "
       "\"axial_force\"",
       "bend"},
  }));
  CAPTURE(text);
  const Preset preset = good(text);
  CHECK(word_of(rod_model_of(preset)) == rung);
  CHECK(model_reason(preset).starts_with(rung));
}

TEST_CASE("a rung that cannot serve the scene, and physics that lacks something, are refused") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, sentence] = GENERATE(values<Row>({
      {"[rod]\nshear_GPa = 31\n[ends]\nkind = \"clamped\"\n[accuracy]\nmodel = \"bend\"",
       "bad.toml:6:9: [accuracy] model = \"bend\": cannot serve [ends] kind: clamped ends hold the "
       "rods' spin"},
      {"[accuracy]\nmodel = \"net\"\ntolerance = 0.1",
       "bad.toml:2:9: [accuracy] model = \"net\": cannot serve [footprint] kind: a footprint that "
       "was not designed on a net has none"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\nmodel = \"net\"\ntolerance = 0.05\n[movie]\n"
       "colour_by = \"energy\"",
       "bad.toml:4:9: [accuracy] model = \"net\": cannot serve [movie] colour_by: a net's rods "
       "bear "
       "no forces"},
      {"[movie]\ncolour_by = \"deviation\"",
       "bad.toml:2:13: [movie] colour_by = \"deviation\": \"deviation\" is from the net that a "
       "footprint was designed on, must be another, or [footprint] kind = \"net\" or \"blocks\""},
      {"[ends]\nkind = \"clamped\"",
       "bad.toml:2:8: [ends] kind = \"clamped\": twists the rods (clamped ends hold the rods' "
       "spin), and their torsional stiffness is not known: [rod] shear_GPa must be above 0"},
      {"[accuracy]\nmodel = \"twist\"",
       "bad.toml:2:9: [accuracy] model = \"twist\": twists the rods (it is asked for), and their "
       "torsional stiffness is not known: [rod] shear_GPa must be above 0"},
      {"[loads]\ngravity_m_s2 = 9.81",
       "bad.toml:2:16: [loads] gravity_m_s2 = 9.81: gravity needs a mass, [rod] density_kg_m3 must "
       "be above 0"},
      {"[dynamics]\nsnap = true",
       "bad.toml:2:8: [dynamics] snap = true: motion needs a mass, [rod] density_kg_m3 must be "
       "above "
       "0"},
      {"[rod]\nyoung_GPa = -83",
       "bad.toml:2:13: [rod] young_GPa = -83: out of range, must be a number > 0"},
      {"[rod]\nwidth_mm = 0.3",
       "bad.toml:2:12: [rod] width_mm = 0.3: a rectangular section has both, [rod] thickness_mm "
       "must be above 0 too"},
      {"[rod_v]\ndiameter_mm = 0.3",
       "[rod_v] differs = false: the other keys of [rod_v] would count for nothing, must be true"},
      {"[joints]\nkind = \"spring\"\n[rod]\nshear_GPa = 31",
       "bad.toml:2:8: [joints] kind = \"spring\": springs without stiffness hold nothing, [joints] "
       "stiffness_N_per_mm must be above 0"},
      {"[loads]\npoints = [[0, 0, 1]]",
       "bad.toml:2:10: [loads] points = [ [ 0, 0, 1 ] ]: holds a point of 3 coordinates, must be a "
       "list of points [i, j, F_x, F_y, F_z]"},
  }));
  CHECK_THAT(fault(text), Catch::Contains(sentence));
}
