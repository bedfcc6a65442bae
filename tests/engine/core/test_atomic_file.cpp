#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "engine/core/file_io.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
namespace fs = std::filesystem;

TEST_CASE("a whole file replaces the old one and leaves nothing beside it") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "a.txt";
  REQUIRE(write_file(path, "old"));
  REQUIRE(write_file(path, std::string_view("new\0bytes", 9)));
  CHECK(read_file(path).value() == std::string("new\0bytes", 9));
  CHECK(folder.entries() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("a file that is not committed leaves the old one and no temporary") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "movie.mp4";
  REQUIRE(write_file(path, "old"));
  {
    AtomicFile file(path);
    CHECK(file.temporary().extension() == ".mp4");
    CHECK(file.temporary().parent_path() == folder.path());
    std::ofstream(file.temporary()) << "half";
  }
  CHECK(read_file(path).value() == "old");
  CHECK(folder.entries() == std::vector<std::string>{"movie.mp4"});
}

TEST_CASE("errors of files name the path and the reason") {
  TemporaryFolder folder;
  const fs::path missing = folder.path() / "no" / "such" / "a.txt";
  const auto written = write_file(missing, "x");
  REQUIRE_FALSE(written);
  CHECK(written.error().fault == Fault::io);
  CHECK(written.error().message ==
        "cannot write '" + missing.string() + "': No such file or directory");

  const auto read = read_file(folder.path());
  REQUIRE_FALSE(read);
  CHECK(read.error().message == "cannot read '" + folder.path().string() + "': Is a directory");

  // a file where a folder is wanted
  const fs::path file = folder.path() / "file";
  REQUIRE(write_file(file, "x"));
  const auto made = make_folder(file / "run");
  REQUIRE_FALSE(made);
  CHECK(made.error().message ==
        "cannot make folder '" + (file / "run").string() + "': Not a directory");
  // a folder where a file is wanted
  REQUIRE(make_folder(folder.path() / "sub" / "deep"));
  CHECK_FALSE(write_file(folder.path() / "sub", "x"));
  CHECK(folder.entries() == std::vector<std::string>{"file", "sub"});
}

TEST_CASE("a disk that fills up while writing is noticed, and the old file stays") {
  TemporaryFolder folder;
  const fs::path path = folder.path() / "big.txt";
  REQUIRE(write_file(path, "old"));
  const FileSizeLimit limit(4096);
  const auto written = write_file(path, std::string(100000, 'x'));
  REQUIRE_FALSE(written);
  CHECK(written.error().message == "cannot write '" + path.string() + "': File too large");
  CHECK(read_file(path).value() == "old");
  CHECK(folder.entries() == std::vector<std::string>{"big.txt"});
}
