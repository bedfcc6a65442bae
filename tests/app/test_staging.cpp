#include <catch2/catch.hpp>

#include "app/staging.h"
#include "engine/core/atomic_file.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using gridshell::app::StagedFolder;
namespace fs = std::filesystem;

TEST_CASE("a staged folder takes its final name only on commit") {
  const TemporaryFolder folder;
  const auto final_folder = folder.path() / "out/run";
  auto staged = StagedFolder::create(final_folder);
  REQUIRE(staged);
  CHECK(fs::is_directory(staged->path()));
  CHECK(staged->path().parent_path() == final_folder.parent_path());
  REQUIRE(write_atomically(staged->path() / "summary.json", "{}"));
  CHECK_FALSE(fs::exists(final_folder));
  REQUIRE(staged->commit());
  CHECK(fs::exists(final_folder / "summary.json"));
  CHECK_FALSE(fs::exists(staged->path()));
}

TEST_CASE("a run folder is replaced as a whole") {
  const TemporaryFolder folder;
  const auto run = folder.path() / "run";
  REQUIRE(make_folder(run));
  REQUIRE(write_atomically(run / "summary.json", "old"));
  REQUIRE(write_atomically(run / "old.png", "old"));
  {
    auto staged = StagedFolder::create(run);
    REQUIRE(staged);
    REQUIRE(write_atomically(staged->path() / "summary.json", "new"));
    CHECK(read_whole(run / "summary.json").value() == "old");
    REQUIRE(staged->commit());
  }
  CHECK(read_whole(run / "summary.json").value() == "new");
  CHECK_FALSE(fs::exists(run / "old.png"));
  CHECK(folder.entries() == std::vector<std::string>{"run"});
}

TEST_CASE("without a commit nothing stays, not even the parents made for it") {
  const TemporaryFolder folder;
  { REQUIRE(StagedFolder::create(folder.path() / "a/b/run")); }
  CHECK(folder.entries().empty());
  REQUIRE(make_folder(folder.path() / "a"));
  { REQUIRE(StagedFolder::create(folder.path() / "a/b/run/")); }
  CHECK(folder.entries() == std::vector<std::string>{"a"});
  CHECK(fs::is_empty(folder.path() / "a"));
}

TEST_CASE("what is kept stays under its partial name, without half-written files") {
  const TemporaryFolder folder;
  fs::path partial;
  {
    auto staged = StagedFolder::create(folder.path() / "run");
    REQUIRE(staged);
    partial = staged->path();
    REQUIRE(make_folder(partial / "frames"));
    REQUIRE(write_atomically(partial / "frames/frame_00000.png", "whole"));
    REQUIRE(write_atomically(partial / "frames/.partial-frame_00001.png", "ha"));
    staged->keep();
  }
  CHECK(fs::exists(partial / "frames/frame_00000.png"));
  CHECK_FALSE(fs::exists(partial / "frames/.partial-frame_00001.png"));
  CHECK_FALSE(fs::exists(folder.path() / "run"));
}

TEST_CASE("only a run or an empty folder may be replaced") {
  const TemporaryFolder folder;
  const auto target = folder.path() / "target";
  SECTION("an empty folder may") {
    REQUIRE(make_folder(target));
    CHECK(StagedFolder::create(target));
  }
  SECTION("a folder with something else may not") {
    REQUIRE(make_folder(target));
    REQUIRE(write_atomically(target / "notes.txt", "mine"));
    const auto staged = StagedFolder::create(target);
    REQUIRE_FALSE(staged);
    CHECK(staged.error().fault == Fault::bad_input);
    CHECK(staged.error().message ==
          "cannot write the folder '" + target.string() +
              "': it exists and is no run (it has no summary.json); choose another folder with -o");
  }
  SECTION("a file may not") {
    REQUIRE(write_atomically(target, "mine"));
    CHECK_FALSE(StagedFolder::create(target));
  }
}
