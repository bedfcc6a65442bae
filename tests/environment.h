// Numbers that a user gives tests by variables of the environment.
#pragma once

#include <catch2/catch.hpp>
#include <cstdlib>

#include "engine/core/text.h"

/// The number in the variable, which must be above 0; `otherwise` if the variable is not set.
inline int number_from(const char* variable, int otherwise) {
  const char* text = std::getenv(variable);
  if (!text) return otherwise;
  const auto number = gridshell::parse_number<int>(text);
  if (!number || *number <= 0)
    FAIL(variable << ": got '" << text << "', expected a number above 0");
  return *number;
}
