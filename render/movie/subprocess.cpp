#include "render/movie/subprocess.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <utility>

extern char** environ;

namespace gridshell::render {
namespace {

constexpr int poll_ms = 100;  // time between two tests of the watch

std::string reason(int code) { return std::generic_category().message(code); }

void close_one(int& descriptor) {
  if (descriptor >= 0) ::close(descriptor);
  descriptor = -1;
}

struct DescriptorPair {
  int ours = -1, theirs = -1;
  ~DescriptorPair() {
    close_one(ours);
    close_one(theirs);
  }
};

// starts a program with stdout to /dev/null, stderr to a pipe and stdin from a socket or /dev/null
int spawn(const std::vector<std::string>& arguments, int input, int words, pid_t& child) {
  std::vector<char*> list;
  for (const std::string& word : arguments) list.push_back(const_cast<char*>(word.c_str()));
  list.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (input < 0)
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  else
    posix_spawn_file_actions_adddup2(&actions, input, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, words, 2);
  const int code = posix_spawn(&child, list[0], &actions, nullptr, list.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t start = text.find_last_of("\r\n");
  return start == std::string::npos ? text : text.substr(start + 1);
}

// passes complete lines to `heard`; `line` stores the last one until it is complete
void emit_lines(std::string_view said, std::string& line, const LineListener& heard) {
  for (const char c : said) {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty()) {
      heard(line);
      line.clear();
    }
  }
}

}  // namespace

Result<Subprocess> Subprocess::start(const std::vector<std::string>& arguments, Input input) {
  const auto failed = [&](int code) {
    return fail(Fault::io, "cannot start {}: {}", arguments[0], reason(code));
  };
  DescriptorPair words, fed;
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) return failed(errno);
  words.ours = ends[0], words.theirs = ends[1];
  if (input == Input::fed) {
    // a socket, since writing to it raises no signal when the reader has ended
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0) return failed(errno);
    fed.ours = ends[0], fed.theirs = ends[1];
  }
  pid_t child = -1;
  if (const int code = spawn(arguments, fed.theirs, words.theirs, child); code != 0)
    return failed(code);
  return Subprocess(arguments[0], child, std::exchange(fed.ours, -1),
                    std::exchange(words.ours, -1));
}

Subprocess::Subprocess(Subprocess&& other) noexcept
    : name_(std::move(other.name_)),
      child_(std::exchange(other.child_, -1)),
      stdin_pipe_(std::exchange(other.stdin_pipe_, -1)),
      stderr_pipe_(std::exchange(other.stderr_pipe_, -1)),
      stderr_text_(std::move(other.stderr_text_)),
      line_(std::move(other.line_)) {}

Subprocess::~Subprocess() {
  close_one(stdin_pipe_);
  close_one(stderr_pipe_);
  if (child_ < 0) return;
  stop();
}

/// Ends the program: by SIGTERM, and by SIGKILL if it still runs two seconds later.
void Subprocess::stop() {
  constexpr int tests = 200, between_ms = 10;
  ::kill(child_, SIGTERM);
  for (int k = 0; k < tests; ++k) {
    if (::waitpid(child_, nullptr, WNOHANG) == child_) {
      child_ = -1;
      return;
    }
    ::poll(nullptr, 0, between_ms);
  }
  ::kill(child_, SIGKILL);
  wait();
}

/// Reads from the program's stderr; returns false when that is closed.
bool Subprocess::listen(const LineListener& heard) {
  char block[4096];
  const ssize_t got = ::read(stderr_pipe_, block, sizeof block);
  if (got < 0 && errno == EINTR) return true;
  if (got <= 0) return false;
  stderr_text_.append(block, std::size_t(got));
  // only the last line is reported
  if (stderr_text_.size() > (1 << 16)) stderr_text_.erase(0, stderr_text_.size() - (1 << 15));
  if (heard) emit_lines(std::string_view(block, std::size_t(got)), line_, heard);
  return true;
}

bool Subprocess::feed(std::span<const std::uint8_t> bytes, const Watch& watch) {
  while (!bytes.empty()) {
    if (watch.cancelled()) return false;
    pollfd waiting[] = {{stdin_pipe_, POLLOUT, 0}, {stderr_pipe_, POLLIN, 0}};
    const int ready = ::poll(waiting, 2, poll_ms);
    if (ready < 0 && errno != EINTR) return false;
    if (ready <= 0) continue;
    // a program whose stderr is full reads no input
    if ((waiting[1].revents & POLLIN) != 0 && !listen({})) return false;
    if ((waiting[0].revents & (POLLERR | POLLHUP)) != 0) return false;
    if ((waiting[0].revents & POLLOUT) == 0) continue;
    const ssize_t sent =
        ::send(stdin_pipe_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EINTR && errno != EAGAIN) return false;
    if (sent > 0) bytes = bytes.subspan(std::size_t(sent));
  }
  return true;
}

int Subprocess::wait() {
  int status = 0;
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return status;
}

Result<void> Subprocess::end(const Watch& watch, const LineListener& heard) {
  close_one(stdin_pipe_);
  for (;;) {
    if (watch.cancelled()) {
      stop();
      return fail(Fault::cancelled, "stopped {}", name_);
    }
    pollfd waiting{stderr_pipe_, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, poll_ms);
    if (ready < 0 && errno != EINTR) break;
    if (ready > 0 && !listen(heard)) break;
  }
  const int status = wait();
  if (watch.cancelled()) return fail(Fault::cancelled, "stopped {}", name_);
  if (WIFSIGNALED(status))
    return fail(Fault::io, "{} was killed by signal {}", name_, WTERMSIG(status));
  if (WEXITSTATUS(status) != 0)
    return fail(Fault::io, "{} failed with exit code {}: {}", name_, WEXITSTATUS(status),
                last_line(stderr_text_));
  return {};
}

Result<void> run_subprocess(const std::vector<std::string>& arguments, const Watch& watch,
                            const LineListener& heard) {
  return Subprocess::start(arguments, Input::none).and_then([&](Subprocess&& child) {
    return child.end(watch, heard);
  });
}

}  // namespace gridshell::render
