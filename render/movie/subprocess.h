// A program of another maker, run without a shell.
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

/// Takes a line that a child wrote to stderr, as it comes.
using LineListener = std::function<void(const std::string& line)>;

enum class Input { none, fed };

/// A running program, its output discarded. One that has not ended is killed with it.
class Subprocess {
 public:
  /// Runs `arguments[0]` (a path) with the others as its arguments. Errors: Fault::io.
  static Result<Subprocess> start(const std::vector<std::string>& arguments, Input input);
  Subprocess(Subprocess&& other) noexcept;
  Subprocess& operator=(Subprocess&&) = delete;
  ~Subprocess();

  /// Writes all of it to the child's input, as it takes it. False when it takes no more or `watch`
  /// asks to stop: end() then says why.
  bool feed(std::span<const std::uint8_t> bytes, const Watch& watch);

  /// Ends its input and waits; `heard` is called on this thread. Errors: Fault::io when it fails
  /// (with the last line it wrote to stderr) or is killed; Fault::cancelled when `watch` asks to
  /// stop, which ends it.
  Result<void> end(const Watch& watch, const LineListener& heard = {});

 private:
  Subprocess(std::string name, pid_t child, int input, int words)
      : name_(std::move(name)), child_(child), stdin_pipe_(input), stderr_pipe_(words) {}
  bool listen(const LineListener& heard);
  int wait();

  std::string name_;
  pid_t child_ = -1;
  int stdin_pipe_ = -1, stderr_pipe_ = -1;  ///< descriptors; -1: closed
  std::string stderr_text_, line_;          ///< on stderr; what of its last line came so far
};

/// Runs a program without input to its end. Errors: as of Subprocess.
Result<void> run_subprocess(const std::vector<std::string>& arguments, const Watch& watch,
                            const LineListener& heard = {});

}  // namespace gridshell::render
