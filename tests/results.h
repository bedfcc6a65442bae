// What calls that may fail came to: their value, or why there is none; and the library in one
// header, which the tests' precompiled one holds.
#pragma once

#include <catch2/catch.hpp>
#include <optional>
#include <string>

#include "engine/gridshell.h"

namespace gridshell {

/// Its value; where it has none the test fails with the reason.
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

/// Why it was refused, for that kind of fault; "none" where it was not.
template <class T>
std::string refusal(const Result<T>& result, Fault fault = Fault::bad_input) {
  if (result) return "none";
  CHECK(result.error().fault == fault);
  return result.error().message;
}

/// What is asked to stop before it begins does so.
template <class Work>
void check_stops(const Work& work) {
  Watch watch;
  watch.cancel();
  CHECK(refusal(work(watch), Fault::cancelled) != "none");
}

}  // namespace gridshell
