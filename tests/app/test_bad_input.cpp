// Wrong input: the program prints the exact message, ends with exit code 2 and writes no file.
#include <iterator>

#include "tests/app/bench.h"

namespace {

// lines of "ARGUMENTS => all of stderr"; a line before them that starts with '#' is bad.toml, its
// lines separated by " / "
constexpr const char* bad_inputs =
    R"(movie none.toml => cannot read 'none.toml': No such file or directory
movie . => no preset '.': neither a file nor a listed name ('gridshell list' lists them)
movie s1_actuatoin => no preset 's1_actuatoin': neither a file nor a listed name; did you mean 's1_actuation'? ('gridshell list' lists them)
#radius 126
movie bad.toml => bad.toml:1:8: not TOML: Error while parsing key-value pair: expected '=', saw '1'
#[footprint] / radus_mm = 126.0
movie bad.toml => bad.toml:2:1: [footprint] radus_mm: unknown key; did you mean 'radius_mm'?
#[footprint] / rods = "twelve"
movie bad.toml => bad.toml:2:8: [footprint] rods: got "twelve" (a string), expected an integer from 1 to 500
#[rod] / young_GPa = nan
movie bad.toml => bad.toml:2:13: [rod] young_GPa: got nan (not finite), expected a number > 0
#[footprint] / radius_mm = -126.0
movie bad.toml => bad.toml:2:13: [footprint] radius_mm: got -126.0 (out of range), expected a number > 0
#[actuation] / radius_mm = 130.0
movie bad.toml => bad.toml:2:13: [actuation] radius_mm: got 130.0 (larger than the footprint), expected at most [footprint] radius_mm = 126
movie s1_actuation --set actuation.radius_mm=130.0 => --set: [actuation] radius_mm: got 130.0 (larger than the footprint), expected at most [footprint] radius_mm = 126
#[movie] / frames = 0
movie bad.toml => bad.toml:2:10: [movie] frames: got 0 (out of range), expected an integer from 2 to 100000
movie s1_actuation --frames 0 => --frames: [movie] frames: got 0 (out of range), expected an integer from 2 to 100000
movie s1_actuation --size wide => --size wide: expected WxH, for example 1280x720
figure s1_actuation --width 0mm => --width 0mm: expected millimetres above 0 and below 10000, for example 85mm
figure s1_actuation --width 8.5cm => --width 8.5cm: expected millimetres above 0 and below 10000, for example 85mm
movie s1_actuation --quality best => --quality best: expected draft, movie or figure
run s1_actuation -o bad.toml => cannot write the folder 'bad.toml': it is a file
run s1_actuation -o bad.toml/x => cannot write the folder 'bad.toml/x': Not a directory
movei s1_actuation => no command 'movei'; did you mean 'movie'? ('gridshell --help' lists them)
compare none.png none.png => cannot read 'none.png': No such file or directory
render none => 'none' is no run: a run is a folder that 'gridshell run PRESET -o FOLDER' writes
)";

}  // namespace

TEST_CASE("a bad preset is refused in a sentence, and leaves nothing behind") {
  std::istringstream lines(bad_inputs);
  std::string preset;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with('#')) {
      preset = line.substr(1);
      if (const auto end = preset.find(" / "); end != preset.npos) preset.replace(end, 3, "\n");
      continue;
    }
    INFO(line);
    const auto arrow = line.find(" => ");
    std::istringstream words(line.substr(0, arrow));
    const std::vector<std::string> arguments{std::istream_iterator<std::string>(words), {}};
    const TemporaryFolder folder;
    REQUIRE(write_file(folder / "bad.toml", preset));
    const auto ended = gridshell_program(arguments, folder);
    CHECK(ended.err == line.substr(arrow + 4) + "\n");
    CHECK(ended.out.empty());
    CHECK(ended.code == 2);
    CHECK(folder.entries() == std::vector<std::string>{"bad.toml"});
  }
}

TEST_CASE("a folder that is no run is not replaced") {
  const TemporaryFolder folder;
  const fs::path thesis = folder / "thesis";
  fs::create_directory(thesis);
  REQUIRE(write_file(thesis / "chapter.tex", "years of work"));
  // `check` reports the same error before anything runs
  for (const char* command : {"run", "check"}) {
    const auto ended = gridshell_program({command, "s1_actuation", "-o", "thesis"}, folder);
    CHECK(ended.code == 2);
    CHECK(ended.err ==
          "cannot write the folder 'thesis': it exists and is no run (it has no summary.json); "
          "choose another folder with -o\n");
  }
  CHECK(folder.entries() == std::vector<std::string>{"thesis"});
  CHECK(text_of(thesis / "chapter.tex") == "years of work");
}

TEST_CASE("a folder that may not be written is refused") {
  if (geteuid() == 0) return;  // root may write everywhere; 'bad.toml/x' above replaces this case
  const TemporaryFolder folder;
  const auto shut = folder / "shut";
  fs::create_directory(shut);
  fs::permissions(shut, fs::perms::owner_read | fs::perms::owner_exec);
  const auto ended = gridshell_program("run s1_actuation -o shut/x", folder);
  CHECK(ended.code == 2);
  CHECK(ended.err == "cannot write the folder 'shut/x': Permission denied\n");
  CHECK(fs::is_empty(shut));
}

TEST_CASE("a footprint that cannot be built is refused before anything runs") {
  const TemporaryFolder folder;
  check_refused("movie s1_actuation --set footprint.rods=1", folder,
                Catch::StartsWith("s1_actuation: "));
  CHECK(folder.entries().empty());
}

TEST_CASE("a net that ends before its boundary is refused with its position, and drawn by figure",
          "[standard]") {
  const TemporaryFolder folder;
  check_refused("figure surface_ellipsoid --set net.cut_mm=-50 -o deep", folder,
                Contains("where the net ends: deep_refused.png\n") && Contains("the net folds") &&
                    Contains("near ("));
  CHECK(folder.entries() ==
        std::vector<std::string>{"deep_refused.pdf", "deep_refused.png", "deep_refused.svg"});
}

TEST_CASE("a mesh that is none is refused with its file and line") {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "bad.obj", "v 0 0 0\nv 1 0 0\nf 1 2 9\n"));
  const auto ended = gridshell_program("check surface_mesh --set net.file=bad.obj", folder);
  CHECK(ended.code == 2);
  CHECK(ended.err ==
        "--set: [net] file: bad.obj:3: got the number of no vertex, expected one of the 2 before "
        "it\n");
}
