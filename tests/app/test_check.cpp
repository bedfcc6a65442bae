// Reports of `gridshell check`, before anything runs.
#include "tests/app/bench.h"

TEST_CASE("check says what a push, steps and loads will do") {
  const Bench bench(small_preset({}));
  const auto said = [&](const std::string& more) {
    REQUIRE(write_file(bench.at / "own.toml", small_preset({.rods = 6, .radius_mm = 70}) + more));
    return bench.good("check own.toml").out;
  };
  CHECK_THAT(said(""), !Contains("  push ") && !Contains("  steps ") && !Contains("  loads "));
  CHECK_THAT(
      said("[indentation]\njoint = [0, -1]\ndepth_mm = 2\nunload = true\n"),
      Contains("push            joint [0, -1] inward by 2 mm, free to move across, and back"));
  CHECK_THAT(said("[[step]]\ndo = \"move\"\nprogress = 1\n[[step]]\ndo = \"push\"\njoint = [0, 0]\n"
                  "depth_mm = 1\n"),
             Contains("steps           2: move, push [0, 0]"));
  CHECK_THAT(said("[rod]\ndensity_kg_m3 = 6450\n[loads]\ngravity_m_s2 = 9.81\n"),
             Contains("loads           gravity 9.81 m/s"));
  // on a net the joint is known before the shell is formed
  CHECK_THAT(bench.good("check s2_indentation").out,
             Contains("push            joint [0, 0] inward by 0.1 of the length scale"));
}

TEST_CASE("check says how far supports move, and where nothing deforms a network") {
  const Bench bench(small_preset({}));
  const auto said = [&](const std::string& footprint) {
    REQUIRE(write_file(bench.at / "own.toml", "[footprint]\n" + footprint));
    return bench.good("check own.toml").out;
  };
  REQUIRE(write_file(bench.at / "cross.json",
                     R"({"rods": [[[-50, 0], [0, 0], [50, 0]], [[0, -50], [0, 0], [0, 50]]]})"));
  const std::string cross = "kind = \"network\"\nfile = \"cross.json\"\n";
  CHECK_THAT(said(cross), Contains("supports        do not move, and nothing loads or pushes"));
  CHECK_THAT(said(cross + "[loads]\npoints = [[1, 0, 0, 0, -0.001]]\n"),
             Contains("supports        do not move\n"));
  CHECK_THAT(said(cross + "[actuation]\nscale = 0.9\n"),
             Contains("supports        move by up to 5 mm\n"));
  CHECK_THAT(said("kind = \"curve\"\nboundary = \"ellipse\"\nhalf_x_mm = 110\n"),
             Contains(", to a circle of 94.5 mm ([actuation] radius_mm)\n"));
}

TEST_CASE("check says how many runs a sweep has, and refuses what it would refuse") {
  const Bench bench(small_preset({}) +
                    "[sweep]\nplot = [\"height_mm\"]\n[sweep.over]\n"
                    "actuation.radius_mm = {from = 44, to = 40, count = 5}\n");
  CHECK_THAT(bench.good("check small.toml").out,
             Contains("sweep           5 runs over actuation.radius_mm; "));
  check_refused({"check", "small.toml", "--set", "sweep.plot=[\"hight_mm\"]"}, bench.at,
                Contains("is no figure of a run") && Contains("height_mm") &&
                    Contains("; there are ") && Contains("energy_mJ"));
}

TEST_CASE("check writes a time of minutes as minutes and seconds") {
  const TemporaryFolder at;
  CHECK_THAT(good("check fig3_hemisphere", at).out,
             Contains(" min to draw the movie") && !Contains("e+0"));
}
