#include "engine/study/sweep_study.h"

#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "engine/experiment/point.h"
#include "tests/small_preset.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

preset::Presets small_sweep() {
  return preset::read_preset_text(small_preset({}) +
                                      "[sweep.over]\nactuation.radius_mm = [44, 42, 40]\n"
                                      "rod.diameter_mm = [0.25, 0.3]\n",
                                  "small.toml", "small")
      .value();
}

std::map<std::size_t, record::Figures> figures_with(int jobs) {
  const preset::SweepGrid grid(small_sweep());
  std::map<std::size_t, record::Figures> found;
  Watch watch;
  const auto done = run_points(
      grid, points_of_shard(grid.size(), 1, 1), jobs,
      [&](record::PointResult result) -> Result<void> {
        CHECK(result.outcome == record::PointOutcome::done);
        found[result.point] = std::move(result.figures);
        return {};
      },
      watch);
  REQUIRE(done);
  CHECK(watch.progress() == 1);
  return found;
}

}  // namespace

TEST_CASE("points are the same however many are computed at a time") {
  const auto one = figures_with(1), three = figures_with(3);
  REQUIRE(one.size() == 6);
  CHECK(one == three);
  // and they are those of the values that they bear: thicker rods store more
  const auto bend = [&](std::size_t point) {
    for (const auto& [name, figure] : one.at(point))
      if (name == "energy_bend_mJ") return record::number_of(figure);
    return 0.0;
  };
  CHECK(bend(1) / bend(0) == Approx(std::pow(0.3 / 0.25, 4)).epsilon(5e-3));
  CHECK(bend(4) > bend(2));
}

TEST_CASE("a path that ends early counts as far as it came, whatever the movie's frames") {
  const auto figures = [](int frames) {
    auto preset =
        preset::read_preset_text(small_preset({.rods = 8, .radius_mm = 82, .actuated_mm = 40}) +
                                     "[rod]\ndiameter_mm = 0.5\n",
                                 "thick.toml", "thick")
            .value()
            .base;
    preset.movie.frames = frames;
    Watch watch;
    return experiment::figures_of(preset, watch).value();
  };
  const auto found = figures(2);
  CHECK(found == figures(90));
  const std::map<std::string, record::Figure> named(found.begin(), found.end());
  CHECK(std::get<std::string>(named.at("limit")) == "locking");
  CHECK(record::number_of(named.at("progress")) > 0.5);
  CHECK(record::number_of(named.at("progress")) < 1);
}

TEST_CASE("shards take every point once") {
  std::set<std::size_t> all;
  for (int shard = 1; shard <= 4; ++shard)
    for (const auto point : points_of_shard(10, shard, 4)) CHECK(all.insert(point).second);
  CHECK(all.size() == 10);
  CHECK(points_of_shard(2, 4, 4).empty());
}

TEST_CASE("the numbers of a sweep hang on its values, not on its pictures") {
  const auto presets = small_sweep();
  auto pictures = presets;
  pictures.base.movie.frames = 77;
  pictures.base.sweep.plot = {"total_K"};
  pictures.base.title = "another";
  CHECK(config_of(pictures) == config_of(presets));
  auto values = presets;
  values.base.sweep.over[0].values[0] = "43.5";
  CHECK(config_of(values) != config_of(presets));
}

TEST_CASE("an error of whoever takes the points ends the work") {
  const preset::SweepGrid grid(small_sweep());
  Watch watch;
  int taken = 0;
  const auto done = run_points(
      grid, points_of_shard(grid.size(), 1, 1), 2,
      [&](const record::PointResult&) -> Result<void> {
        if (++taken == 2) return fail(Fault::io, "the disk is full");
        return {};
      },
      watch);
  REQUIRE_FALSE(done);
  CHECK(done.error().message == "the disk is full");
  CHECK(taken == 2);
}
