// Ctrl-C, SIGTERM, SIGKILL and a full disk during a real movie: the files that remain are complete.
#include <fmt/format.h>

#include "engine/core/json.h"
#include "engine/core/system_info.h"
#include "engine/record/journal.h"
#include "render/gl/image.h"
#include "tests/app/bench.h"
#include "tests/app/unfinished_run.h"

namespace {

// Movie S1, small, but long enough to be stopped
const std::vector<std::string> movie{"movie",   "s1_actuation", "--size",
                                     "320x180", "--set",        "accuracy.edges_per_segment=4"};

bool frames_appear(const fs::path& folder) {
  return wait_until([&] { return files_under(folder, "frame_00002.png").size() == 1; });
}

void check_all_whole(const fs::path& folder) {
  const auto pictures = files_under(folder, ".png");
  CHECK(pictures.size() >= 3);
  for (const auto& picture : pictures) {
    INFO(picture);
    // a half-written file under a hidden name is no picture
    if (picture.filename().string().starts_with('.')) continue;
    CHECK(gridshell::render::read_png(picture));
  }
}

}  // namespace

TEST_CASE("Ctrl-C and SIGTERM stop within a second and leave finished frames whole", "[alone]") {
  const int number = GENERATE(SIGINT, SIGTERM);
  const TemporaryFolder folder;
  const Running running(movie, folder);
  REQUIRE(frames_appear(folder));
  const auto ended = interrupted(running, number);
  CHECK_THAT(ended.err, Contains("stopped\ncomplete in 'out/s1_actuation.partial-"));
  CHECK_FALSE(fs::exists(folder / "out/s1_actuation"));
  check_all_whole(folder);
  for (const auto& file : files_under(folder, ""))
    CHECK_FALSE(file.filename().string().starts_with('.'));
}

TEST_CASE("a picture that takes long does not delay Ctrl-C", "[alone]") {
  const TemporaryFolder folder;
  const Running running("movie s1_actuation --frames 2 --quality figure --size 3840x2160", folder);
  REQUIRE(wait_until([&] { return !files_under(folder, "summary.json").empty(); }));
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  const auto ended = interrupted(running, SIGINT);
  CHECK_THAT(ended.err, Contains("stopped\ncomplete in '") && Contains("1 finished run, ") &&
                            Contains("gridshell render"));
  CHECK(files_under(folder, "trajectory.h5").size() == 1);
}

TEST_CASE("Ctrl-C before anything is finished leaves nothing", "[alone]") {
  const TemporaryFolder folder;
  // the path, which is computed before the first frame, takes more than a second
  const Running running(
      "run s1_actuation --set accuracy.edges_per_segment=64 --set footprint.rods=20 --set "
      "footprint.radius_mm=206 --set actuation.radius_mm=155 --frames 5000",
      folder);
  REQUIRE(wait_until([&] { return fs::exists(folder / "out"); }));
  const auto ended = interrupted(running, SIGINT);
  CHECK_THAT(ended.err,
             Catch::EndsWith("stopped\nnothing was finished, so nothing is left behind\n"));
  CHECK(files_under(folder, "").empty());
}

TEST_CASE("a run that is ended continues from there, to the same state", "[full]") {
  const TemporaryFolder folder;
  const auto command = [](const char* output, const char* more) -> Arguments {
    const std::string line = fmt::format(
        "run s1_actuation --set footprint.rods=36 --set footprint.radius_mm=366 --set "
        "actuation.radius_mm=290 --set accuracy.tolerance=1e-3 --frames 2 --threads 1 -o {} {}",
        output, more);
    return line.c_str();
  };
  const auto kept = [&] {
    return std::ranges::any_of(files_under(folder, ""), [](const fs::path& file) {
      return file.filename().string().starts_with("segment_");
    });
  };
  {
    const Running running(command("ended", ""), folder);
    REQUIRE(wait_until(kept));
    CHECK_THAT(running.interrupt(SIGTERM).err,
               Catch::EndsWith("the same command with --resume continues from there\n"));
  }
  {
    const Running running(command("ended", "--resume"), folder);
    running.until_it_listens();
    running.interrupt(SIGKILL);
    CHECK(kept());
  }
  REQUIRE_FALSE(fs::exists(folder / "ended"));
  check_refused(command("ended", "--resume --set limits.max_strain=0.002"), folder,
                Contains("of another preset, or of this one with other keys"));
  good(command("ended", "--resume"), folder);
  CHECK_FALSE(kept());
  good(command("whole", ""), folder);
  const gridshell::Json a = gridshell::parsed(text_of(folder / "ended/summary.json")),
                        b = gridshell::parsed(text_of(folder / "whole/summary.json"));
  CHECK(a["energy_bend_mJ"].get<double>() ==
        Approx(b["energy_bend_mJ"].get<double>()).epsilon(1e-6));
  CHECK(a["edges_per_segment"] == b["edges_per_segment"]);
  CHECK(a["limit_reason"] == b["limit_reason"]);
  const std::string before = text_of(folder / "ended/summary.json");
  CHECK_THAT(good(command("ended", "--resume"), folder).out, Contains("finished already"));
  CHECK(text_of(folder / "ended/summary.json") == before);
  check_refused(command("ended", "--resume --set limits.max_strain=0.002"), folder,
                Contains("'ended' is a finished run of another preset, or of this one"));
}

TEST_CASE("a job that is queued again needs no if: --resume begins, continues or ends at once") {
  const Bench bench(small_preset({}));
  bench.good("run small.toml --resume");
  const fs::path summary = bench.at / "out/small/summary.json";
  const std::string before = text_of(summary);
  CHECK_THAT(bench.good("run small.toml --resume").out, Contains("out/small: is finished already"));
  CHECK(text_of(summary) == before);
  // a run that failed says again why
  const Ended failed = bench.run("run small.toml --set limits.max_strain=1e-6 -o failed --quiet"),
              again = bench.run(
                  "run small.toml --set limits.max_strain=1e-6 -o failed --quiet --resume");
  CHECK(failed.code == 1);
  CHECK(again.code == 1);
  CHECK_THAT(again.err, Contains("the path ended early"));
  check_refused("run small.toml --resume --set footprint.spacing_mm=19", bench.at,
                Contains("'out/small' is a finished run of another preset, or of this one"));
  bench.good("movie small.toml -o film");
  check_refused("run small.toml --resume -o film", bench.at,
                Contains("'film': it was made by 'gridshell movie'"));
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  CHECK(first_line(text_of(bench.at / "out/small/preset.toml")) ==
        std::string("# computed by gridshell ") + gridshell::version());
}

TEST_CASE("a run that another build began is not continued") {
  const Bench bench(small_preset({}));
  bench.good("run small.toml -o whole");
  const fs::path left = bench.at / "out/small.partial-7";
  cut_short(bench.at / "whole", left, 1);
  fs::create_directories(left / "segments");
  const auto begun_by = [&](const std::string& build) {
    REQUIRE(write_file(left / "segments/version", build));
  };
  // the version alone is not enough, and another build of the same version is refused
  begun_by(gridshell::version());
  check_refused("run small.toml --resume", bench.at, Contains("begun by another build"));
  begun_by(gridshell::version() + std::string(" 0123456789abcdef"));
  check_refused("run small.toml --resume", bench.at, Contains("begun by another build"));
}

TEST_CASE("a killed movie leaves no half file, and the run before it stays", "[s1]") {
  const TemporaryFolder folder;
  const fs::path run = folder / "out/s1_actuation";
  copy_shared_run("s1_actuation", run);
  fs::remove_all(run / "frames");
  const auto before = contents(run);
  const Running running(movie, folder);
  REQUIRE(frames_appear(folder));
  running.signal(SIGKILL);
  CHECK(running.wait().code == 128 + SIGKILL);
  check_all_whole(folder);
  CHECK(contents(run) == before);
}

namespace {

// the folder of a run that was killed with its number of frames in a range, none if it passed the
// range; the run is stopped while its frames are counted, so that it cannot continue between the
// count and the kill
fs::path killed_with(std::size_t least, std::size_t most, const std::vector<std::string>& run,
                     const fs::path& folder) {
  const Running running(run, folder);
  fs::path partial;
  std::size_t frames = 0;
  while (frames < least && running.pause()) {
    const auto journals = files_under(folder, gridshell::record::journal_name);
    if (!journals.empty()) {
      partial = journals.front().parent_path();
      frames = gridshell::record::frames_in_journals(partial);
    }
    if (frames >= least) break;
    running.signal(SIGCONT);
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  const bool killed = running.interrupt(SIGKILL).code == 128 + SIGKILL;
  return killed && frames <= most ? partial : fs::path();
}

}  // namespace

TEST_CASE("of a run that is killed near its end nearly all frames are drawn", "[standard]") {
  const TemporaryFolder folder;
  fs::path partial;
  // on a busy machine the run may pass the range before it is stopped; then it is started again
  for (int k = 0; k < 20 && partial.empty(); ++k) {
    for (const auto& left : fs::directory_iterator(folder.path())) fs::remove_all(left);
    partial = killed_with(216, 239,
                          {"run", "s1_actuation", "--frames", "240", "--quiet", "--set",
                           "accuracy.edges_per_segment=16", "-o", "run"},
                          folder);
  }
  REQUIRE_FALSE(partial.empty());
  CHECK_FALSE(fs::exists(folder / "run"));
  const auto frames = gridshell::record::frames_in_journals(partial);
  const auto drawn = good({"render", partial.filename(), "-o", "drawn", "--size", "64x48",
                           "--quality", "draft", "--quiet"},
                          folder);
  CHECK_THAT(drawn.err, Contains("is not finished: " + std::to_string(frames) + " frames"));
  CHECK(std::ranges::count_if(files_under(folder / "drawn/frames", ".png"), [](const auto& file) {
          return file.filename().string().starts_with("frame_");
        }) == std::ptrdiff_t(frames));
  CHECK_THAT(text_of(folder / "drawn/summary.json"), Contains("\"finished\": false"));
}

TEST_CASE("a full disk fails with 1 and leaves nothing half-written under a final name") {
  const TemporaryFolder folder;
  Ended ended;
  {
    // the program inherits this limit, into which not one frame fits
    const FileSizeLimit disk(100000);
    ended = gridshell_program("run s1_actuation", folder);
  }
  CHECK(ended.code == 1);
  CHECK_THAT(ended.err, Contains("cannot write '") &&
                            Contains("frames.journal': File too large\n") &&
                            Catch::EndsWith("nothing was finished, so nothing is left behind\n"));
  CHECK(files_under(folder, "").empty());
}
