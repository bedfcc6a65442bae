// The names of Catch2 2 for the tests where version 3 is installed (Debian 13): tests.cmake puts
// this folder before the library's own headers there.
#pragma once

#include <catch2/catch_all.hpp>  // IWYU pragma: export

using Catch::Approx;

namespace Catch {

using Matchers::EndsWith;
using Matchers::Equals;
using Matchers::StartsWith;

inline auto Contains(const std::string& part) { return Matchers::ContainsSubstring(part); }

}  // namespace Catch
