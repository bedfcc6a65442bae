// `gridshell export`: every format of everything that it writes, and what it refuses.
#include "tests/app/bench.h"

TEST_CASE("export writes a run in every format, and what is for the workshop", "[s1]") {
  const TemporaryFolder at;
  copy_shared_run("s1_actuation", at / "run");
  const auto before = files_under(at / "run", "");
  const std::vector<std::pair<std::string, std::string>> requested{
      {"", "a.csv"},         {"", "a.dxf"},          {"", "a.glb"},          {"", "a.html"},
      {"", "a.obj"},         {"", "a.pvd"},          {"", "a.vtp"},          {"", "a.xdmf"},
      {"tubes", "t.obj"},    {"footprint", "f.svg"}, {"footprint", "f.dxf"}, {"plate", "p.svg"},
      {"plate", "p.dxf"},    {"plate", "pins.csv"},  {"cutlist", "cut.csv"}, {"cutlist", "cut.pdf"},
      {"sheet", "sheet.pdf"}};
  for (const auto& [what, file] : requested) {
    std::vector<std::string> arguments{"export", "run", "--to", file};
    if (!what.empty()) arguments.insert(arguments.end(), {"--what", what});
    const auto ended = gridshell_program(arguments, at);
    INFO(file << "\n" << ended.err);
    CHECK(ended.code == 0);
    CHECK(fs::file_size(at / file) > 200);
  }
  CHECK(files_under(at / "a_frames", ".vtp").size() == 4);
  CHECK_THAT(text_of(at / "a.pvd"), Contains("file=\"a_frames/frame_00002.vtp\""));
  CHECK_THAT(text_of(at / "a.xdmf"), Contains("run/trajectory.h5:/nodes"));
  // the run is as it was
  CHECK(files_under(at / "run", "") == before);
  CHECK(gridshell_program("render run --size 64x48 --quality draft --quiet", at).code == 0);
}

TEST_CASE("export of a preset needs no run, of cases one is chosen") {
  const TemporaryFolder at;
  CHECK(gridshell_program("export ring_hemisphere --what plate --to pins.csv", at).code == 0);
  CHECK_THAT(text_of(at / "pins.csv"), Contains("far") && Contains(",second,"));
  check_refused("export fig3_caps --what cutlist --to a.csv", at,
                Contains("choose one with --case"));
}

TEST_CASE("what cannot be exported is refused with what would do, and writes nothing", "[s1]") {
  const TemporaryFolder at;
  copy_shared_run("s1_actuation", at / "run");
  const auto refused = [&](std::vector<std::string> arguments, const char* why) {
    arguments.insert(arguments.begin(), "export");
    check_refused(arguments, at, Contains(why));
  };
  refused({"run", "--to", "a.stl"}, "--what shape is written as .csv .dxf .glb");
  refused({"run", "--to", "a"}, "--what shape is written as");
  refused({"run", "--to", "a.obj", "--what", "house"}, "expected one of");
  refused({"run", "--to", "a.obj", "--what", "plate"}, "--what plate is written as .csv .dxf .svg");
  refused({"run", "--to", "a.obj", "--frame", "4"}, "expected a number from 0 to 3");
  refused({"run", "--to", "a.obj", "--frame", "-1"}, "expected a number from 0 to 3");
  refused({"run", "--to", "a.obj", "--case", "x"}, "has no cases, so no 'x'");
  refused({"run", "--to", "run/a.obj"}, "is in the run folder");
  refused({"run", "--to", "run"}, "is no file");
  refused({"s1_actuation", "--to", "a.obj"}, "s1_actuation");
  refused({"nowhere", "--to", "a.svg"}, "nowhere");
  CHECK(at.entries() == std::vector<std::string>{"run"});
}
