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
using Listener = std::function<void(const std::string& line)>;

enum class Input { none, fed };

/// A program under way, its output discarded. One that has not ended is killed with it.
class Child {
 public:
  /// Runs `arguments[0]` (a path) with the rest as its arguments. Errors: Fault::io.
  static Result<Child> start(const std::vector<std::string>& arguments, Input input);
  Child(Child&& other) noexcept;
  Child& operator=(Child&&) = delete;
  ~Child();

  /// Writes all of it to the child's input, as it takes it. False when it takes no more or `watch`
  /// asks to stop: end() then says why.
  bool feed(std::span<const std::uint8_t> bytes, const Watch& watch);

  /// Ends its input and waits; `heard` is called on this thread. Errors: Fault::io when it fails
  /// (with the last line it wrote to stderr) or is killed; Fault::cancelled when `watch` asks to
  /// stop, which ends it.
  Result<void> end(const Watch& watch, const Listener& heard = {});

 private:
  Child(std::string name, pid_t child, int input, int words)
      : name_(std::move(name)), child_(child), input_(input), words_(words) {}
  bool listen(const Listener& heard);
  int wait();

  std::string name_;
  pid_t child_ = -1;
  int input_ = -1, words_ = -1;  ///< descriptors; -1: closed
  std::string said_, line_;      ///< on stderr; what of its last line came so far
};

/// Runs a program without input to its end. Errors: as of Child.
Result<void> run_child(const std::vector<std::string>& arguments, const Watch& watch,
                       const Listener& heard = {});

}  // namespace gridshell::render
