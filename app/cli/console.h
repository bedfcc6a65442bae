// How a command ends: error messages on stderr, exit codes, signals, standard streams.
#pragma once

#include <exception>

#include "engine/core/result.h"

namespace gridshell::app {

enum ExitCode : int {
  done = 0,
  failed = 1,     ///< no equilibrium, unstable, tolerance missed, disk full
  bad_input = 2,  ///< wrong preset, file or option
  different = 3,  ///< what was compared differs
  interrupted = 130
};

/// Prints the message of an error on stderr; returns its exit code.
int report(const Error& error);

/// Returns the exit code of a command; prints its error, if it has one, on stderr.
inline int report(const Result<int>& outcome) {
  return outcome ? *outcome : report(outcome.error());
}

/// An exception as an error: if memory ran out, with a message about what helps, else with the text
/// of the exception.
Error error_of(const std::exception& thrown);
inline int report_exception(const std::exception& thrown) { return report(error_of(thrown)); }

/// Makes std::terminate() print a message and end the program with the exit code of a failure: for
/// memory that runs out in a function that is noexcept. Under `ulimit -v`, SIGSEGV, SIGTRAP and
/// SIGABRT do the same, since libraries do not check whether they got memory.
void install_terminate_handler();

/// Turns an io error into bad_input: for files that the user names and that cannot be read.
template <class T>
Result<T> as_input(Result<T> result) {
  if (!result && result.error().fault == Fault::io) result.error().fault = Fault::bad_input;
  return result;
}

// Handling of Ctrl-C, SIGTERM and SIGHUP.

/// Makes these signals end the program with the exit code of an interrupted one: at once if no
/// InterruptGuard exists, else by interrupted_by_signal(). A second signal always ends it at once.
/// A file that grows too large and a closed pipe are errors of their writes, not signals.
void install_signal_handlers();

/// Whether one of these signals was received while an InterruptGuard existed.
bool interrupted_by_signal() noexcept;

/// While an object of this class exists, the first signal does not end the program: the work polls
/// interrupted_by_signal() and stops. Only one may exist at a time.
class InterruptGuard {
 public:
  InterruptGuard() noexcept;
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;
};

/// Opens /dev/null for each of stdin, stdout and stderr that is closed: else the next file that is
/// opened would get its number, and the output of the program would go into that file.
void open_standard_streams() noexcept;

/// Flushes stdout. Returns whether everything printed on it arrived; if not, prints the reason on
/// stderr. `failed_before`: error number of an earlier write that failed, 0 if none did.
bool flush_stdout(int failed_before = 0);

/// The exit code of a command that only prints. Errors: io if stdout was closed from the start.
Result<int> printed();

}  // namespace gridshell::app
