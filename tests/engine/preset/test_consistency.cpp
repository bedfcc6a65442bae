// The rod model of a preset, values that contradict each other, and keys that a kind does not use:
// these are refused if they are set, and left out if a preset is written.
#include "engine/preset/consistency.h"
#include "tests/presets.h"

using namespace gridshell;
using namespace gridshell::preset;

TEST_CASE("auto takes the simplest model that is exact") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, rod_model] = GENERATE(values<Row>({
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
  const Preset preset = good(text).base;
  CHECK(word_of(rod_model_of(preset)) == rod_model);
  CHECK(model_reason(preset).starts_with(rod_model));
}

TEST_CASE(
    "a rod model that cannot serve the scene, and physics that lacks something, are refused") {
  using Row = std::pair<std::string, std::string>;
  const auto [text, sentence] = GENERATE(values<Row>({
      {"[rod]\nshear_GPa = 31\n[ends]\nkind = \"clamped\"\n[accuracy]\nmodel = \"bend\"",
       "bad.toml:6:9: [accuracy] model: got \"bend\": it cannot compute [ends] kind: clamped ends "
       "prescribe the rods' twist angle"},
      {"[accuracy]\nmodel = \"net\"\ntolerance = 0.1",
       "bad.toml:2:9: [accuracy] model: got \"net\": it cannot compute [footprint] kind: a "
       "footprint that was not designed on a net has none"},
      {"[footprint]\nkind = \"net\"\n[accuracy]\nmodel = \"net\"\ntolerance = 0.05\n[movie]\n"
       "colour_by = \"energy\"",
       "bad.toml:4:9: [accuracy] model: got \"net\": it cannot compute [movie] colour_by: a net's "
       "rods bear no forces"},
      {"[movie]\ncolour_by = \"deviation\"",
       "bad.toml:2:13: [movie] colour_by: got \"deviation\" (\"deviation\" is measured from the "
       "net of a footprint), expected another value, or [footprint] kind = \"net\" or \"blocks\""},
      {"[ends]\nkind = \"clamped\"",
       "bad.toml:2:8: [ends] kind: got \"clamped\" (the rods twist: clamped ends prescribe the "
       "rods' twist angle; they have no torsional stiffness), expected [rod] shear_GPa or GJ_Nmm2 "
       "above 0"},
      {"[accuracy]\nmodel = \"twist\"",
       "bad.toml:2:9: [accuracy] model: got \"twist\" (the rods twist: the model is given; they "
       "have no torsional stiffness), expected [rod] shear_GPa or GJ_Nmm2 above 0"},
      {"[loads]\ngravity_m_s2 = 9.81",
       "bad.toml:2:16: [loads] gravity_m_s2: got 9.81 (gravity needs a mass), expected [rod] "
       "density_kg_m3 above 0"},
      {"[dynamics]\nsnap = true",
       "bad.toml:2:8: [dynamics] snap: got true (motion needs a mass), expected [rod] "
       "density_kg_m3 above 0"},
      {"[rod]\nyoung_GPa = -83",
       "bad.toml:2:13: [rod] young_GPa: got -83 (out of range), expected a number > 0"},
      {"[rod]\nwidth_mm = 0.3",
       "bad.toml:2:12: [rod] width_mm: got 0.3 (a rectangular section has both), expected [rod] "
       "thickness_mm above 0 too"},
      {"[rod_v]\ndiameter_mm = 0.3",
       "[rod_v] differs: got false (the other keys of [rod_v] would have no effect), expected "
       "true"},
      {"[joints]\nkind = \"spring\"\n[rod]\nshear_GPa = 31",
       "bad.toml:2:8: [joints] kind: got \"spring\" (springs without stiffness connect nothing), "
       "expected [joints] stiffness_N_per_mm above 0"},
      {"[loads]\npoints = [[0, 0, 1]]",
       "bad.toml:2:10: [loads] points: got [ [ 0, 0, 1 ] ] (a point of 3 coordinates), expected a "
       "list of points [i, j, F_x, F_y, F_z]"},
  }));
  CHECK_THAT(errors_of(text), Catch::Contains(sentence));
}

TEST_CASE("a circle is as large as its radius says, or its longest leg, and not both") {
  const auto presets =
      good("[footprint]\nrods = 10\nlongest_leg = 1.5\n[actuation]\nratio = 0.75\n");
  // R_o = d (L_d + (n - 1)/2)
  CHECK(presets.base.original_radius_mm() == Approx(120));
  CHECK(presets.base.actuated_radius_mm() == Approx(90));
  CHECK_THAT(to_toml(presets), !Catch::Contains("radius_mm = 126"));
  CHECK_THAT(errors_of("[footprint]\nlongest_leg = 1.5\nradius_mm = 90\n"),
             Catch::StartsWith("bad.toml:3:13: [footprint] radius_mm") &&
                 Catch::Contains("[footprint] longest_leg replaces it"));
  CHECK_THAT(errors_of("[actuation]\nratio = 0.5\nradius_mm = 90\n"),
             Catch::Contains("[actuation] ratio replaces it"));
  CHECK_THAT(errors_of("[footprint]\nkind = \"net\"\nlongest_leg = 1.5\n"),
             Catch::Contains("does not use it, only \"circle\""));
  CHECK_THAT(errors_of("[footprint]\nlongest_leg = -1\n"), Catch::Contains("longest_leg: got -1"));
  CHECK_THAT(errors_of("[actuation]\nratio = 1.5\n"), Catch::Contains("from 0 to 1"));
  CHECK_THAT(errors_of("[footprint]\nrods = 4\nlongest_leg = 1.0\n"),
             Catch::Contains("expected at most R_o = 50 by [footprint] longest_leg"));
}

TEST_CASE("a key that the kind does not use is refused with its position and the reason") {
  CHECK(errors_of("[footprint]\nkind = \"net\"\n[net]\nwaist = 0.4\n") ==
        "bad.toml:4:9: [net] waist = 0.4 has no effect, leave it out: [net] kind = \"sphere\" does "
        "not use it, only \"spool\" or \"beltrami\"");
  CHECK(errors_of("[net]\nradius_mm = 80\n") ==
        "bad.toml:2:13: [net] radius_mm = 80.0 has no effect, leave it out: [footprint] kind = "
        "\"circle\" does not use it, only \"net\"");
  CHECK_THAT(errors_of("[footprint]\nkind = \"curve\"\nradius_mm = 90.0\nboundary = \"ellipse\"\n"
                       "[actuation]\nscale = 0.8\n"),
             Catch::StartsWith("bad.toml:3:13: [footprint] radius_mm") &&
                 Catch::Contains("[footprint] boundary = \"ellipse\" does not use it"));
  CHECK_THAT(errors_of("[indentation]\ndirection = \"outward\"\n"),
             Catch::Contains("nothing is pushed"));
  CHECK_THAT(errors_of("[dynamics]\nstep_s = 0.001\n"), Catch::Contains("no snap is followed"));
  CHECK_THAT(errors_of("[rod]\nwidth_mm = 1.0\nthickness_mm = 0.5\nshear_GPa = 31.0\n"
                       "diameter_mm = 0.3\n"),
             Catch::Contains("make the rods rectangular"));
  CHECK_THAT(errors_of("[footprint]\nkind = \"blocks\"\n[[block]]\nname = \"a\"\n[[block]]\n"
                       "name = \"b\"\nwaist = 0.4\n"),
             Catch::Contains("bad.toml:7:9: [[block]] 2 waist") &&
                 Catch::Contains("[[block]] 2 kind = \"sphere\" does not use it"));
}

TEST_CASE("the error of a drawing or a load in the wrong key names the right one") {
  const std::string curve = "[footprint]\nkind = \"curve\"\n";
  CHECK_THAT(errors_of(curve + "boundary = \"plan.dxf\"\n"),
             Catch::Contains("file = \"plan.dxf\" with boundary = \"file\""));
  CHECK_THAT(errors_of(curve + "boundary = \"spline\"\npoints_mm = \"plan.svg\"\n"),
             Catch::Contains("file = \"plan.svg\" with boundary = \"file\""));
  CHECK_THAT(
      errors_of("[footprint]\nkind = \"network\"\nfile = { points_mm = [[0, 0, 0], [9, 0, 0], "
                "[9, 9, 0]], rods = [[0, 1, 2, 0]] }\n"),
      Catch::Contains("one closed rod (if it is an outline: kind = \"curve\""));
  CHECK_THAT(errors_of("[loads]\nsnow_N_m2 = 100.0\n"), Catch::Contains("such as snow = 1.0"));
}

TEST_CASE("a key of pictures that another key replaces is an error") {
  CHECK_THAT(errors_of("[movie]\nview = \"top\"\nazimuth_deg = 10.0\n"),
             Catch::Contains("[movie] view replaces it"));
  CHECK_THAT(errors_of("[page]\nphoto = \"a.png\"\n"), Catch::Contains("no page is made"));
  CHECK(errors_of("[movie]\nazimuth_deg = 10.0\n", {{"--set", "movie.view", "top"}}) == "none");
}

TEST_CASE("a default that is written out is no error, nor is what another kind uses") {
  CHECK(errors_of("[net]\nwaist = 0.5\n") == "none");
  CHECK(errors_of("[footprint]\nkind = \"net\"\n[net]\nkind = \"spool\"\nwaist = 0.4\n") == "none");
  CHECK(errors_of("[footprint]\nkind = \"curve\"\nradius_mm = 90.0\n[actuation]\nscale = 0.8\n") ==
        "none");
}

TEST_CASE("one error is reported once: what a wrong kind would leave idle is not") {
  const auto errors =
      errors_of("[footprint]\nkind = \"net\"\n[net]\nkind = \"spol\"\nwaist = 0.4\n");
  CHECK_THAT(errors, Catch::Contains("did you mean 'spool'") && !Catch::Contains("waist"));
}

TEST_CASE(
    "a case or --set that changes a kind leaves unused keys of the file below without an error") {
  const std::string spool = "[footprint]\nkind = \"net\"\n[net]\nkind = \"spool\"\nwaist = 0.4\n";
  CHECK(errors_of(spool, {{"--set", "net.kind", "sphere"}}) == "none");
  CHECK_THAT(errors_of(spool, {{"--set", "net.cut_height", "0.3"}}),
             Catch::StartsWith("--set: [net] cut_height"));
  CHECK(errors_of(spool + "[[case]]\nname = \"a\"\nnet.kind = \"sphere\"\n") == "none");
  CHECK_THAT(errors_of(spool + "[[case]]\nname = \"a\"\nnet.cut_height = 0.3\n"),
             Catch::StartsWith("bad.toml:8:18: [net] cut_height"));
}

TEST_CASE("a key of the base may be for one of the cases") {
  const std::string base = "[footprint]\nkind = \"net\"\n[net]\nwaist = 0.4\n";
  const std::string cap = "[[case]]\nname = \"cap\"\n";
  const std::string saddle = "[[case]]\nname = \"saddle\"\nnet.kind = \"spool\"\n";
  CHECK(errors_of(base + cap + saddle) == "none");
  CHECK_THAT(errors_of(base + cap), Catch::Contains("[net] waist = 0.4 has no effect"));
}

TEST_CASE("a preset is written without the keys that count for nothing, and reads back") {
  const std::string text =
      "[footprint]\nkind = \"net\"\n[net]\nwaist = 0.4\n[[case]]\nname = \"cap\"\n"
      "[[case]]\nname = \"saddle\"\nnet.kind = \"spool\"\n";
  const auto presets = good(text);
  const auto written = to_toml(presets);
  CHECK_THAT(written, Catch::Contains("net.waist = 0.4") && !Catch::Contains("\nwaist") &&
                          !Catch::Contains("[blocks]") && !Catch::Contains("curve_u"));
  const auto again = good(written);
  CHECK(to_toml(again) == written);
  CHECK(again.cases[1].preset.net.waist == 0.4);
}

TEST_CASE("values above those of any material, and joints larger than their distance, are noted") {
  const auto notes = [](const std::string& text) { return good(text).notes; };
  CHECK(notes("").empty());
  const auto stiff = notes("[rod]\nyoung_GPa = 83000.0\n");
  REQUIRE(stiff.size() == 1);
  CHECK(stiff[0] == "[rod] young_GPa = 83000: stiffer than any material, given in MPa? 83 GPa");
  CHECK(notes("[rod]\ndensity_kg_m3 = 78000.0\n").size() == 1);
  const auto large = notes(
      "[footprint]\nspacing_mm = 2.0\nradius_mm = 12.6\n"
      "[actuation]\nradius_mm = 9.45\n");
  REQUIRE(large.size() == 1);
  CHECK_THAT(large[0], Catch::StartsWith("[joints] diameter_mm = 3: joints are larger than their"));
}

TEST_CASE("utilisation needs a strength, which is said once") {
  CHECK_THAT(errors_of("[limits]\nmax_utilisation = 0.8\n"),
             Catch::Contains("[rod] strength_MPa or yield_strain above 0"));
  CHECK_THAT(errors_of("[movie]\ncolour_by = \"utilisation\"\n"),
             Catch::Contains("[rod] strength_MPa or yield_strain above 0"));
  CHECK_THAT(errors_of("[rod]\nstrength_MPa = 500.0\nyield_strain = 0.01\n"),
             Catch::Contains("expected 0 for one of both"));
  CHECK_THAT(errors_of("[rod]\nstrength_MPa = 500.0\n[rod_v]\ndiffers = true\n[limits]\n"
                       "max_utilisation = 0.8\n"),
             Catch::Contains("and of [rod_v] where it differs"));
  CHECK_THAT(errors_of("[rod]\nstrength_MPa = 500.0\n[rod_v]\ndiffers = true\n[movie]\n"
                       "colour_by = \"utilisation\"\n"),
             Catch::Contains("and of [rod_v] where it differs"));
}

TEST_CASE("rods of any table and section leave room between neighbours") {
  for (const char* one : {"[rod_v]\ndiffers = true\ndiameter_mm = 30\n",
                          "[rod]\nwidth_mm = 30\nthickness_mm = 1\nshear_GPa = 30\n"})
    CHECK_THAT(errors_of(one), Catch::Contains("neighbouring rods would touch"));
  CHECK(errors_of("[rod]\nyield_strain = 5\n") != "none");
}

TEST_CASE("pictures of a push, or of none, do not request the other's") {
  CHECK_THAT(errors_of("[movie]\ncolour_by = \"displacement\"\n"),
             Catch::Contains("over the depth of a push"));
  const std::string push = "[indentation]\njoint = [0, 0]\ndepth_mm = 1\n";
  CHECK(errors_of("[movie]\ncolour_by = \"displacement\"\n" + push) == "none");
  CHECK_THAT(errors_of("[figure]\nradii_mm = [126]\n" + push),
             Catch::Contains("stills of a push or of steps"));
}

TEST_CASE("further views are as steep as the first one may be") {
  CHECK_THAT(errors_of("[movie]\nviews = [[0, 90], [30, -90.5]]\n"),
             Catch::Contains("[movie] views") && Catch::Contains("between -90 and 90"));
  CHECK(errors_of("[movie]\nviews = [[0, 90], [30, -90]]\n") == "none");
}

TEST_CASE("a figure with more pixels than a picture can have is refused") {
  CHECK_THAT(errors_of("[figure]\nwidth_mm = 3000\n"),
             Catch::Contains("[figure] width_mm") && Catch::Contains("35433 pixels"));
  CHECK(errors_of("[figure]\nwidth_mm = 3000\ndpi = 250\n") == "none");
}
