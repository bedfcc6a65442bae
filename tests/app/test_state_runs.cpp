// A search for states from end to end, on a shell small enough for seconds.
#include <catch2/catch.hpp>

#include "engine/core/atomic_file.h"
#include "engine/record/states.h"
#include "tests/app/program.h"
#include "tests/small_preset.h"
#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using gridshell::read_whole;
using gridshell::write_atomically;

namespace {

const std::string search =
    small_preset({.rods = 4, .radius_mm = 46, .actuated_mm = 34, .edges = 4}) +
    "[jitter]\ntrials = 8\nconfined = 4\ntransitions = 2\nbarriers = true\ndepth = 0.5\n";

std::string text_of(const fs::path& file) { return read_whole(file).value(); }

}  // namespace

TEST_CASE("a search for states: tables, pictures, and the same pictures again from the run") {
  const TemporaryFolder folder;
  const fs::path at = folder.path();
  REQUIRE(write_atomically(at / "shell.toml", search));
  const Ended one = gridshell_program({"figure", "shell.toml", "--threads", "1"}, at);
  CAPTURE(one.err);
  REQUIRE(one.code == 0);
  const fs::path run = at / "out" / "shell";
  const auto tables = gridshell::record::read_state_tables(run);
  REQUIRE(tables);
  REQUIRE(!tables->rows.empty());
  CHECK(tables->search.trials == 8);
  CHECK(tables->search.at_rest >= 7);
  for (const char* name : {"shell.png", "shell_1.png", "shell_energies.svg", "shell_lives.png"})
    CHECK(fs::exists(run / name));
  const Ended two = gridshell_program({"figure", "shell.toml", "--threads", "2", "-o", "two"}, at);
  REQUIRE(two.code == 0);
  for (const char* name : {"states.csv", "transitions.csv", "barriers.csv", "frames.csv",
                           "shell.png", "shell_ways.svg", "shell_barriers.svg"})
    if (fs::exists(run / name)) CHECK(text_of(run / name) == text_of(at / "two" / name));
  const Ended again = gridshell_program({"render", "out/shell", "-o", "again"}, at);
  CAPTURE(again.err);
  REQUIRE(again.code == 0);
  for (const char* name : {"shell.png", "shell_energies.png", "states.csv", "states.json"})
    CHECK(text_of(run / name) == text_of(at / "again" / name));
}

TEST_CASE("a search for states has no movie, and damaged tables are refused") {
  const TemporaryFolder folder;
  const fs::path at = folder.path();
  REQUIRE(write_atomically(at / "shell.toml", search));
  const Ended movie = gridshell_program({"movie", "shell.toml"}, at);
  CHECK(movie.code == 2);
  CHECK(movie.err.find("gridshell figure") != std::string::npos);
  REQUIRE(gridshell_program({"run", "shell.toml"}, at).code == 0);
  REQUIRE(write_atomically(at / "out/shell/states.csv", "state\n"));
  const Ended damaged = gridshell_program({"render", "out/shell", "-o", "again"}, at);
  CHECK(damaged.code == 2);
  CHECK(damaged.err.find("states.csv") != std::string::npos);
}

TEST_CASE("keys of a search that its mode does not use are refused with the reason") {
  const TemporaryFolder folder;
  REQUIRE(write_atomically(folder.path() / "shell.toml", search + "field_N_per_mm = 0.5\n"));
  const Ended idle = gridshell_program({"check", "shell.toml"}, folder.path());
  CHECK(idle.code == 2);
  CHECK(idle.err.find("gravity") != std::string::npos);
}
