// Random scenes of every kind: what a run says is true.
#include "engine/study/trust_study.h"

#include <catch2/catch.hpp>
#include <set>

#include "engine/preset/preset_file.h"

using namespace gridshell;

TEST_CASE("random presets are the same from the same seed, of every kind, and read as written") {
  for (const auto& kind : words_of<study::SceneKind>()) {
    std::mt19937 first(7), second(7), third(8);
    const auto text = preset::to_toml(study::random_preset(kind.value, first));
    CAPTURE(kind.word);
    CHECK(text == preset::to_toml(study::random_preset(kind.value, second)));
    CHECK(text != preset::to_toml(study::random_preset(kind.value, third)));
    const auto read = preset::read_preset_text(text, "random.toml", "random");
    if (!read) FAIL(read.error().message);
    CHECK(preset::to_toml(read->base) == text);
  }
}

TEST_CASE("sixty random scenes: none is silently wrong", "[full]") {
  Watch watch;
  const auto scenes = study::trust_study({.scenes = 60, .seed = 20, .seconds = 60}, watch).value();
  REQUIRE(scenes.size() == 60);
  std::set<std::string> kinds;
  int judged = 0;
  for (const auto& scene : scenes) {
    kinds.insert(scene.row.kind);
    judged += scene.row.error > 0;
    CAPTURE(scene.row.scene, scene.row.kind, word_of(scene.row.found), scene.row.error,
            scene.row.estimate, scene.preset.description);
    CHECK_FALSE(record::silently_wrong(scene.row.found));
  }
  CHECK(kinds.size() == std::size_t(study::SceneKind::network));
  CHECK(judged > 30);
}

TEST_CASE("twenty random networks: none is silently wrong", "[full]") {
  Watch watch;
  const auto scenes =
      study::trust_study(
          {.scenes = 20, .kind = study::SceneKind::network, .seed = 1, .seconds = 60}, watch)
          .value();
  REQUIRE(scenes.size() == 20);
  int judged = 0;
  for (const auto& scene : scenes) {
    judged += scene.row.error > 0;
    CHECK(scene.row.kind == "network");
    CAPTURE(scene.row.scene, word_of(scene.row.found), scene.row.error, scene.row.estimate);
    CHECK_FALSE(record::silently_wrong(scene.row.found));
  }
  CHECK(judged > 15);
}
