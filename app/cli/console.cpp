#include "app/cli/console.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>

namespace gridshell::app {

int report(const Error& error) {
  std::fprintf(stderr, "%s\n", error.message.c_str());
  switch (error.fault) {
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

Error error_of(const std::exception& thrown) {
  if (!dynamic_cast<const std::bad_alloc*>(&thrown)) return {Fault::io, thrown.what()};
  // a short text, since little memory may be left
  return {
      Fault::io,
      "memory ran out; 'gridshell check' says what a preset's meshes take, and fewer [accuracy] "
      "edges_per_segment, a larger tolerance or a smaller [movie] size take less"};
}

namespace {

constexpr const char* out_of_memory =
    "memory ran out; what was finished stays under its partial name\n";

/// Safe in signal handlers. It ends the program even if the text cannot be written.
[[noreturn]] void end_at_once(const char* words, ExitCode code) {
  if (::write(STDERR_FILENO, words, std::strlen(words)) < 0) _exit(code);
  _exit(code);
}

// static, since a signal handler has no arguments; atomic, since other threads read them
std::atomic<int> came{0}, guarded{0};
static_assert(std::atomic<int>::is_always_lock_free);

void on_signal(int) {
  if (came || !guarded) end_at_once("stopped\n", ExitCode::interrupted);
  came = 1;
}

}  // namespace

void install_terminate_handler() {
  std::set_terminate([] {
    const char* words = "ended by an error that nothing expected\n";
    try {
      if (const auto thrown = std::current_exception()) std::rethrow_exception(thrown);
    } catch (const std::bad_alloc&) {
      words = out_of_memory;
    } catch (...) {
    }
    end_at_once(words, ExitCode::failed);
  });
  // under `ulimit -v` OpenGL's libraries use memory that they did not get, and GLib aborts if it
  // cannot start a thread
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
    for (const int refused : {SIGSEGV, SIGTRAP, SIGABRT})
      std::signal(refused, [](int) {
        end_at_once(
            "ended by a signal: memory ran out under the limit that is set (ulimit -v); if it "
            "happens without a limit too, it is an error of this program; what was finished stays "
            "under its partial name\n",
            ExitCode::failed);
      });
}

void install_signal_handlers() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
  // a program that nohup started ignores the end of its terminal
  struct sigaction before {};
  sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) sigaction(SIGHUP, &action, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
}

bool interrupted_by_signal() noexcept { return came != 0; }

InterruptGuard::InterruptGuard() noexcept { guarded = 1; }

InterruptGuard::~InterruptGuard() { guarded = 0; }

namespace {
bool stdout_was_closed = false;
}

void open_standard_streams() noexcept {
  stdout_was_closed = ::fcntl(STDOUT_FILENO, F_GETFD) < 0 && errno == EBADF;
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
    if (::fcntl(number, F_GETFD) < 0 && errno == EBADF)
      if (::open("/dev/null", O_RDWR) != number) return;
}

Result<int> printed() {
  if (!stdout_was_closed) return ExitCode::done;
  return fail(Fault::io, "cannot write to standard output: it is closed");
}

bool flush_stdout(int failed_before) {
  errno = failed_before;
  const bool flushed = std::fflush(stdout) == 0;
  if (flushed && !std::ferror(stdout)) return true;
  // the reader, such as `head`, has read enough
  if (errno != EPIPE)
    std::fprintf(stderr, "cannot write to standard output: %s\n",
                 errno ? std::strerror(errno) : "it was cut short");
  return false;
}

}  // namespace gridshell::app
