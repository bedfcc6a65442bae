// What the program says and how it ends: errors in a sentence on stderr, exit codes of the README.
#pragma once

#include <exception>

#include "engine/core/result.h"

namespace gridshell::app {

enum ExitCode : int {
  done = 0,
  failed = 1,     ///< no equilibrium, unstable, tolerance missed, disk full
  bad_input = 2,  ///< or bad usage
  different = 3,  ///< compared and different
  interrupted = 130
};

/// Prints the error's message on stderr; its exit code.
int report(const Error& error);

/// The exit code of a command; its error is printed on stderr.
inline int report(const Result<int>& outcome) {
  return outcome ? *outcome : report(outcome.error());
}

/// Why an exception ended some work, as an error of the program: memory that ran out, with what to
/// do about it, or what the library that threw it says.
Error error_of(const std::exception& thrown);
inline int report_exception(const std::exception& thrown) { return report(error_of(thrown)); }

/// From now on an exception that nothing catches (memory that runs out where the standard library
/// promises not to throw) ends the program with a sentence and the exit code of a failure; so does
/// what a library does with memory that it was refused, where the address space is limited.
void install_terminate_handler();

/// A path of the user's that cannot be read is bad input, whatever the system's reason.
template <class T>
Result<T> as_input(Result<T> result) {
  if (!result && result.error().fault == Fault::io) result.error().fault = Fault::bad_input;
  return result;
}

// Ctrl-C, SIGTERM and SIGHUP, from the first line of main to the last.

/// Makes these signals end the program with the exit code of an interrupted one: at once if no
/// InterruptGuard exists, else by interrupted_by_signal(). A second signal always ends it at once.
/// A file that grows too large and a closed pipe are errors of their writes, not signals.
void install_signal_handlers();

/// Whether one of them has come.
bool interrupted_by_signal() noexcept;

/// While one lives, a signal is noted and left to the work, which asks interrupted_by_signal().
class InterruptGuard {
 public:
  InterruptGuard() noexcept;
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Opens /dev/null instead of a closed stdin, stdout or stderr: else the next file that is opened
/// would get its number and the output of the program.
void open_standard_streams() noexcept;

/// Whether all that was printed on stdout arrived; else a line on stderr says why not, with the
/// error number of what failed before.
bool flush_stdout(int failed_before = 0);

/// The exit code of a command that does nothing but print: a stdout that was closed from the
/// beginning is a failure of it.
Result<int> printed();

/// "1 frame", "2 frames"
inline std::string count_text(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

}  // namespace gridshell::app
