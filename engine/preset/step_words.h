// The words of [[step]]: what a hand can do to a shell.
#pragma once

#include "engine/core/words.h"

namespace gridshell::preset {

enum class Deed { move, push, hold, release, load, rest, jitter };
constexpr auto words(Deed) {
  return word_table<Deed>({{Deed::move, "move"},
                           {Deed::push, "push"},
                           {Deed::hold, "hold"},
                           {Deed::release, "release"},
                           {Deed::load, "load"},
                           {Deed::rest, "rest"},
                           {Deed::jitter, "jitter"}});
}

/// On which side of an unstable state a shell goes to rest.
enum class RestSide { lower, along, against };
constexpr auto words(RestSide) {
  return word_table<RestSide>(
      {{RestSide::lower, "lower"}, {RestSide::along, "along"}, {RestSide::against, "against"}});
}

}  // namespace gridshell::preset
