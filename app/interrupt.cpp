#include "app/interrupt.h"

#include <csignal>

namespace gridshell::app {
namespace {

// a signal handler can reach nothing but what is static
volatile std::sig_atomic_t came = 0;

void on_signal(int) { came = 1; }

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART | SA_RESETHAND;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupt_came() noexcept { return came != 0; }

}  // namespace gridshell::app
