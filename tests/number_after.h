// Numbers in a text that a program wrote.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>
#include <string>

/// The number behind the first `before`, which the text must contain.
inline double number_after(const std::string& text, const std::string& before) {
  INFO(text << "\nhas no " << before);
  const std::size_t at = text.find(before);
  REQUIRE(at != std::string::npos);
  return std::strtod(text.c_str() + at + before.size(), nullptr);
}
