#include "app/interrupt.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>

#include "app/console.h"

namespace gridshell::app {
namespace {

// a signal handler can reach nothing but what is static
volatile std::sig_atomic_t came = 0, guarded = 0;

void end_at_once() {
  const char words[] = "stopped\n";
  // nothing is left to do where even this cannot be said
  if (::write(STDERR_FILENO, words, sizeof words - 1) < 0) _exit(ExitCode::interrupted);
  _exit(ExitCode::interrupted);
}

void on_signal(int) {
  if (came || !guarded) end_at_once();
  came = 1;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // what nohup started is to survive its terminal
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupt_came() noexcept { return came != 0; }

Guarded::Guarded() noexcept { guarded = 1; }

Guarded::~Guarded() { guarded = 0; }

void open_standard_streams() noexcept {
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
    if (::fcntl(number, F_GETFD) < 0 && errno == EBADF)
      if (::open("/dev/null", O_RDWR) != number) return;
}

bool stdout_arrived() {
  errno = 0;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !std::ferror(stdout)) return true;
  std::fprintf(stderr, "cannot write to standard output: %s\n",
               errno ? std::strerror(errno) : "what was printed did not arrive");
  return false;
}

}  // namespace gridshell::app
