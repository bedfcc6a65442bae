// Random scenes of every kind: none of their runs reports a wrong result as right.
#include "tests/bench/trust_study.h"

#include <set>

#include "tests/presets.h"

using namespace gridshell;

TEST_CASE("random presets are the same from the same seed, of every kind, and read as written") {
  for (const auto& kind : words_of<bench::SceneKind>()) {
    std::mt19937 first(7), second(7), third(8);
    const auto text = preset::to_toml(bench::random_preset(kind.value, first));
    CAPTURE(kind.word);
    CHECK(text == preset::to_toml(bench::random_preset(kind.value, second)));
    CHECK(text != preset::to_toml(bench::random_preset(kind.value, third)));
    const auto read = preset::good(text);
    CHECK(preset::to_toml(read.base) == text);
  }
}

TEST_CASE("a branch that meshes of 4 edges alone have is not followed", "[standard]") {
  // at 0.44 of the path meshes finer than 4 edges go over to a branch 0.5 mm lower
  std::mt19937 random(100003u + 32);
  preset::Preset p = bench::random_preset(bench::SceneKind::network, random);
  p.movie.frames = 2;
  const auto height = [&](int edges) {
    Watch watch;
    p.accuracy.edges_per_segment = edges;
    const auto run = simulate::run(p, false, watch);
    REQUIRE(run);
    return run->summary.height_mm;
  };
  const double fine = height(32);
  CHECK(height(0) == Approx(fine).margin(5e-2));
  CHECK(height(4) < fine - 0.3);
}

TEST_CASE("a run is right only if all of its numbers were compared") {
  using bench::TrustClass;
  preset::Preset p = small_shell();
  p.accuracy.tolerance = 1e-2;
  Watch watch;
  const bench::Trial good{.outcome = value_of(simulate::run(p, false, watch)), .refused = {}};
  const auto judged = [](const bench::Trial& requested, const bench::Trial& fine) {
    bench::TrustRow row;
    return bench::judge(requested, fine, requested, row);
  };
  const auto changed = [&](const auto& change) {
    bench::Trial trial = good;
    for (record::Frame& frame : trial.outcome->trajectory.frames.edit()) change(frame);
    return trial;
  };
  CHECK(judged(good, good) == TrustClass::right);
  CHECK(judged(good, {}) == TrustClass::not_compared);
  // no frame of both
  const auto later = changed([](record::Frame& frame) { frame.progress += 0.01; });
  CHECK(judged(good, later) == TrustClass::not_compared);
  const auto locking = changed([](record::Frame& frame) { frame.event = "locking"; });
  CHECK(judged(good, locking) == TrustClass::not_compared);
  const auto unknown = changed([](record::Frame& frame) { frame.nodes(0, 0) = NAN; });
  CHECK(judged(good, unknown) == TrustClass::not_compared);
  CHECK(judged(unknown, good) == TrustClass::inner_unphysical);
  const auto no_energy = changed([](record::Frame& frame) { frame.energies[Term::bend] = NAN; });
  CHECK(judged(no_energy, good) == TrustClass::inner_unphysical);
  CHECK(judged(good, no_energy) == TrustClass::not_compared);
  const auto moved = changed([](record::Frame& frame) { frame.nodes.array() += 5; });
  CHECK(judged(good, moved) == TrustClass::other_branch);
}

TEST_CASE("sixty random scenes and twenty networks: none is silently wrong", "[full]") {
  const bool networks = GENERATE(false, true);
  bench::TrustOptions options{
      .scenes = networks ? 20 : 60, .seed = networks ? 1 : 20, .seconds = 60};
  if (networks) options.kind = bench::SceneKind::network;
  Watch watch;
  const auto scenes = value_of(bench::trust_study(options, watch));
  REQUIRE(int(scenes.size()) == options.scenes);
  std::set<std::string> kinds;
  int judged = 0, not_compared = 0;
  for (const auto& scene : scenes) {
    kinds.insert(scene.row.kind);
    judged += scene.row.error > 0;
    CAPTURE(scene.row.scene, scene.row.kind, word_of(scene.row.found), scene.row.error,
            scene.row.estimate, scene.preset.description);
    CHECK_FALSE(bench::silently_wrong(scene.row.found));
    not_compared += scene.row.found == bench::TrustClass::not_compared;
  }
  CHECK(not_compared <= 2);
  CHECK(kinds.size() == (networks ? 1 : std::size_t(bench::SceneKind::network)));
  CHECK(judged > (networks ? 15 : 30));
}
