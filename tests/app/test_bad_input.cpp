// What a user gets wrong: the exact sentence, exit code 2, and nothing left behind.
#include <catch2/catch.hpp>

#include "engine/core/atomic_file.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

using gridshell::write_atomically;

namespace {

struct Bad {
  std::string preset;  // the text of bad.toml
  std::vector<std::string> arguments;
  std::string sentence;  // all of stderr
};

const char* const too_large =
    "[actuation] radius_mm = 130.0: larger than the footprint, must be at most [footprint] "
    "radius_mm = 126\n";

}  // namespace

TEST_CASE("a bad preset is refused in a sentence, and leaves nothing behind") {
  const auto bad = GENERATE(values<Bad>({
      {"", {"movie", "none.toml"}, "cannot read 'none.toml': No such file or directory\n"},
      {"",
       {"movie", "."},
       "no preset '.': neither a file nor a listed name ('gridshell list' lists them)\n"},
      {"",
       {"movie", "s1_actuatoin"},
       "no preset 's1_actuatoin': neither a file nor a listed name; did you mean 's1_actuation'? "
       "('gridshell list' lists them)\n"},
      {"radius 126",
       {"movie", "bad.toml"},
       "bad.toml:1:8: not TOML: Error while parsing key-value pair: expected '=', saw '1'\n"},
      {"[footprint]\nradus_mm = 126.0",
       {"movie", "bad.toml"},
       "bad.toml:2:1: [footprint] radus_mm = 126.0: unknown key; did you mean 'radius_mm'?\n"},
      {"[footprint]\nrods = \"twelve\"",
       {"movie", "bad.toml"},
       "bad.toml:2:8: [footprint] rods = \"twelve\": is a string, must be an integer from 1 to "
       "500\n"},
      {"[rod]\nyoung_GPa = nan",
       {"movie", "bad.toml"},
       "bad.toml:2:13: [rod] young_GPa = nan: is not finite, must be a number > 0\n"},
      {"[footprint]\nradius_mm = -126.0",
       {"movie", "bad.toml"},
       "bad.toml:2:13: [footprint] radius_mm = -126.0: out of range, must be a number > 0\n"},
      {"[actuation]\nradius_mm = 130.0",
       {"movie", "bad.toml"},
       std::string("bad.toml:2:13: ") + too_large},
      {"",
       {"movie", "s1_actuation", "--set", "actuation.radius_mm=130.0"},
       std::string("--set: ") + too_large},
      {"[movie]\nframes = 0",
       {"movie", "bad.toml"},
       "bad.toml:2:10: [movie] frames = 0: out of range, must be an integer from 2 to 100000\n"},
      {"",
       {"movie", "s1_actuation", "--frames", "0"},
       "--frames: [movie] frames = 0: out of range, must be an integer from 2 to 100000\n"},
      {"",
       {"movie", "s1_actuation", "--size", "wide"},
       "--size wide: must be WxH, for example 1280x720\n"},
      {"",
       {"movie", "s1_actuation", "--quality", "best"},
       "--quality best: must be draft, movie or figure\n"},
      {"",
       {"run", "s1_actuation", "-o", "bad.toml"},
       "cannot write the folder 'bad.toml': it is a file\n"},
      {"",
       {"run", "s1_actuation", "-o", "bad.toml/x"},
       "cannot write the folder 'bad.toml/x': Not a directory\n"},
      {"",
       {"movei", "s1_actuation"},
       "no command 'movei'; did you mean 'movie'? ('gridshell --help' lists them)\n"},
      {"",
       {"compare", "none.png", "none.png"},
       "cannot read 'none.png': No such file or directory\n"},
      {"",
       {"render", "none"},
       "'none' is no run: cannot read 'none/summary.json': No such file or directory\n"},
  }));
  const TemporaryFolder folder;
  REQUIRE(write_atomically(folder.path() / "bad.toml", bad.preset));
  const auto ended = gridshell_program(bad.arguments, folder.path());
  CHECK(ended.err == bad.sentence);
  CHECK(ended.out.empty());
  CHECK(ended.code == 2);
  CHECK(folder.entries() == std::vector<std::string>{"bad.toml"});
}

TEST_CASE("a folder that is no run is not replaced") {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "thesis");
  REQUIRE(write_atomically(folder.path() / "thesis/chapter.tex", "years of work"));
  const auto ended = gridshell_program({"run", "s1_actuation", "-o", "thesis"}, folder.path());
  CHECK(ended.code == 2);
  CHECK(ended.err ==
        "cannot write the folder 'thesis': it exists and is no run (it has no summary.json); "
        "choose another folder with -o\n");
  CHECK(folder.entries() == std::vector<std::string>{"thesis"});
  CHECK(gridshell::read_whole(folder.path() / "thesis/chapter.tex").value() == "years of work");
}

TEST_CASE("a folder that may not be written is refused") {
  if (geteuid() == 0) return;  // root may write everywhere; 'bad.toml/x' above stands for it
  const TemporaryFolder folder;
  const auto shut = folder.path() / "shut";
  std::filesystem::create_directory(shut);
  std::filesystem::permissions(
      shut, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const auto ended = gridshell_program({"run", "s1_actuation", "-o", "shut/x"}, folder.path());
  CHECK(ended.code == 2);
  CHECK(ended.err == "cannot write the folder 'shut/x': Permission denied\n");
  CHECK(std::filesystem::is_empty(shut));
}

TEST_CASE("a footprint that cannot be built is refused before anything runs") {
  const TemporaryFolder folder;
  const auto ended =
      gridshell_program({"movie", "s1_actuation", "--set", "footprint.rods=1"}, folder.path());
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Catch::StartsWith("s1_actuation: "));
  CHECK(folder.entries().empty());
}

TEST_CASE("a net that ends before its boundary is refused with its place, and drawn by figure",
          "[standard]") {
  const TemporaryFolder folder;
  const auto ended = gridshell_program(
      {"figure", "surface_ellipsoid", "--set", "net.cut_mm=-50", "-o", "deep"}, folder.path());
  CHECK(ended.code == 2);
  CHECK_THAT(ended.err, Catch::Contains("where the net ends: deep_refused.png\n") &&
                            Catch::Contains("the net folds") && Catch::Contains("near ("));
  CHECK(folder.entries() ==
        std::vector<std::string>{"deep_refused.pdf", "deep_refused.png", "deep_refused.svg"});
}

TEST_CASE("a mesh that is none is refused with its file and line") {
  const TemporaryFolder folder;
  REQUIRE(write_atomically(folder.path() / "bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"));
  const auto ended =
      gridshell_program({"check", "surface_mesh", "--set", "net.file=bad.obj"}, folder.path());
  CHECK(ended.code == 2);
  CHECK(ended.err ==
        "--set: [net] file = \"bad.obj\": bad.obj:3: names a vertex that is none of the 2 before "
        "it\n");
}
