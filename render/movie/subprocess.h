// Other programs (ffmpeg), run without a shell.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell::render {

/// Called with every line that a child process writes to stderr.
using LineListener = std::function<void(const std::string& line)>;

enum class Input { none, fed };  ///< fed: by Subprocess::feed()

/// A running program, whose standard output is discarded. The destructor terminates a program that
/// is still running.
class Subprocess {
 public:
  /// Runs `arguments[0]` (a path) with the others as its arguments. Errors: Fault::io.
  static Result<Subprocess> start(const std::vector<std::string>& arguments, Input input);
  Subprocess(Subprocess&& other) noexcept;
  Subprocess& operator=(Subprocess&&) = delete;
  ~Subprocess();

  /// Writes all bytes to the program's input. Returns false if the program reads no more or `watch`
  /// is cancelled; end() then reports the reason.
  bool feed(std::span<const std::uint8_t> bytes, const Watch& watch);

  /// Closes the program's input and waits for its end; `heard` is called on this thread. Errors:
  /// Fault::io if it fails (with the last line that it wrote to stderr) or is killed;
  /// Fault::cancelled if `watch` is cancelled, which terminates it.
  Result<void> end(const Watch& watch, const LineListener& heard = {});

 private:
  Subprocess(std::string name, pid_t child, int input, int words)
      : name_(std::move(name)), child_(child), stdin_pipe_(input), stderr_pipe_(words) {}
  bool listen(const LineListener& heard);
  int wait();
  void stop();

  std::string name_;
  pid_t child_ = -1;
  int stdin_pipe_ = -1, stderr_pipe_ = -1;  ///< descriptors; -1: closed
  std::string stderr_text_, line_;          ///< text from stderr; its last line, still incomplete
};

/// Runs a program without input to its end. Errors: those of Subprocess.
Result<void> run_subprocess(const std::vector<std::string>& arguments, const Watch& watch,
                            const LineListener& heard = {});

}  // namespace gridshell::render
