#include "app/console.h"

#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

namespace gridshell::app {

int exit_code(Fault fault) {
  switch (fault) {
    case Fault::bad_input:
      return ExitCode::bad_input;
    case Fault::cancelled:
      return ExitCode::interrupted;
    case Fault::no_equilibrium:
    case Fault::io:
      break;
  }
  return ExitCode::failed;
}

int report(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  return exit_code(error.fault);
}

Error error_of(const std::exception& thrown) {
  if (!dynamic_cast<const std::bad_alloc*>(&thrown)) return {Fault::io, thrown.what()};
  // few bytes: there may be none left
  return {
      Fault::io,
      "memory ran out; 'gridshell check' says what a preset's meshes take, and fewer [accuracy] "
      "edges_per_segment, a larger tolerance or a smaller [movie] size take less"};
}

void answer_the_unexpected() {
  std::set_terminate([] {
    const char* words = "ended by an error that nothing expected\n";
    try {
      if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      words = "memory ran out; what was finished stays under its partial name\n";
    } catch (...) {
    }
    if (::write(STDERR_FILENO, words, std::strlen(words)) < 0) _exit(ExitCode::failed);
    _exit(ExitCode::failed);
  });
}

}  // namespace gridshell::app
