#include "app/console.h"

#include <cstdio>

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

}  // namespace gridshell::app
