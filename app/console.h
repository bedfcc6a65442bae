// What the program says and how it ends: errors in a sentence on stderr, exit codes of the README.
#pragma once

#include <exception>

#include "engine/core/result.h"

namespace gridshell::app {

enum ExitCode : int {
  done = 0,
  failed = 1,     ///< no equilibrium, unstable, disk full
  bad_input = 2,  ///< or bad usage
  different = 3,  ///< compared and different
  interrupted = 130
};

int exit_code(Fault fault);

/// Prints the error's message on stderr; its exit code.
int report(const Error& error);

/// Why an exception ended some work, as an error of the program: memory that ran out, with what to
/// do about it, or what the library that threw it says.
Error error_of(const std::exception& thrown);
inline int report_exception(const std::exception& thrown) { return report(error_of(thrown)); }

/// From now on an exception that nothing catches (memory that runs out where the standard library
/// promises not to throw) ends the program with a sentence and the exit code of a failure.
void answer_the_unexpected();

/// A path of the user's that cannot be read is bad input, whatever the system's reason.
template <class T>
Result<T> as_input(Result<T> result) {
  if (!result && result.error().fault == Fault::io) result.error().fault = Fault::bad_input;
  return result;
}

}  // namespace gridshell::app
