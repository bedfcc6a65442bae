// Every input that a fuzzer saved, and every one that once did harm, is read again.
#include <catch2/catch.hpp>
#include <chrono>
#include <filesystem>

#include "engine/core/file_io.h"
#include "tests/fuzz/targets.h"

namespace fs = std::filesystem;

TEST_CASE("the kept inputs of all fuzzers are read without harm") {
  for (const auto& target : gridshell::fuzz::targets) {
    const auto folder = fs::path(GRIDSHELL_SOURCE_DIR) / "tests/fuzz/corpus" / target.name;
    int inputs = 0;
    for (const auto& entry : fs::directory_iterator(folder)) {
      INFO(entry.path());
      const auto bytes = gridshell::read_file(entry.path());
      REQUIRE(bytes);
      const auto start = std::chrono::steady_clock::now();
      target.read(*bytes);
      CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(5));
      ++inputs;
    }
    INFO(target.name);
    CHECK(inputs >= 3);
  }
}
