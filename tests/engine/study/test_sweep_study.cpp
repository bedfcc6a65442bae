#include "engine/study/sweep_study.h"

#include <map>
#include <set>

#include "tests/presets.h"
#include "tests/small_preset.h"

using namespace gridshell;
using namespace gridshell::study;

namespace {

preset::Presets small_sweep() {
  return preset::good(small_preset({}) +
                      "[sweep.over]\nactuation.radius_mm = [44, 42, 40]\n"
                      "rod.diameter_mm = [0.25, 0.3]\n");
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
  // the results belong to the values of their points: thicker rods store more energy
  const auto bend = [&](std::size_t point) {
    for (const auto& [name, figure] : one.at(point))
      if (name == "energy_bend_mJ") return record::number_of(figure);
    return 0.0;
  };
  CHECK(bend(1) / bend(0) == Approx(std::pow(0.3 / 0.25, 4)).epsilon(5e-3));
  CHECK(bend(4) > bend(2));
}

TEST_CASE(
    "a point that looks for states says how many of each class, the same whatever the threads") {
  const auto presets = preset::good(
      "[footprint]\nrods = 4\n[actuation]\nratio = 0.75\n[accuracy]\nedges_per_segment = 8\n"
      "[jitter]\ntrials = 4\nconfined = 7\n[sweep.over]\nfootprint.longest_leg = [0.3, 4.0]\n");
  const preset::SweepGrid grid(presets);
  const auto found_by = [&](int jobs) {
    std::map<std::size_t, record::PointResult> found;
    Watch watch;
    REQUIRE(run_points(
        grid, {0, 1}, jobs,
        [&](record::PointResult result) -> Result<void> {
          found[result.point] = std::move(result);
          return {};
        },
        watch));
    return found;
  };
  const auto one = found_by(1), two = found_by(2);
  const auto figure = [&](std::size_t point, const char* name) {
    const auto* known = one.at(point).figure(name);
    return known ? record::number_of(*known) : std::nan("");
  };
  for (const std::size_t point : {std::size_t(0), std::size_t(1)}) {
    CHECK(one.at(point).figures == two.at(point).figures);
    CHECK(figure(point, "at_rest") == 4);
    CHECK(figure(point, "jitter_seed") == 1 + double(point));
    const double all = figure(point, "met_i") + figure(point, "met_ii") + figure(point, "met_iii") +
                       figure(point, "met_iv") + figure(point, "met_other");
    CHECK(all <= 4);
    CHECK(all > 0);
  }
  // legs longer than two cells leave every rod its first mode
  CHECK(figure(1, "corner_leg") > 2);
  CHECK(figure(1, "states_i") == 1);
  CHECK(figure(1, "met_first_order") == 4);
  // every figure of a result can be drawn
  const auto names = figure_names(true);
  for (const auto& [name, value] : one.at(0).figures)
    CHECK(std::ranges::find(names, name) != names.end());
}

TEST_CASE("a path that ends early counts as far as it came, whatever the movie's frames") {
  const auto figures = [](int frames) {
    auto preset = preset::good(small_preset({.rods = 8, .radius_mm = 82, .actuated_mm = 40}) +
                               "[rod]\ndiameter_mm = 0.5\n")
                      .base;
    preset.movie.frames = frames;
    Watch watch;
    return figures_of(preset, watch).value();
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

TEST_CASE("the numbers of a sweep depend on its values, not on its pictures") {
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
  CHECK(refusal(done, Fault::io) == "the disk is full");
  CHECK(taken == 2);
}
