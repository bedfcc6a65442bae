#include <catch2/catch.hpp>
#include <string>

#include "engine/core/system_info.h"

using namespace gridshell;

TEST_CASE("a build is known by the version and the linker's hash, the same at every call") {
  const std::string id = build_id(), begin = std::string(version()) + " ";
  CHECK(build_id() == id);
  REQUIRE(id.substr(0, begin.size()) == begin);
  const std::string hash = id.substr(begin.size());
  CHECK(hash.size() >= 16);
  CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
}
