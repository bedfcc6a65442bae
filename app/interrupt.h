// Ctrl-C, SIGTERM and SIGHUP, from the first line of main to the last.
#pragma once

namespace gridshell::app {

/// From now on these signals end the program with the exit code of an interrupted one: at once
/// where nothing is at stake, and by way of interrupt_came() while a Guarded lives. A second signal
/// always ends it at once. A file that grows too large and a pipe that nobody reads are errors of
/// their writes, not signals.
void catch_interrupts();

/// Whether one of them has come.
bool interrupt_came() noexcept;

/// While one lives, a signal is noted and left to the work, which asks interrupt_came().
class Guarded {
 public:
  Guarded() noexcept;
  ~Guarded();
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;
};

/// Opens /dev/null in the place of a closed stdin, stdout or stderr: else the next file that is
/// opened would get its number, and be written to as if it were the terminal.
void open_standard_streams() noexcept;

/// Whether all that was printed on stdout arrived; else a line on stderr says why not.
bool stdout_arrived();

}  // namespace gridshell::app
