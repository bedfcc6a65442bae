#include "engine/core/packing.h"

#include <catch2/catch.hpp>

using namespace gridshell;

TEST_CASE("a byte that is neither 0 nor 1 is refused as a bool") {
  const unsigned char byte = GENERATE(0, 1, 2, 255);
  const std::string bytes(1, char(byte));
  ByteReader reader(bytes);
  const bool value = reader.number<bool>();
  CHECK(reader.good() == (byte <= 1));
  CHECK(value == (byte == 1));
}
