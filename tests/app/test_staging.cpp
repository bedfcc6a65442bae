#include <unistd.h>

#include "app/cli/staged_folder.h"
#include "engine/core/file_io.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using gridshell::app::StagedFolder;
namespace fs = std::filesystem;

namespace {

StagedFolder staged_at(const fs::path& run) { return value_of(StagedFolder::create(run, "run")); }

// makes the folder of a finished run: its files and their list, the manifest
void make_run(const fs::path& run) {
  REQUIRE(make_folder(run / "frames"));
  REQUIRE(write_file(run / "summary.json", "old"));
  REQUIRE(write_file(run / "frames/old.png", "old"));
  REQUIRE(app::write_manifest(run, "run"));
}

// the names next to `run` that do not belong to it
std::vector<std::string> others(const TemporaryFolder& folder) {
  auto names = folder.entries();
  std::erase(names, "run");
  return names;
}

}  // namespace

TEST_CASE("a staged folder takes its final name only on commit") {
  const TemporaryFolder folder;
  const auto final_folder = folder / "out/run";
  auto staged = staged_at(final_folder);
  CHECK(fs::is_directory(staged.path()));
  CHECK(staged.path().parent_path() == final_folder.parent_path());
  REQUIRE(write_file(staged.path() / "summary.json", "{}"));
  CHECK_FALSE(fs::exists(final_folder));
  REQUIRE(staged.commit());
  CHECK(fs::exists(final_folder / "summary.json"));
  CHECK_FALSE(fs::exists(staged.path()));
}

TEST_CASE("a run folder is replaced completely") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  make_run(run);
  {
    auto staged = staged_at(run);
    REQUIRE(write_file(staged.path() / "summary.json", "new"));
    CHECK(read_file(run / "summary.json").value() == "old");
    REQUIRE(staged.commit());
  }
  CHECK(read_file(run / "summary.json").value() == "new");
  CHECK_FALSE(fs::exists(run / "frames/old.png"));
  CHECK(folder.entries() == std::vector<std::string>{"run"});
}

TEST_CASE("without a commit nothing stays, not even the parents made for it") {
  const TemporaryFolder folder;
  { REQUIRE(StagedFolder::create(folder / "a/b/run", "run")); }
  CHECK(folder.entries().empty());
  REQUIRE(make_folder(folder / "a"));
  { REQUIRE(StagedFolder::create(folder / "a/b/run/", "run")); }
  CHECK(folder.entries() == std::vector<std::string>{"a"});
  CHECK(fs::is_empty(folder / "a"));
}

TEST_CASE("what is kept stays under its partial name, without half-written files") {
  const TemporaryFolder folder;
  fs::path partial;
  {
    auto staged = staged_at(folder / "run");
    partial = staged.path();
    REQUIRE(make_folder(partial / "frames"));
    REQUIRE(write_file(partial / "frames/frame_00000.png", "whole"));
    REQUIRE(write_file(partial / "frames/.partial-frame_00001.png", "ha"));
    staged.keep();
  }
  CHECK(fs::exists(partial / "frames/frame_00000.png"));
  CHECK_FALSE(fs::exists(partial / "frames/.partial-frame_00001.png"));
  CHECK_FALSE(fs::exists(folder / "run"));
}

TEST_CASE("only a run or an empty folder may be replaced, and what prevents it is named") {
  // files of the folder, added to those of a run if `whole`; a name that ends in / is a folder
  struct FolderCase {
    bool whole;
    std::vector<std::pair<std::string, std::string>> files;
    std::string why;  // empty: it may be replaced
  };
  const std::string run = R"({"preset": "x", "negative_pivots": 0})", mine = "mine";
  const auto folder_case = GENERATE_COPY(values<FolderCase>({
      {false, {}, ""},
      {true, {}, ""},
      {false, {{"notes.txt", mine}}, "it exists and is no run (it has no summary.json)"},
      {false, {{"summary.json", R"({"webpack": 1})"}}, "(its summary.json is not one of a run)"},
      {false, {{"summary.json/", ""}}, "it exists and is no run"},
      {false, {{"summary.json", run}, {"thesis.tex", mine}}, "'thesis.tex'"},
      {false, {{"summary.json", run}, {"holiday.png", "sun"}}, "'holiday.png'"},
      {true, {{"notes.txt", mine}}, "it contains what no run wrote there: 'notes.txt'"},
      {true, {{"old.png", mine}}, "it contains what no run wrote there: 'old.png'"},
      {true, {{"frames/mine.png", mine}}, "it contains what no run wrote there: 'frames/mine.png'"},
      {true, {{"segments/mine", mine}}, "it contains what no run wrote there: 'segments/mine'"},
      {true, {{".hidden", mine}}, "it contains what no run wrote there: '.hidden'"},
      {true, {{"deep/er/thesis.tex", mine}}, "no run wrote there: 'deep/er/thesis.tex'"},
      {true, {{"empty/", ""}}, "it contains what no run wrote there: 'empty'"},
  }));
  const TemporaryFolder folder;
  const auto at = folder / "run";
  REQUIRE(make_folder(at));
  if (folder_case.whole) make_run(at);
  for (const auto& [name, text] : folder_case.files) {
    INFO(name);
    REQUIRE(make_folder((at / name).parent_path()));
    if (!name.ends_with('/')) REQUIRE(write_file(at / name, text));
  }
  const auto staged = StagedFolder::create(at, "run");
  INFO(folder_case.why);
  REQUIRE(bool(staged) == folder_case.why.empty());
  if (staged) return;
  CHECK(staged.error().fault == Fault::bad_input);
  CHECK_THAT(staged.error().message,
             Catch::StartsWith("cannot write the folder '" + at.string() + "': ") &&
                 Catch::Contains(folder_case.why) &&
                 Catch::EndsWith("; choose another folder with -o"));
  CHECK(others(folder).empty());
}

TEST_CASE("whether a folder is a run is seen from its top, whatever lies below") {
  const TemporaryFolder folder;
  const auto top = folder / "top";
  SECTION("a tree that is too large to look through") {
    // each folder of it is in all others
    for (const char* name : {"a", "b", "c", "d"}) {
      REQUIRE(make_folder(top / name));
      for (const char* other : {"a", "b", "c", "d"})
        fs::create_directory_symlink(top / other, top / name / other);
    }
    CHECK_THAT(app::refusal_to_write(top, "run"), Catch::Contains("it exists and is no run"));
  }
  SECTION("links that lead in circles") {
    make_run(top);
    fs::remove(top / app::manifest_name);
    fs::create_symlink(app::manifest_name, top / app::manifest_name);
    CHECK_THAT(app::refusal_to_write(top, "run"), Catch::Contains("it exists and is no run"));
  }
  SECTION("one that says it is its own case") {
    const auto name = GENERATE(".", "..", "");
    REQUIRE(make_folder(top));
    REQUIRE(write_file(top / "summary.json",
                       std::string(R"({"preset": "x", "cases": [{"name": ")") + name + "\"}]}"));
    REQUIRE(write_file(top / "thesis.tex", "years of work"));
    CHECK_THAT(app::refusal_to_write(top, "run"), Catch::Contains("'thesis.tex'"));
  }
}

TEST_CASE("a run of version 0.1, which has no list of its files, may be replaced") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  REQUIRE(make_folder(run / "frames"));
  REQUIRE(write_file(run / "summary.json", R"({"preset": "a/x", "negative_pivots": 0})"));
  for (const char* name : {"frames.csv", "trajectory.h5", "movie.mp4", "x_1.png", "x_K.svg",
                           "frames/frame_00000.png", ".partial-77-frames.csv"})
    REQUIRE(write_file(run / name, "old"));
  CHECK(StagedFolder::create(run, "run"));
}

TEST_CASE("what appears under the final name meanwhile is not destroyed") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  auto staged = staged_at(run);
  REQUIRE(write_file(staged.path() / "summary.json", "new"));
  SECTION("a folder of somebody's") {
    REQUIRE(make_folder(run));
    REQUIRE(write_file(run / "thesis.tex", "years of work"));
    CHECK_THAT(refusal(staged.commit(), Fault::io), Catch::Contains("it exists and is no run"));
    CHECK(read_file(run / "thesis.tex").value() == "years of work");
    CHECK(read_file(staged.path() / "summary.json").value() == "new");
  }
  SECTION("a file") {
    REQUIRE(write_file(run, "mine"));
    REQUIRE_FALSE(staged.commit());
    CHECK(read_file(run).value() == "mine");
  }
  SECTION("a foreign file in the earlier run") {
    make_run(run);
    REQUIRE(write_file(run / "notes.txt", "mine"));
    REQUIRE_FALSE(staged.commit());
    CHECK(read_file(run / "notes.txt").value() == "mine");
  }
  SECTION("an empty folder, which is replaced") {
    REQUIRE(make_folder(run));
    REQUIRE(staged.commit());
    CHECK(read_file(run / "summary.json").value() == "new");
    CHECK(others(folder).empty());
  }
}

TEST_CASE("of two programs that write one folder the one that ends later replaces nothing") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  if (GENERATE(false, true)) make_run(run);
  auto first = staged_at(run), second = staged_at(run);
  REQUIRE(write_file(first.path() / "summary.json", "first"));
  REQUIRE(write_file(second.path() / "summary.json", "second"));
  REQUIRE(first.commit());
  CHECK_THAT(refusal(second.commit(), Fault::io), Catch::Contains("another command wrote it"));
  CHECK(read_file(run / "summary.json").value() == "first");
  second.keep();
  CHECK(read_file(second.path() / "summary.json").value() == "second");
}

TEST_CASE("a folder that was left behind is neither taken over nor lost") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  // an earlier process may have had the same id
  auto before = run;
  before += ".partial-" + std::to_string(getpid());
  REQUIRE(make_folder(before / "frames"));
  REQUIRE(write_file(before / "frames/frame_00099.png", "stale"));
  auto staged = staged_at(run);
  CHECK(staged.path() != before);
  CHECK(fs::is_empty(staged.path()));
  // the folder of `staged` is being written, so it is not left behind
  CHECK(app::left_behind(run) == std::vector<fs::path>{before});
  REQUIRE(staged.commit());
  CHECK_FALSE(fs::exists(run / "frames"));
  CHECK(fs::exists(before / "frames/frame_00099.png"));
}

TEST_CASE("an old run that cannot be removed is named, and the new one is complete") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  make_run(run);
  // root may remove everything, so the test acts as another user, who owns all of it
  const bool root = geteuid() == 0;
  const uid_t nobody = 65534;
  if (root) {
    for (const auto& entry : fs::recursive_directory_iterator(folder))
      REQUIRE(chown(entry.path().c_str(), nobody, nobody) == 0);
    REQUIRE(chown(folder.path().c_str(), nobody, nobody) == 0);
    REQUIRE(seteuid(nobody) == 0);
  }
  fs::permissions(run / "frames", fs::perms::owner_read | fs::perms::owner_exec);
  std::string note;
  {
    auto staged = staged_at(run);
    REQUIRE(write_file(staged.path() / "summary.json", "new"));
    note = staged.commit().value();
  }
  const auto left = app::left_behind(run);
  if (root) REQUIRE(seteuid(0) == 0);
  CHECK(read_file(run / "summary.json").value() == "new");
  REQUIRE(left.size() == 1);
  CHECK_THAT(note, Catch::Contains("could not be removed (Permission denied)") &&
                       Catch::Contains("is in '" + left[0].string() + "'"));
  fs::permissions(left[0] / "frames", fs::perms::owner_all);
}

TEST_CASE("a command replaces only what the same command made, a movie a run whose frames it has") {
  const TemporaryFolder folder;
  const auto run = folder / "run";
  const auto fill = [](const fs::path& at, int frames) {
    std::string table = "frame\n";
    for (int k = 0; k < frames; ++k) table += std::to_string(k) + "\n";
    REQUIRE(write_file(at / "summary.json", "{}"));
    REQUIRE(write_file(at / "frames.csv", table));
  };
  REQUIRE(make_folder(run));
  fill(run, 240);
  REQUIRE(app::write_manifest(run, "run"));
  CHECK(app::maker_of(run) == "run");
  CHECK_THAT(refusal(StagedFolder::create(run, "figure"), Fault::bad_input),
             Catch::Contains("it was made by 'gridshell run'") && Catch::Contains("-o"));
  CHECK(app::refusal_to_write(run, "run").empty());
  const int frames = GENERATE(239, 240, 300);
  auto movie = value_of(StagedFolder::create(run, "movie"));
  fill(movie.path(), frames);
  const auto committed = movie.commit();
  CHECK(bool(committed) == (frames >= 240));
  if (committed)
    CHECK_THAT(app::refusal_to_write(run, "run"), Catch::Contains("'gridshell movie'"));
  else
    CHECK_THAT(committed.error().message, Catch::Contains("'frames.csv': 240 instead of 239"));
  movie.keep();
}

TEST_CASE("what made a folder of version 0.2.0 is said by its summary") {
  const TemporaryFolder folder;
  const auto [summary, maker] = GENERATE(table<std::string, std::string>({
      {R"({"kind": "movie"})", "movie"},
      {R"({"cases": [{"name": "a", "kind": "figure"}]})", "figure"},
      {R"({"chart": "accuracy"})", ""},
  }));
  REQUIRE(write_file(folder / "summary.json", summary));
  REQUIRE(write_file(folder / app::manifest_name, "gridshell run 1\nsummary.json\n"));
  CHECK(app::why_not_a_run(folder.path()).empty());
  CHECK(app::maker_of(folder.path()) == maker);
}
