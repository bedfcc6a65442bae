// States that nearly coincide with their own images.
#include <catch2/catch.hpp>

#include "tests/engine/simulate/run.h"

using namespace gridshell;

TEST_CASE("a state next to its own image is told as doubtful", "[standard]") {
  // legs of a sixth of the spacing give way sideways, each to either side by 0.006 mm
  preset::Preset p = circle(5, 18.288596114, 12.958769254);
  p.footprint.spacing_mm = 8.419622877;
  p.actuation.seed = preset::Seed::down;
  p.rod.shear_GPa = 31;
  p.joints.shear_Nmm = 0.065755932;
  for (const double tolerance : {1e-3, 1e-5}) {
    p.accuracy.tolerance = tolerance;
    const record::Summary s = run(p).summary;
    CAPTURE(tolerance, s.limit_reason);
    CHECK_FALSE(s.doubt.empty());
    if (tolerance > 1e-4)
      CHECK_THAT(s.doubt, Catch::Contains("mm from its own image under a symmetry of the shell"));
  }
}

TEST_CASE("symmetric states, and those that are clearly not, are not doubtful") {
  const auto doubt = [](const preset::Preset& p) { return run(p).summary.doubt; };
  CHECK(doubt(on_net()).empty());
  preset::Preset dome = circle(4, 42, 36);
  CHECK(doubt(dome).empty());
  // a load of its own leaves it no symmetry
  dome.loads.points = {{0, 0, 0, 0, -1e-4}};
  CHECK(doubt(dome).empty());
}

TEST_CASE("of a shell's mirror images it is the seed's, whichever mesh leads") {
  // rods of nearly one length, which buckle in many ways at once: next to the flat each leader
  // comes to an image of its own
  preset::Preset p = superellipse(97.549340278, 104.313228855, 4.331419192, 0.9545160727);
  p.accuracy.tolerance = 3.6e-3;
  p.movie.frames = 2;
  const auto led = run(p);
  p.accuracy.leading_edges = 8;
  const auto by_finer = run(p);
  CHECK(distance(led, by_finer) <
        led.summary.error_estimate_mm + by_finer.summary.error_estimate_mm);
  // 9.6 mm apart where the seed is the other
  p.actuation.seed_diagonal = preset::SeedDiagonal::y_eq_minus_x;
  CHECK(distance(run(p), by_finer) > 5);
}

TEST_CASE("a branch on which states are found late is doubtful", "[full]") {
  // at each of two corners rods give way to either side, all at nearly the same radius, which a
  // leader of 4 or 8 edges does not see there
  preset::Preset p = circle(14, 168.50041607, 151.962336432, 2);
  p.ends.kind = preset::EndKind::tangent;
  p.imperfection.seed = 930;
  p.accuracy.tolerance = 1e-2;
  const record::Summary s = run(p).summary;
  CHECK_THAT(s.limit_reason, Catch::Contains("branches at progress 0.4077"));
  CHECK_THAT(s.doubt, Catch::StartsWith("of the branch that leaves the path at progress 0.4077"));
}
