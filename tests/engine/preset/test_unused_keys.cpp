// Keys that a kind does not use are refused where they are set, and left out where a preset is
// written.
#include <catch2/catch.hpp>

#include "engine/preset/consistency.h"
#include "engine/preset/preset_file.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::preset;

namespace {

std::string faults_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  const auto presets = read_preset_text(text, "bad.toml", "bad", overrides);
  return presets ? "" : presets.error().message;
}

}  // namespace

TEST_CASE("a circle is as large as its radius says, or its longest leg, and not both") {
  const auto presets = value_of(read_preset_text(
      "[footprint]\nrods = 10\nlongest_leg = 1.5\n[actuation]\nratio = 0.75\n", "leg.toml", "leg"));
  // R_o = d (L_d + (n - 1)/2)
  CHECK(presets.base.original_radius_mm() == Approx(120));
  CHECK(presets.base.actuated_radius_mm() == Approx(90));
  CHECK_THAT(to_toml(presets), !Catch::Contains("radius_mm = 126"));
  CHECK_THAT(faults_of("[footprint]\nlongest_leg = 1.5\nradius_mm = 90\n"),
             Catch::StartsWith("bad.toml:3:13: [footprint] radius_mm = 90.0: ") &&
                 Catch::Contains("[footprint] longest_leg takes its place"));
  CHECK_THAT(faults_of("[actuation]\nratio = 0.5\nradius_mm = 90\n"),
             Catch::Contains("[actuation] ratio takes its place"));
  CHECK_THAT(faults_of("[footprint]\nkind = \"net\"\nlongest_leg = 1.5\n"),
             Catch::Contains("does not use it, only \"circle\""));
  CHECK_THAT(faults_of("[footprint]\nlongest_leg = -1\n"), Catch::Contains("longest_leg = -1"));
  CHECK_THAT(faults_of("[actuation]\nratio = 1.5\n"), Catch::Contains("from 0 to 1"));
  CHECK_THAT(faults_of("[footprint]\nrods = 4\nlongest_leg = 1.0\n"),
             Catch::Contains("must be at most R_o = 50 by [footprint] longest_leg"));
}

TEST_CASE("a key that the kind does not use is refused with its place and the reason") {
  CHECK(faults_of("[footprint]\nkind = \"net\"\n[net]\nwaist = 0.4\n") ==
        "bad.toml:4:9: [net] waist = 0.4: counts for nothing here, must be left out: [net] kind = "
        "\"sphere\" does not use it, only \"spool\" or \"beltrami\"");
  CHECK(faults_of("[net]\nradius_mm = 80\n") ==
        "bad.toml:2:13: [net] radius_mm = 80.0: counts for nothing here, must be left out: "
        "[footprint] kind = \"circle\" does not use it, only \"net\"");
  CHECK_THAT(faults_of("[footprint]\nkind = \"curve\"\nradius_mm = 90.0\nboundary = \"ellipse\"\n"
                       "[actuation]\nscale = 0.8\n"),
             Catch::StartsWith("bad.toml:3:13: [footprint] radius_mm = 90.0: ") &&
                 Catch::Contains("[footprint] boundary = \"ellipse\" does not use it"));
  CHECK_THAT(faults_of("[indentation]\ndirection = \"outward\"\n"),
             Catch::Contains("nothing is pushed"));
  CHECK_THAT(faults_of("[dynamics]\nstep_s = 0.001\n"), Catch::Contains("no snap is followed"));
  CHECK_THAT(faults_of("[rod]\nwidth_mm = 1.0\nthickness_mm = 0.5\nshear_GPa = 31.0\n"
                       "diameter_mm = 0.3\n"),
             Catch::Contains("make the rods rectangular"));
  CHECK_THAT(faults_of("[footprint]\nkind = \"blocks\"\n[[block]]\nname = \"a\"\n[[block]]\n"
                       "name = \"b\"\nwaist = 0.4\n"),
             Catch::Contains("bad.toml:7:9: [[block]] 2 waist = 0.4: ") &&
                 Catch::Contains("[[block]] 2 kind = \"sphere\" does not use it"));
}

TEST_CASE("pictures have keys that others put out of use") {
  CHECK_THAT(faults_of("[movie]\nview = \"top\"\nazimuth_deg = 10.0\n"),
             Catch::Contains("[movie] view takes its place"));
  CHECK_THAT(faults_of("[page]\nphoto = \"a.png\"\n"), Catch::Contains("no page is made"));
  CHECK(faults_of("[movie]\nazimuth_deg = 10.0\n", {{"--set", "movie.view", "top"}}) == "");
}

TEST_CASE("a default that is written out is no fault, nor is what another kind uses") {
  CHECK(faults_of("[net]\nwaist = 0.5\n") == "");
  CHECK(faults_of("[footprint]\nkind = \"net\"\n[net]\nkind = \"spool\"\nwaist = 0.4\n") == "");
  CHECK(faults_of("[footprint]\nkind = \"curve\"\nradius_mm = 90.0\n[actuation]\nscale = 0.8\n") ==
        "");
}

TEST_CASE("one fault is told once: what a wrong kind would leave idle is not") {
  const auto faults =
      faults_of("[footprint]\nkind = \"net\"\n[net]\nkind = \"spol\"\nwaist = 0.4\n");
  CHECK_THAT(faults, Catch::Contains("did you mean 'spool'") && !Catch::Contains("waist"));
}

TEST_CASE("what a case or --set lays over a kind leaves the keys below in peace") {
  const std::string spool = "[footprint]\nkind = \"net\"\n[net]\nkind = \"spool\"\nwaist = 0.4\n";
  CHECK(faults_of(spool, {{"--set", "net.kind", "sphere"}}) == "");
  CHECK_THAT(faults_of(spool, {{"--set", "net.cut_height", "0.3"}}),
             Catch::StartsWith("--set: [net] cut_height = 0.3: "));
  CHECK(faults_of(spool + "[[case]]\nname = \"a\"\nnet.kind = \"sphere\"\n") == "");
  CHECK_THAT(faults_of(spool + "[[case]]\nname = \"a\"\nnet.cut_height = 0.3\n"),
             Catch::StartsWith("bad.toml:8:18: [net] cut_height = 0.3: "));
}

TEST_CASE("a key of the base may be for one of the cases") {
  const std::string base = "[footprint]\nkind = \"net\"\n[net]\nwaist = 0.4\n";
  const std::string cap = "[[case]]\nname = \"cap\"\n";
  const std::string saddle = "[[case]]\nname = \"saddle\"\nnet.kind = \"spool\"\n";
  CHECK(faults_of(base + cap + saddle) == "");
  CHECK_THAT(faults_of(base + cap), Catch::Contains("[net] waist = 0.4: counts for nothing"));
}

TEST_CASE("a preset is written without the keys that count for nothing, and reads back") {
  const std::string text =
      "[footprint]\nkind = \"net\"\n[net]\nwaist = 0.4\n[[case]]\nname = \"cap\"\n"
      "[[case]]\nname = \"saddle\"\nnet.kind = \"spool\"\n";
  const auto presets = value_of(read_preset_text(text, "a.toml", "a"));
  const auto written = to_toml(presets);
  CHECK_THAT(written, Catch::Contains("net.waist = 0.4") && !Catch::Contains("\nwaist") &&
                          !Catch::Contains("[blocks]") && !Catch::Contains("curve_u"));
  const auto again = read_preset_text(written, "b.toml", "a");
  if (!again) FAIL(again.error().message);
  CHECK(to_toml(*again) == written);
  CHECK(again->cases[1].preset.net.waist == 0.4);
}

TEST_CASE("utilisation needs a strength, which is said once") {
  CHECK_THAT(faults_of("[limits]\nmax_utilisation = 0.8\n"),
             Catch::Contains("[rod] strength_MPa or yield_strain must be above 0"));
  CHECK_THAT(faults_of("[movie]\ncolour_by = \"utilisation\"\n"),
             Catch::Contains("[rod] strength_MPa or yield_strain above 0"));
  CHECK_THAT(faults_of("[rod]\nstrength_MPa = 500.0\nyield_strain = 0.01\n"),
             Catch::Contains("one of both must be 0"));
  CHECK_THAT(faults_of("[rod]\nstrength_MPa = 500.0\n[rod_v]\ndiffers = true\n[limits]\n"
                       "max_utilisation = 0.8\n"),
             Catch::Contains("those of [rod_v] too"));
}
