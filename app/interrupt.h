// Ctrl-C and SIGTERM as a question that work can ask.
#pragma once

namespace gridshell::app {

/// From now on SIGINT and SIGTERM set a flag instead of ending the program; a second one ends it at
/// once. A file that grows too large is an error of its write, not a signal.
void catch_interrupts();

/// Whether SIGINT or SIGTERM has come.
bool interrupt_came() noexcept;

}  // namespace gridshell::app
