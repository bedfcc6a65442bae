// Macros that pass on an error in one line. Only .cpp files include this header.
#pragma once

#include "engine/core/result.h"

/// TRY(x, f(y)); is `auto x = f(y);`, or returns the error of f.
#define TRY(name, ...)     \
  auto name = __VA_ARGS__; \
  if (!name) return tl::unexpected<::gridshell::Error>(std::move(name).error())

/// TRY_DO(f(y)); continues if f succeeds, or returns its error.
#define TRY_DO(...)                                                       \
  do {                                                                    \
    if (auto done = __VA_ARGS__; !done)                                   \
      return tl::unexpected<::gridshell::Error>(std::move(done).error()); \
  } while (false)
