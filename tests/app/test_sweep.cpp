// `gridshell sweep`: with several jobs, killed, in shards that are merged, with wrong requests.
#include <random>

#include "tests/app/bench.h"

using namespace gridshell;

namespace {

/// A sweep of `count` radii in small.toml.
void write_sweep(const fs::path& folder, int count, const std::string& more = "") {
  const auto text = small_preset({}) + more +
                    fmt::format(
                        "[sweep.over]\nactuation.radius_mm = {{ from = 44, to = 40, count = "
                        "{} }}\n",
                        count);
  REQUIRE(write_file(folder / "small.toml", text));
}

std::string text_if_any(const fs::path& file) { return read_file(file).value_or(""); }

std::size_t lines_in(const fs::path& file) {
  const auto text = text_if_any(file);
  return std::size_t(std::count(text.begin(), text.end(), '\n'));
}

/// Contents of the files that must be equal however a sweep was computed, none of them empty.
std::vector<std::string> products(const fs::path& folder, std::vector<std::string> names = {
                                                              "sweep.csv", "preset.toml",
                                                              "height_mm.png", "height_mm.svg"}) {
  for (std::string& name : names) {
    INFO(folder / name);
    name = text_of(folder / name);
    REQUIRE_FALSE(name.empty());
  }
  return names;
}

Ended sweep(const TemporaryFolder& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {"sweep", "small.toml", "--quiet"});
  return gridshell_program(arguments, folder);
}

/// Runs the sweep and requires exit code 0.
void done(const TemporaryFolder& folder, const std::vector<std::string>& arguments) {
  const Ended ended = sweep(folder, arguments);
  INFO(ended.err);
  REQUIRE(ended.code == 0);
}

/// Kills the sweep into cut/ once when it has logged a point, then `kills` times, each after
/// `least` to `least` + `range` milliseconds, and requires that complete lines of its log remain.
/// Returns the final log.
std::string killed_at_random(const fs::path& folder, int kills, unsigned seed, unsigned least,
                             unsigned range) {
  std::mt19937 random(seed);
  const auto log = folder / "cut/sweep.jsonl";
  std::string before;
  for (int kill = 0; kill <= kills; ++kill) {
    const Running running("sweep small.toml -o cut --jobs 2 --quiet", folder);
    if (kill == 0)
      REQUIRE(wait_until([&] { return lines_in(log) > 1; }));
    else
      std::this_thread::sleep_for(std::chrono::milliseconds(least + random() % range));
    running.signal(SIGKILL);
    running.wait();
    const auto now = text_if_any(log);
    REQUIRE(now.starts_with(before.substr(0, before.rfind('\n') + 1)));
    before = now;
  }
  return before;
}

}  // namespace

TEST_CASE("a sweep is the same with one job or more, and finished it draws again at once") {
  const TemporaryFolder folder;
  write_sweep(folder, 4, "[sweep]\nseeds = 2\n");
  done(folder, {"-o", "one", "--jobs", "1"});
  done(folder, {"-o", "two", "--jobs", "2"});
  const auto one = products(folder / "one");
  CHECK(one == products(folder / "two"));
  CHECK(lines_in(folder / "one/sweep.jsonl") == 9);
  CHECK_THAT(one[0], Contains("point,actuation.radius_mm,seed,outcome,") && Contains("height_mm"));
  // other pictures of the same numbers
  done(folder, {"-o", "one", "--set", "sweep.plot=[\"total_K\"]"});
  CHECK(fs::exists(folder / "one/total_K.png"));
  CHECK_FALSE(fs::exists(folder / "one/height_mm.png"));
  CHECK(lines_in(folder / "one/sweep.jsonl") == 9);
}

TEST_CASE("killing a sweep at any moment loses nothing that was logged") {
  const TemporaryFolder folder;
  write_sweep(folder, 60);
  done(folder, {"-o", "whole"});
  const auto log = folder / "cut/sweep.jsonl";
  const auto before = killed_at_random(folder, 20, 15, 0, 60);
  done(folder, {"-o", "cut"});
  CHECK(text_if_any(log).starts_with(before.substr(0, before.rfind('\n') + 1)));
  CHECK(products(folder / "cut") == products(folder / "whole"));
}

TEST_CASE("shards merge to the same bytes as the whole") {
  const TemporaryFolder folder;
  write_sweep(folder, 7);
  done(folder, {"-o", "whole"});
  for (const char* shard : {"3/3", "1/3"}) done(folder, {"-o", "parts", "--shard", shard});
  CHECK(fs::exists(folder / "parts/shard_3_of_3/sweep.csv"));
  const auto early = sweep(folder, {"-o", "parts", "--merge"});
  CHECK(early.code == 1);
  CHECK_THAT(early.err, Contains("5 of 7 points are in 'parts'"));
  done(folder, {"-o", "parts", "--shard", "2/3"});
  done(folder, {"-o", "parts", "--merge"});
  CHECK(products(folder / "parts") == products(folder / "whole"));
  // a second merge changes nothing
  done(folder, {"-o", "parts", "--merge"});
  CHECK(lines_in(folder / "parts/sweep.jsonl") == 8);
}

TEST_CASE("a sweep of searches is the same killed, stopped, in shards and on two jobs",
          "[standard]") {
  const TemporaryFolder at;
  REQUIRE(write_file(at / "small.toml", R"([footprint]
kind = "circle"
[actuation]
ratio = 0.75
[accuracy]
edges_per_segment = 8
[jitter]
trials = 3
confined = 3
[sweep]
plot = ["classes", "states"]
[sweep.over]
footprint.longest_leg = [0.8, 2.0]
footprint.rods = [4, 6]
)"));
  const auto found = [&](const char* run) {
    return products(at / run, {"sweep.csv", "preset.toml", "classes.png", "classes.svg",
                               "classes.pdf", "classes_by_leg.csv", "states.png"});
  };
  done(at, {"-o", "whole", "--jobs", "1"});
  // killed four times at random moments, then stopped by Ctrl-C after one more point
  const auto log = at / "cut/sweep.jsonl";
  killed_at_random(at, 4, 2, 50, 200);
  const std::size_t there = std::max<std::size_t>(1, lines_in(log));
  if (there < 5) {
    const Running running("sweep small.toml -o cut --jobs 1 --quiet", at);
    REQUIRE(wait_until([&] { return lines_in(log) > there; }));
    running.signal(SIGINT);
    const int code = running.wait().code;
    CHECK((code == 130 || lines_in(log) == 5));
  }
  done(at, {"-o", "cut", "--jobs", "2"});
  CHECK(found("cut") == found("whole"));
  for (const char* shard : {"2/2", "1/2"}) done(at, {"-o", "parts", "--shard", shard});
  done(at, {"-o", "parts", "--merge"});
  CHECK(found("parts") == found("whole"));
}

TEST_CASE("GNU parallel spreads a sweep over shards") {
  if (std::system("parallel --version > /dev/null 2>&1") != 0) {
    WARN("GNU parallel is not installed");
    return;
  }
  const TemporaryFolder folder;
  write_sweep(folder, 5);
  const auto line = fmt::format(
      "cd '{}' && parallel -j 2 '{}' sweep small.toml -o out --quiet --shard '{{}}/3' ::: 1 2 3",
      folder.path().string(), GRIDSHELL_PROGRAM);
  REQUIRE(std::system(line.c_str()) == 0);
  done(folder, {"-o", "out", "--merge"});
  done(folder, {"-o", "whole"});
  CHECK(products(folder / "out") == products(folder / "whole"));
}

TEST_CASE("a second sweep into a folder is refused, at the same time or of another preset") {
  const TemporaryFolder folder;
  write_sweep(folder, 200);
  const Running first({"sweep", "small.toml", "-o", "out", "--jobs", "1", "--quiet"}, folder);
  const auto log = folder / "out/sweep.jsonl";
  REQUIRE(wait_until([&] { return lines_in(log) > 1; }));
  fs::create_directories(folder / "second");
  const auto preset = (folder / "small.toml").string();
  const auto out = (folder / "out").string();
  check_refused({"sweep", preset, "-o", out}, folder / "second",
                Contains("another sweep is writing it"));
  first.signal(SIGINT);
  const auto stopped = first.wait();
  CHECK(stopped.code == 130);
  CHECK_THAT(stopped.err, Contains("of 200 points are in 'out'; the same command continues it"));
  check_refused("sweep small.toml -o out --set rod.young_GPa=70", folder,
                Contains("of another preset"));
}

TEST_CASE("a sweep's requests that cannot be met are reported") {
  const TemporaryFolder folder;
  write_sweep(folder, 3);
  const auto refused = [&](std::vector<std::string> arguments, const std::string& why) {
    arguments.insert(arguments.begin(), {"sweep", "small.toml"});
    check_refused(arguments, folder, Contains(why));
  };
  refused({"--set", "sweep.plot=[\"height\"]"}, "did you mean 'height_mm'?");
  refused({"--set", "sweep.over={}"}, "sweeps nothing");
  refused({"--shard", "4/3"}, "--shard 4/3: expected i/N");
  refused({"--shard", "x"}, "expected i/N");
  refused({"--shard", "0/8"},
          "where jobs are counted from 0: --shard $((SLURM_ARRAY_TASK_ID + 1))");
  refused({"-o", "out", "--merge"}, "contains no shard");
  refused({"-o", "."}, "it is no sweep, and contains '");
  refused({"-o", "small.toml"}, "it is a file");
  CHECK(fs::exists(folder / "small.toml"));
  REQUIRE(write_file(folder / "bad.toml", "[sweep.over]\nrod.diameter_mm = []\n"));
  check_refused("sweep bad.toml", folder, Contains("bad.toml:2:") && Contains("rod.diameter_mm"));
}

TEST_CASE("what an earlier call drew and this one does not request is removed") {
  const Bench bench(small_preset({}) +
                    "[sweep]\nplot = [\"energy_mJ\"]\n[sweep.over]\n"
                    "rod.diameter_mm = {from = 0.1, to = 0.3, count = 4}\n");
  bench.good("sweep small.toml --quiet");
  const fs::path folder = bench.at / "out/small";
  for (const char* name : {"energy_mJ.png", "energy_mJ_law.png", "laws.csv"})
    REQUIRE(fs::exists(folder / name));
  bench.good("sweep small.toml --quiet --set sweep.plot=[\"negative_pivots\"]");
  for (const char* name : {"energy_mJ.png", "energy_mJ_law.png", "laws.csv"}) {
    INFO(name);
    CHECK_FALSE(fs::exists(folder / name));
    CHECK_THAT(text_of(folder / "manifest.txt"), !Contains(name));
  }
}
