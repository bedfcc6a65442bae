// Runs the program as a user does, in a folder of the test's.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

/// How a run of the program ended.
struct Ended {
  int code = 0;  ///< exit code; 128 + n when signal n ended it
  std::string out, err;
  double peak_MB = 0;                        ///< largest resident memory
  double wall_seconds = 0, cpu_seconds = 0;  ///< from the signal of interrupt() to the end

  /// Whether the program ended within a second of the signal: of wall time, or, on a busy machine,
  /// of processor time.
  bool prompt() const { return wall_seconds < 1 || (cpu_seconds < 1 && wall_seconds < 10); }
};

/// Arguments of the program: a list, or a line that is split at its blanks.
struct Arguments : std::vector<std::string> {
  using std::vector<std::string>::vector;
  Arguments(const std::vector<std::string>& words) : std::vector<std::string>(words) {}
  Arguments(const char* line) {
    std::istringstream words(line);
    for (std::string word; words >> word;) push_back(word);
  }
};

/// A process that runs `gridshell ARGUMENTS`, with `folder` as its working directory; killed by the
/// destructor if nobody waited for its end.
class Running {
 public:
  Running(const Arguments& arguments, const std::filesystem::path& folder,
          const char* program = GRIDSHELL_PROGRAM)
      : folder_(folder) {
    pid_ = fork();
    if (pid_ != 0) {
      REQUIRE(pid_ > 0);
      return;
    }
    std::vector<char*> words{const_cast<char*>(program)};
    for (const auto& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
    words.push_back(nullptr);
    const bool ready = chdir(folder.c_str()) == 0 && divert("stdout.txt", STDOUT_FILENO) &&
                       divert("stderr.txt", STDERR_FILENO);
    if (ready) execv(words[0], words.data());
    _exit(127);
  }
  ~Running() {
    if (ended_) return;
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Running(const Running&) = delete;
  Running& operator=(const Running&) = delete;

  void signal(int number) const { kill(pid_, number); }

  /// Sends the signal and waits for the end.
  Ended interrupt(int number) const {
    const double before = cpu_so_far();
    const auto requested = std::chrono::steady_clock::now();
    signal(number);
    auto ended = wait();
    ended.wall_seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - requested).count();
    ended.cpu_seconds -= before;
    return ended;
  }

  /// Stops the process (SIGSTOP); returns whether it still exists.
  bool pause() const {
    signal(SIGSTOP);
    siginfo_t about{};
    waitid(P_PID, id_t(pid_), &about, WEXITED | WSTOPPED | WNOWAIT);
    return about.si_code == CLD_STOPPED;
  }

  /// Waits until the program handles SIGINT or has ended; before that a signal ends it without a
  /// message.
  void until_it_listens() const {
    const auto about = std::filesystem::path("/proc") / std::to_string(pid_);
    for (int k = 0; k < 50000 && !ends_within(0); ++k) {
      std::ifstream lines;
      // between fork and exec the process is a copy of this test, with the test's handlers
      std::error_code error;
      if (std::filesystem::equivalent(about / "exe", GRIDSHELL_PROGRAM, error))
        lines.open(about / "status");
      for (std::string line; std::getline(lines, line);)
        if (line.starts_with("SigCgt:") && std::stoull(line.substr(7), nullptr, 16) >> 1 & 1)
          return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (!ends_within(0)) FAIL("the program does not handle SIGINT");
  }

  /// Whether the process ends within so many seconds; wait() has still to be called.
  bool ends_within(double seconds) const {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    for (;;) {
      siginfo_t about{};
      waitid(P_PID, id_t(pid_), &about, WEXITED | WNOHANG | WNOWAIT);
      if (about.si_pid == pid_) return true;
      if (std::chrono::steady_clock::now() >= end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  Ended wait() const {
    int status = 0;
    rusage used{};
    REQUIRE(wait4(pid_, &status, 0, &used) == pid_);
    ended_ = true;
    Ended ended;
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ended.peak_MB = double(used.ru_maxrss) / 1024;
    for (const auto& time : {used.ru_utime, used.ru_stime})
      ended.cpu_seconds += double(time.tv_sec) + 1e-6 * double(time.tv_usec);
    ended.out = take("stdout.txt");
    ended.err = take("stderr.txt");
    return ended;
  }

 private:
  /// Processor time of the process so far, in seconds, without that of programs that it started.
  double cpu_so_far() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
    std::string word;
    // the second word is the program's name in brackets, the 14th and 15th are utime and stime
    std::getline(file, word, ')');
    for (int k = 3; k < 14; ++k) file >> word;
    double user = 0, system = 0;
    file >> user >> system;
    return (user + system) / double(sysconf(_SC_CLK_TCK));
  }

  static bool divert(const char* file, int to) {
    const int from = open(file, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    return from >= 0 && dup2(from, to) >= 0 && close(from) == 0;
  }

  /// Returns what was printed and removes the file, so that only the program's files remain.
  std::string take(const char* file) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / file).rdbuf();
    std::filesystem::remove(folder_ / file);
    return text.str();
  }

  std::filesystem::path folder_;
  pid_t pid_ = 0;
  mutable bool ended_ = false;
};

/// Runs `gridshell ARGUMENTS` to its end.
inline Ended gridshell_program(const Arguments& arguments, const std::filesystem::path& folder) {
  return Running(arguments, folder).wait();
}

/// All files and folders under `folder`, at any depth, whose names end with `ending`, sorted.
inline std::vector<std::filesystem::path> files_under(const std::filesystem::path& folder,
                                                      const std::string& ending) {
  std::vector<std::filesystem::path> found;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator at(folder, error), end; !error && at != end;
       at.increment(error))
    if (at->path().filename().string().ends_with(ending)) found.push_back(at->path());
  std::sort(found.begin(), found.end());
  return found;
}

/// Waits until `ready()` is true, at most 50 seconds; returns its last value.
template <class Ready>
bool wait_until(Ready ready) {
  for (int k = 0; k < 5000; ++k) {
    if (ready()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return ready();
}
