// Errors as values: a function that can fail returns Result<T>, a T or an Error.
#pragma once

#include <fmt/core.h>
#include <string>
#include <utility>

// declared first, so that a Result that is dropped does not compile
namespace tl {
template <class T, class E>
class [[nodiscard]] expected;
}
#include <tl/expected.hpp>

namespace gridshell {

/// Why something failed; the program maps it to its exit code.
enum class Fault {
  bad_input,       ///< the user's text, key, value, path or scene (exit 2)
  no_equilibrium,  ///< no certified state was found (exit 1)
  io,              ///< a file could not be read or written (exit 1)
  cancelled,       ///< the user stopped it (exit 130)
};

/// One failure, in a sentence that names the object and what would be right.
struct Error {
  Fault fault = Fault::bad_input;
  std::string message;
};

template <class T>
using Result = tl::expected<T, Error>;

/// Makes an error, as in `return fail(Fault::io, "...")`.
inline tl::unexpected<Error> fail(Fault fault, std::string message) {
  return tl::unexpected<Error>(Error{fault, std::move(message)});
}
/// An error whose message is made from a format and its arguments.
template <class First, class... More>
tl::unexpected<Error> fail(Fault fault, fmt::format_string<First, More...> text, First&& first,
                           More&&... more) {
  return fail(fault, fmt::format(text, std::forward<First>(first), std::forward<More>(more)...));
}

/// Shorthand for fail(Fault::bad_input, ...).
inline tl::unexpected<Error> invalid(std::string message) {
  return fail(Fault::bad_input, std::move(message));
}
template <class First, class... More>
tl::unexpected<Error> invalid(fmt::format_string<First, More...> text, First&& first,
                              More&&... more) {
  return fail(Fault::bad_input, text, std::forward<First>(first), std::forward<More>(more)...);
}

/// The failure of all work that was cancelled.
inline tl::unexpected<Error> stopped() { return fail(Fault::cancelled, "stopped"); }

}  // namespace gridshell
