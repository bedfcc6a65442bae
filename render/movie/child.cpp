#include "render/movie/child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <string_view>
#include <system_error>

extern char** environ;

namespace gridshell::render {
namespace {

std::string reason(int code) { return std::generic_category().message(code); }

struct Pipe {
  int ends[2] = {-1, -1};
  ~Pipe() {
    close_end(0);
    close_end(1);
  }
  void close_end(int k) {
    if (ends[k] >= 0) ::close(ends[k]);
    ends[k] = -1;
  }
};

// stdin and stdout to nowhere, stderr into the pipe
int spawn(const std::vector<std::string>& arguments, int stderr_end, pid_t& child) {
  std::vector<char*> words;
  for (const std::string& word : arguments) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, stderr_end, 2);
  const int code = posix_spawn(&child, words[0], &actions, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return code;
}

std::string last_line(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r')) text.pop_back();
  const std::size_t start = text.find_last_of("\r\n");
  return start == std::string::npos ? text : text.substr(start + 1);
}

// whole lines; what is left of the last one waits for its end
void pass_on(std::string_view said, std::string& line, const Listener& heard) {
  for (const char c : said) {
    if (c != '\n' && c != '\r') {
      line += c;
    } else if (!line.empty()) {
      heard(line);
      line.clear();
    }
  }
}

// what the child says until it closes its stderr; it is told to end once the watch is cancelled
std::string listen(int pipe_end, pid_t child, const Watch& watch, const Listener& heard) {
  std::string words, line;
  bool told = false;
  for (;;) {
    if (watch.cancelled() && !told) {
      ::kill(child, SIGTERM);
      told = true;
    }
    pollfd waiting{pipe_end, POLLIN, 0};
    const int ready = ::poll(&waiting, 1, 100);
    if (ready < 0 && errno != EINTR) break;
    if (ready <= 0) continue;
    char block[4096];
    const ssize_t got = ::read(pipe_end, block, sizeof block);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) break;
    words.append(block, std::size_t(got));
    // only the end counts
    if (words.size() > (1 << 16)) words.erase(0, words.size() - (1 << 15));
    if (heard) pass_on(std::string_view(block, std::size_t(got)), line, heard);
  }
  return words;
}

}  // namespace

Result<void> run_child(const std::vector<std::string>& arguments, const Watch& watch,
                       const Listener& heard) {
  Pipe pipe;
  if (::pipe2(pipe.ends, O_CLOEXEC) != 0)
    return fail(Fault::io, fmt::format("cannot start {}: {}", arguments[0], reason(errno)));
  pid_t child = -1;
  if (const int code = spawn(arguments, pipe.ends[1], child); code != 0)
    return fail(Fault::io, fmt::format("cannot start {}: {}", arguments[0], reason(code)));
  pipe.close_end(1);
  const std::string words = listen(pipe.ends[0], child, watch, heard);

  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (watch.cancelled()) return fail(Fault::cancelled, fmt::format("stopped {}", arguments[0]));
  if (WIFSIGNALED(status))
    return fail(Fault::io,
                fmt::format("{} was killed by signal {}", arguments[0], WTERMSIG(status)));
  if (WEXITSTATUS(status) != 0)
    return fail(Fault::io, fmt::format("{} failed with exit code {}: {}", arguments[0],
                                       WEXITSTATUS(status), last_line(words)));
  return {};
}

}  // namespace gridshell::render
