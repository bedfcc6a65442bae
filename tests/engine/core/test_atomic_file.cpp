#include <filesystem>
#include <fstream>
#include <string>

#include "engine/core/file_io.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
namespace fs = std::filesystem;

TEST_CASE("a complete file replaces the old one and leaves no other file") {
  TemporaryFolder folder;
  const fs::path path = folder / "a.txt";
  REQUIRE(write_file(path, "old"));
  REQUIRE(write_file(path, std::string_view("new\0bytes", 9)));
  CHECK(read_file(path).value() == std::string("new\0bytes", 9));
  CHECK(folder.entries() == std::vector<std::string>{"a.txt"});
}

TEST_CASE("a file that is not committed leaves the old one and no temporary") {
  TemporaryFolder folder;
  const fs::path path = folder / "movie.mp4";
  REQUIRE(write_file(path, "old"));
  {
    AtomicFile file(path);
    CHECK(file.temporary().extension() == ".mp4");
    CHECK(file.temporary().parent_path() == folder);
    std::ofstream(file.temporary()) << "half";
  }
  CHECK(read_file(path).value() == "old");
  CHECK(folder.entries() == std::vector<std::string>{"movie.mp4"});
}

TEST_CASE("errors of files name the path and the reason") {
  TemporaryFolder folder;
  const fs::path missing = folder / "no" / "such" / "a.txt";
  CHECK(refusal(write_file(missing, "x"), Fault::io) ==
        "cannot write '" + missing.string() + "': No such file or directory");

  CHECK(refusal(read_file(folder), Fault::io) ==
        "cannot read '" + folder.path().string() + "': Is a directory");

  // a file where a folder is needed
  const fs::path file = folder / "file";
  REQUIRE(write_file(file, "x"));
  CHECK(refusal(make_folder(file / "run"), Fault::io) ==
        "cannot make folder '" + (file / "run").string() + "': Not a directory");
  // a folder where a file is needed
  REQUIRE(make_folder(folder / "sub" / "deep"));
  CHECK_FALSE(write_file(folder / "sub", "x"));
  CHECK(folder.entries() == std::vector<std::string>{"file", "sub"});
}

TEST_CASE("a disk that fills up while writing is noticed, and the old file stays") {
  TemporaryFolder folder;
  const fs::path path = folder / "big.txt";
  REQUIRE(write_file(path, "old"));
  const FileSizeLimit limit(4096);
  CHECK(refusal(write_file(path, std::string(100000, 'x')), Fault::io) ==
        "cannot write '" + path.string() + "': File too large");
  CHECK(read_file(path).value() == "old");
  CHECK(folder.entries() == std::vector<std::string>{"big.txt"});
}
