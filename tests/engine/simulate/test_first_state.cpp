// The first buckled state: the one of the seed, for every requested mesh, and states that nearly
// coincide with their own images.
#include "engine/simulate/first_state.h"

#include "tests/engine/round_cantilever.h"
#include "tests/engine/simulate/run.h"

using namespace gridshell;

namespace {

Energies first_energies(const std::shared_ptr<const Scene>& scene, int edges) {
  Simulation session = Simulation::open(scene, {.edges_per_segment = {edges}}).value();
  const Watch watch;
  const Report report = session.begin_buckled(0.02, watch).value();
  REQUIRE(report.end == Outcome::reached);
  CHECK(report.certificate.stable());
  return session.energies();
}

/// Nine hinges off the crossings of six rods, whose ends are supports: straightened, the rods are
/// taut in the plane.
preset::NetworkData drawn_bent() {
  preset::NetworkData file;
  file.points = {{-16.9, -23.8, 0}, {-19.4, -0.9, 0}, {-20.7, 19.7, 0},
                 {-3.0, -20.3, 0},  {-1.3, 5.0, 0},   {0.3, 19.5, 0},
                 {19.6, -21.0, 0},  {18.4, -0.6, 0},  {20.7, 19.6, 0}};
  for (const double y : {-20.0, 0.0, 20.0})
    file.points.insert(file.points.end(), {{-35, y, 0}, {36.5, y, 0}});
  for (const double x : {-20.0, 0.0, 20.0})
    file.points.insert(file.points.end(), {{x, -33.5, 0}, {x, 35, 0}});
  for (const int k : {0, 1, 2}) {
    file.rods.push_back({9 + 2 * k, k, 3 + k, 6 + k, 10 + 2 * k});
    file.rods.push_back({15 + 2 * k, 3 * k, 3 * k + 1, 3 * k + 2, 16 + 2 * k});
  }
  for (int joint = 0; joint < 9; ++joint) file.joint_laws.push_back({double(joint), 0, -1});
  return file;
}

}  // namespace

TEST_CASE("the first buckled state is the same one on meshes of every family") {
  // a superellipse whose dome has several equilibria close to one another: converged on each mesh
  // separately, they were 0.6 mm apart in height
  const auto scene = shared_scene(
      superellipse(123.26901689171791, 102.08232879638672, 3.0916969776153564, 0.8719519721716642));
  // errors are of second order, between those of 4 and of 10 edges
  const double coarse = first_energies(scene, 4).total(), fine = first_energies(scene, 10).total();
  for (int edges : {5, 6, 7, 8}) {
    CAPTURE(edges, coarse, fine);
    const double expected =
        fine + (coarse - fine) * (1.0 / (edges * edges) - 0.01) / (1.0 / 16 - 0.01);
    CHECK(first_energies(scene, edges).total() == Approx(expected).epsilon(2e-3));
  }
}

TEST_CASE("rods too thick to buckle while they are soft go to the side of the seed") {
  preset::Preset p = network(cross(50, 50), 4);
  p.actuation.scale = 0.88;
  p.rod.diameter_mm = 2;
  for (const auto seed : {preset::Seed::up, preset::Seed::down}) {
    p.actuation.seed = seed;
    Simulation simulation = value_of(Simulation::open(shared_scene(p), {.edges_per_segment = {4}}));
    REQUIRE(value_of(simulation.begin_buckled(0.02, unwatched)).end == Outcome::reached);
    const double joint = simulation.nodes()(2, 0);
    CHECK((seed == preset::Seed::up ? joint : -joint) > 5);
  }
}

TEST_CASE("a state next to its own image is reported as doubtful", "[standard]") {
  // legs of a sixth of the spacing buckle sideways, each to either side by 0.006 mm
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
  // a push begins on one of the states
  p.accuracy.tolerance = 1e-3;
  p.indentation.depth_mm = 0.05;
  CHECK_THAT(run(p).summary.doubt, Catch::StartsWith("of the actuation: the state lies"));
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

TEST_CASE("of a shell's mirror images it is the seed's, whichever mesh is followed") {
  // rods of nearly one length, which have many buckling modes at once: next to the flat each mesh
  // reaches an image of its own, 9.6 mm apart
  preset::Preset p = superellipse(97.549340278, 104.313228855, 4.331419192, 0.9545160727);
  p.accuracy.tolerance = 3.6e-3;
  p.movie.frames = 2;
  const auto chosen = run(p);
  const auto on = [&](int edges) {
    p.accuracy.edges_per_segment = edges;
    return run(p);
  };
  CHECK(distance(chosen, on(12)) < 2);
  CHECK(distance(chosen, on(24)) < 2);
  // meshes of 5 and 7 edges follow a branch that is unstable on finer ones (test_mesh_policy.cpp)
  CHECK(distance(on(5), on(7)) < 2);
  p.accuracy.edges_per_segment = 0;
  p.actuation.seed_diagonal = preset::SeedDiagonal::y_eq_minus_x;
  CHECK(distance(run(p), chosen) > 5);
}

TEST_CASE("a drawn shell that leaves its symmetry goes to the imperfection's side on all meshes") {
  // the symmetric state is stable on 4 edges per segment and a saddle on finer meshes; where
  // round-off chose its side, meshes of 8 and 16 edges were 1.1 mm apart
  preset::NetworkData file;
  file.points = {
      {-24.0, -40.6, 7.4}, {-1.7, -35.6, 19.1},  {20.6, -30.5, 14.6}, {-30.3, -18.6, 10.6},
      {-8.0, -13.5, 25.3}, {14.3, -8.5, 23.8},   {36.6, -3.4, 6.0},   {-36.6, 3.4, 6.0},
      {-14.3, 8.5, 23.8},  {8.0, 13.5, 25.3},    {30.3, 18.6, 10.6},  {-20.6, 30.5, 14.6},
      {1.7, 35.6, 19.1},   {24.0, 40.6, 7.4},    {-19.6, -56.1, 0.5}, {-41.1, 18.9, -1.7},
      {2.7, -51.0, 10.2},  {-25.0, 46.0, 3.5},   {25.0, -46.0, 3.5},  {-2.7, 51.0, 10.2},
      {41.1, -18.9, -1.7}, {19.6, 56.1, 0.5},    {36.3, -26.9, 1.7},  {-39.7, -44.2, -10.6},
      {52.3, 0.2, -16.2},  {-46.0, -22.2, -9.6}, {46.0, 22.2, -9.6},  {-52.3, -0.2, -16.2},
      {39.7, 44.2, -10.6}, {-36.3, 26.9, 1.7}};
  file.rods = {{14, 0, 3, 7, 15},     {16, 1, 4, 8, 11, 17}, {18, 2, 5, 9, 12, 19},
               {20, 6, 10, 13, 21},   {22, 2, 1, 0, 23},     {24, 6, 5, 4, 3, 25},
               {26, 10, 9, 8, 7, 27}, {28, 13, 12, 11, 29}};
  preset::Preset p = network(file, 4);
  p.imperfection.seed = 8;
  p.movie.frames = 2;
  const auto on = [&](int edges) {
    p.accuracy.edges_per_segment = edges;
    return run(p);
  };
  const auto fine = on(16);
  CHECK(distance(on(8), fine) < 0.5);
  CHECK(distance(on(32), fine) < 0.1);
}

TEST_CASE("a branch whose event coarse meshes have elsewhere is followed on finer ones", "[full]") {
  // at each of two corners rods buckle to either side, all at nearly the same radius: 4 edges have
  // no event, 8 a snap at 0.52, 16 a branch at 0.43
  preset::Preset p = circle(14, 168.50041607, 151.962336432, 2);
  p.ends.kind = preset::EndKind::tangent;
  p.imperfection.seed = 930;
  p.accuracy.tolerance = 1e-2;
  const record::Summary s = run(p).summary;
  CHECK(s.edges_per_segment >= 32);
  CHECK_THAT(s.limit_reason, Catch::Contains("branches at progress 0.40"));
  CHECK(s.doubt.empty());
}

TEST_CASE("a straight piece of a coil winds up to its natural shape, however far that is") {
  preset::Preset p = round_cantilever(300);
  p.rod.curvature_sideways_per_mm = 0.03;
  const auto wound = run_to_end(p);
  CHECK(last_frame(wound).energies.total() < 1e-9);
  // a circle of 33.3 mm
  CHECK(last_frame(wound).nodes.colwise().norm().maxCoeff() < 2 / 0.03 + 0.1);
}

TEST_CASE(
    "rods drawn bent begin in equilibrium, and the side and branch are the seed's on all meshes") {
  const preset::NetworkData file = drawn_bent();
  preset::Preset p = network(file, 8);
  p.rod.shear_GPa = 31;
  p.actuation.scale = 0.9;
  const auto coarse = run_to_end(p);
  p.accuracy.edges_per_segment = 16;
  const auto fine = run_to_end(p);
  p.accuracy.edges_per_segment = 32;
  p.actuation.seed = preset::Seed::down;
  const auto other_side = run_to_end(p);
  for (const auto* one : {&coarse, &fine, &other_side}) {
    const record::Frame& drawn = one->trajectory.frames.front();
    CHECK(drawn.residual_N < 1e-8);
    CHECK(drawn.negative_pivots == 0);
    CHECK(drawn.height_mm == Approx(0).margin(1e-6));
    CHECK(drawn.energies[Term::stretch] > 0.5);
    const auto energy = [](const auto& outcome) { return last_frame(outcome).energies.total(); };
    CHECK(std::abs(energy(*one) - energy(fine)) <
          last_frame(*one).energy_error_mJ + last_frame(fine).energy_error_mJ);
  }
  const auto middle = [](const auto& outcome) { return last_frame(outcome).nodes(2, 4); };
  CHECK(middle(coarse) > 10);
  CHECK(middle(fine) > 10);
  CHECK(middle(other_side) < -10);
}

TEST_CASE("a drawing past the strain limit whose rods stay taut ends the path at that limit") {
  preset::Preset p = network(drawn_bent(), 8);
  p.rod.shear_GPa = 31;
  for (const double scale : {0.99999, 1.001}) {
    p.actuation.scale = scale;
    const auto taut = run(p);
    CHECK(taut.summary.limit == record::Limit::locking);
    CHECK_THAT(taut.summary.limit_reason, Catch::Contains("the rods reached the strain limit"));
    CHECK(last_frame(taut).residual_N < 1e-8);
  }
}
