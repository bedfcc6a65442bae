// Helpers for results of calls that may fail. It includes the library in one header, which the
// tests' precompiled header includes.
#pragma once

#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "engine/gridshell.h"

namespace gridshell {

/// The value of a result; the test fails with the error's message if it has none.
template <class T>
T value_of(Result<T> result) {
  if (!result) FAIL(result.error().message);
  return std::move(*result);
}
template <class T>
T value_of(std::optional<T> result) {
  REQUIRE(result);
  return std::move(*result);
}

/// The message of an error, whose kind is checked; "none" without an error.
template <class T>
std::string refusal(const Result<T>& result, Fault fault = Fault::bad_input) {
  if (result) return "none";
  CHECK(result.error().fault == fault);
  return result.error().message;
}

/// Checks that work which is cancelled before it starts ends as cancelled.
template <class Work>
void check_stops(const Work& work) {
  Watch watch;
  watch.cancel();
  CHECK_THAT(refusal(work(watch), Fault::cancelled), Catch::StartsWith("stopped"));
}

}  // namespace gridshell
