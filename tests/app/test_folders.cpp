// Cases in which users could lose data: folders that are no runs, links, closed streams, unfinished
// runs.
#include <sys/stat.h>

#include <nlohmann/json.hpp>

#include "render/gl/image.h"
#include "tests/app/bench.h"
#include "tests/app/unfinished_run.h"

namespace {

const std::string small = small_preset({.frames = 4});

// runs a command line in the shell, in which `gridshell` is the program; returns its exit code
int shell(const Bench& bench, const std::string& line) {
  const auto whole = "cd '" + bench.at.string() + "' && gridshell() { '" + GRIDSHELL_PROGRAM +
                     "' \"$@\"; } && " + line;
  const int status = std::system(whole.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

}  // namespace

TEST_CASE("a file put into a run keeps it from being replaced or drawn over") {
  const Bench bench(small);
  bench.good("run small.toml -o r");
  REQUIRE(write_file(bench.at / "r/notes.txt", "mine"));
  for (const auto& arguments :
       {std::vector<std::string>{"run", "small.toml", "-o", "r"}, {"render", "r"}}) {
    const auto ended = bench.run(arguments);
    CHECK(ended.code == 2);
    CHECK(ended.err ==
          "cannot write the folder 'r': it contains what no run wrote there: 'notes.txt'; choose "
          "another folder with -o\n");
  }
  CHECK(text_of(bench.at / "r/notes.txt") == "mine");
}

TEST_CASE("a run is written through a link, which stays") {
  const Bench bench(small);
  fs::create_directories(bench.at / "disk/real");
  fs::create_directory_symlink("disk/real", bench.at / "link");
  bench.good("run small.toml -o link");
  bench.good("run small.toml -o link/");
  CHECK(fs::is_symlink(bench.at / "link"));
  CHECK(fs::exists(bench.at / "disk/real/summary.json"));
  CHECK(files_under(bench.at / "disk", "").size() > 5);
  fs::create_directory_symlink("nowhere", bench.at / "broken");
  check_refused("run small.toml -o broken", bench.at, Contains("it is a broken link"));
}

TEST_CASE("closed streams do not become files of results") {
  const Bench bench(small);
  bench.good("run small.toml -o open");
  for (const std::string closed : {"2>&-", ">&-", "<&- >&- 2>&-"}) {
    INFO(closed);
    CHECK(shell(bench, "gridshell run small.toml -o closed " + closed) == 0);
    for (const char* name : {"preset.toml", "frames.csv", "joints.csv", "trajectory.h5"})
      CHECK(text_of(bench.at / "open" / name) == text_of(bench.at / "closed" / name));
  }
}

TEST_CASE("where memory is short a command ends with a sentence, wherever it runs out") {
  const Bench bench(small);
  for (const char* kilobytes : {"150000", "300000", "400000"}) {
    INFO(kilobytes);
    const int code = shell(bench, std::string("ulimit -v ") + kilobytes +
                                      " && gridshell movie small.toml > said 2> err");
    const std::string said = text_of(bench.at / "err");
    // GLib ends the process by itself, with a sentence of its own, where it cannot make a thread
    const bool by_glib = said.find("GLib-ERROR") != std::string::npos;
    CHECK((code <= 1 || by_glib));
    // "failed to map segment" is the message of the loader if a library does not fit
    if (code == 1)
      CHECK_THAT(said,
                 Contains("memory") || Contains("cannot") || Contains("failed to map segment"));
  }
}

TEST_CASE("on a disk that is full commands say so and leave what was there") {
  const std::string shown =
      small_preset({.rods = 8, .radius_mm = 84, .actuated_mm = 63, .edges = 4, .frames = 4});
  const Bench bench(shown);
  if (shell(bench, "unshare -m mount -t tmpfs tmpfs . 2> err") != 0) {
    WARN("skipped: no file system can be mounted here");
    return;
  }
  REQUIRE(write_file(bench.at / "visit", "do save_preset\n"));
  REQUIRE(write_file(bench.at / "sweep.toml",
                     shown + "[sweep]\nover = {footprint.radius_mm = [100, 101]}\n"));
  // the script prints a line for everything that is not as expected; 60 kB are enough for pictures,
  // not for data
  REQUIRE(write_file(bench.at / "full.sh", R"sh(
gridshell() { "$PROGRAM" "$@"; }
mount -t tmpfs -o size=8m tmpfs disk && cd disk && cp ../small.toml . &&
  gridshell run small.toml -o r --quiet || exit 1
files() { find . -type f ! -name filler ! -path '*.partial-*' ! -path './out/*'; }
files | sort | xargs cksum > ../before
fill() { head -c $(($(df -k --output=avail . | tail -1) - $1))k /dev/zero > filler; }
small='--quality draft --size 64x48 --quiet'
for free in 0 60; do
  fill $free
  while read -r command; do
    gridshell $command < /dev/null > ../out 2> ../err
    code=$?
    [ $code = 1 ] || echo "$free $command: $code"
    grep -q "^cannot write '.*': No space left on device$\|^cannot copy .*: No space left" ../err ||
      echo "$free $command: $(cat ../err)"
    files | sort | xargs cksum | cmp -s - ../before || echo "$free $command: $(files)"
    rm -rf *.partial-* out
  done <<END
run small.toml -o r --quiet
run small.toml -o new --quiet
movie small.toml -o r $small
figure small.toml -o new $small
render r $small
report r
export r --to shape.vtp
sweep ../sweep.toml --quiet --jobs 1
END
  rm filler
done
fill 0
gridshell view small.toml --play ../visit | grep -q "small.*: No space left on device" || echo view
files | sort | xargs cksum | cmp -s - ../before || echo "view: $(files)"
)sh"));
  CHECK(shell(bench,
              "mkdir disk && PROGRAM='" GRIDSHELL_PROGRAM "' unshare -m sh full.sh > wrong") == 0);
  CHECK(text_of(bench.at / "wrong") == "");
}

TEST_CASE("what stdout does not take is noticed") {
  const Bench bench(small);
  CHECK(shell(bench, "gridshell list > /dev/full 2> err") == 1);
  CHECK(text_of(bench.at / "err") == "cannot write to standard output: No space left on device\n");
  CHECK(shell(bench, "gridshell check small.toml > /dev/full 2> err") == 1);
  CHECK(shell(bench, "gridshell list --keys markdown > /dev/full 2> err") == 1);
  // a reader that has read enough
  CHECK(shell(bench, "gridshell list --keys markdown 2> err | head -1 > first") == 0);
  CHECK(text_of(bench.at / "err") == "");
  for (const std::string command : {"list", "check small.toml", "run small.toml --print-config"}) {
    CHECK(shell(bench, "gridshell " + command + " >&- 2> err") == 1);
    CHECK(text_of(bench.at / "err") == "cannot write to standard output: it is closed\n");
  }
}

TEST_CASE("inputs that are no regular files, or too large, are refused at once") {
  const Bench bench(small);
  REQUIRE(mkfifo((bench.at / "fifo").c_str(), 0600) == 0);
  const std::string curve = "[footprint]\nkind = \"curve\"\nboundary = \"polygon\"\npoints_mm = ";
  REQUIRE(write_file(bench.at / "pipe.toml", curve + "\"fifo\"\n"));
  REQUIRE(write_file(bench.at / "zero.toml", curve + "\"/dev/zero\"\n"));
  REQUIRE(write_file(bench.at / "large.toml", curve + "\"large.csv\"\n"));
  REQUIRE(write_file(bench.at / "large.csv", std::string(17 << 20, '1')));
  const char* pipe = "got a pipe or a device, expected a regular file";
  for (const auto& [arguments, sentence] :
       std::vector<std::pair<std::vector<std::string>, const char*>>{
           {{"check", "pipe.toml"}, pipe},
           {{"check", "zero.toml"}, pipe},
           {{"check", "large.toml"}, "it is larger than 16 MB"},
           {{"check", "/dev/zero"}, pipe},
           {{"check", "./fifo"}, pipe},
           {{"compare", "/dev/zero", "fifo"}, pipe},
       }) {
    INFO(arguments[1]);
    check_refused(arguments, bench.at, Contains(sentence));
  }
}

TEST_CASE("frames of a run that was cut short are drawn, and it says that it is unfinished") {
  const Bench bench(small);
  bench.good("movie small.toml --set movie.title_s=0.1 --set movie.poster=true -o whole");
  cut_short(bench.at / "whole", bench.at / "r.partial-7", 3);
  for (const char* name : {"title.png", "poster.png"})
    fs::copy_file(bench.at / "whole" / name, bench.at / "r.partial-7" / name);
  const auto drawn = bench.good("render r.partial-7");
  CHECK(drawn.err.starts_with("'r.partial-7' is not finished: 3 frames, up to progress 0.667\n"));
  const auto pictures = files_under(bench.at / "r.partial-7/frames", ".png");
  REQUIRE(pictures.size() == 3);
  const auto summary = nlohmann::json::parse(text_of(bench.at / "r.partial-7/summary.json"));
  CHECK(summary["finished"] == false);
  CHECK(summary["kind"] == "movie");
  CHECK(summary["preset"] == "small");
  CHECK(summary["energy_bend_mJ"] > 0);
  // all files of a run are written now, with the frames that were found
  const auto frames = text_of(bench.at / "r.partial-7/frames.csv");
  CHECK(std::count(frames.begin(), frames.end(), '\n') == 4);
  CHECK_FALSE(fs::exists(bench.at / "r.partial-7/frames.journal"));
  const auto again = bench.good("render r.partial-7 -o elsewhere");
  CHECK_THAT(again.err, Contains("'r.partial-7' is not finished"));
  CHECK(files_under(bench.at / "elsewhere/frames", ".png").size() == 3);
  // a complete one has no such message
  CHECK_THAT(bench.good("render whole").err, !Contains("finished"));
}

TEST_CASE("cases of a run that was cut short are drawn as far as they came") {
  const Bench bench(small);
  const std::string cases =
      "[[case]]\nname = \"near\"\nactuation.radius_mm = 43.0\n[[case]]\nname = \"far\"\n";
  REQUIRE(write_file(bench.at / "cases.toml", small + cases));
  bench.good("run cases.toml -o whole");
  const auto partial = bench.at / "r.partial-7";
  fs::create_directories(partial);
  fs::copy(bench.at / "whole/near", partial / "near");
  fs::copy_file(bench.at / "whole/preset.toml", partial / "preset.toml");
  cut_short(bench.at / "whole/far", partial / "far", 2);
  const auto drawn = bench.good("render r.partial-7 --set movie.beside=false");
  CHECK_THAT(drawn.err, Contains("'r.partial-7/far' is not finished: 2 frames"));
  CHECK(files_under(partial / "near/frames", ".png").size() == 4);
  CHECK(files_under(partial / "far/frames", ".png").size() == 2);
}

TEST_CASE("an interrupted run says how to draw what it found, and the next run names it") {
  const Bench bench(small);
  bench.good("run small.toml -o whole");
  cut_short(bench.at / "whole", bench.at / "out/small.partial-7", 3);
  const auto next = bench.good("run small.toml");
  CHECK_THAT(next.err,
             Contains("'out/small.partial-7' is left of a run that was not finished:\n  gridshell "
                      "render out/small.partial-7    draws it\n  rm -r out/small.partial-7    "
                      "removes it\n"));
  CHECK(fs::exists(bench.at / "out/small.partial-7/frames.journal"));
  CHECK_THAT(bench.good("run small.toml --quiet").err, !Contains("left of"));
}

TEST_CASE("a run folder of somebody else cannot write outside of -o") {
  const Bench bench(small);
  const std::string cases = "[[case]]\nname = \"near\"\n[[case]]\nname = \"far\"\n";
  REQUIRE(write_file(bench.at / "small.toml", small + cases));
  bench.good("run small.toml -o r");
  for (const std::string name : {"../victim/r", "/tmp/victim", "..", ".", "frames", ""}) {
    auto json = nlohmann::json::parse(text_of(bench.at / "r/summary.json"));
    json["cases"][1]["name"] = name;
    REQUIRE(write_file(bench.at / "r/summary.json", json.dump()));
    INFO(name);
    check_refused("render r -o drawn", bench.at, Contains("'r/summary.json': case "));
    CHECK_FALSE(fs::exists(bench.at / "victim"));
    CHECK_FALSE(fs::exists(bench.at / "drawn"));
  }
}

TEST_CASE("names of cases that would meet a run's files are refused") {
  const Bench bench(small);
  for (const auto& [name, sentence] : std::vector<std::pair<std::string, std::string>>{
           {"frames", "the folder of a movie's pictures"},
           {"segments", "the folder of an unfinished run's path"},
           {"movie.mp4", "another ending than .mp4"},
           {"frames.journal", "another ending than .journal"},
           {"a.json", "another ending than .json"},
           {std::string(300, 'x'), "(300 letters), expected at most 100"},
       }) {
    REQUIRE(write_file(bench.at / "bad.toml", small + "[[case]]\nname = \"" + name + "\"\n"));
    check_refused("check bad.toml", bench.at, Contains(sentence));
  }
}

TEST_CASE("values whose products leave the numbers are refused by their key") {
  const Bench bench(small);
  for (const std::string key :
       {"footprint.radius_mm", "footprint.spacing_mm", "rod.diameter_mm", "rod.young_GPa",
        "rod.curvature_per_mm", "dynamics.step_s", "loads.field_N_per_mm", "net.radius_mm"})
    for (const std::string value : {"1e160", "1e-160", "1e300"}) {
      INFO(key << " = " << value);
      check_refused({"check", "small.toml", "--set", key + "=" + value}, bench.at,
                    Contains("] " + key.substr(key.find('.') + 1) + ": got "));
    }
}

TEST_CASE("meshes that do not fit into memory are refused with what they would take") {
  const Bench bench(small);
  for (const char* command : {"check", "run"}) {
    check_refused({command, "small.toml", "--set", "accuracy.memory_GB=0.0001"}, bench.at,
                  Contains("2 edges per segment") && Contains("unknowns, take about") &&
                      Contains("more than the 0.0001 GB of [accuracy] memory_GB"));
  }
  // the radius is that of a building, the spacing that of a model
  check_refused(
      {"check", "small.toml", "--set", "footprint.rods=202", "--set", "footprint.radius_mm=2200",
       "--set", "actuation.radius_mm=2000", "--set", "accuracy.memory_GB=0.0001"},
      bench.at, Contains("a [footprint] spacing_mm above 20 or"));
  const auto fine = bench.run(
      "check small.toml --set accuracy.edges_per_segment=0 --set accuracy.tolerance=1e-300");
  CHECK(fine.code == 2);
}

TEST_CASE("a picture larger than any of ours is not read") {
  const Bench bench(small);
  // a header of 1000000 x 1000000 pixels, with its checksum
  const unsigned char header[] = {0x89, 'P',  'N',  'G',  13,  10,  26, 10,   0,    0,
                                  0,    13,   'I',  'H',  'D', 'R', 0,  0x0f, 0x42, 0x40,
                                  0,    0x0f, 0x42, 0x40, 8,   6,   0,  0,    0};
  std::string bytes(reinterpret_cast<const char*>(header), sizeof header);
  std::uint32_t sum = 0xffffffffu;
  for (std::size_t k = 12; k < bytes.size(); ++k) {
    sum ^= static_cast<unsigned char>(bytes[k]);
    for (int bit = 0; bit < 8; ++bit) sum = (sum >> 1) ^ (sum & 1 ? 0xedb88320u : 0);
  }
  sum = ~sum;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += char(sum >> shift);
  // the start of the pixel data, at which a reader of the header ends
  bytes += std::string("\0\0\0\4IDAT", 8);
  REQUIRE(write_file(bench.at / "bomb.png", bytes));
  check_refused("compare bomb.png bomb.png", bench.at,
                Contains("it has 1000000 x 1000000 pixels, more than the 268 million"));
}

TEST_CASE("a signal ends commands that draw no progress, at once") {
  const Bench bench(small);
  const int number = GENERATE(SIGINT, SIGTERM, SIGHUP);
  // a net of six hundred rods takes seconds to plan
  const Running running(
      "check fig3_hemisphere --set footprint.spacing_mm=0.5 --set accuracy.memory_GB=1000",
      bench.at);
  running.until_it_listens();
  REQUIRE_FALSE(running.ends_within(0.1));
  CHECK(interrupted(running, number).err == "stopped\n");
}

TEST_CASE("a run folder of version 0.1 is drawn, and replaced as a run") {
  const Bench bench(small);
  fs::copy(fs::path(GRIDSHELL_SOURCE_DIR) / "tests/app/version_0_1", bench.at / "old");
  const auto drawn = bench.good("render old -o drawn");
  CHECK_THAT(drawn.err, !Contains("not finished"));
  CHECK(files_under(bench.at / "drawn/frames", ".png").size() == 2);
  const auto summary = nlohmann::json::parse(text_of(bench.at / "drawn/summary.json"));
  CHECK(summary["energy_bend_mJ"] > 1.8);
  // values that version 0.1 did not write are unknown
  CHECK(summary["energy_load_mJ"].is_null());
  CHECK(summary["finished"] == true);
  check_refused("render old --set movie.colour_by=axial_force", bench.at,
                Contains("the run has no axial forces of its rods"));
  bench.good("run small.toml -o old");
  CHECK(fs::exists(bench.at / "old/manifest.txt"));
}
