// Work beside the window, on a thread of its own: the shell in hand and its picture stay free.
#pragma once

#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "engine/core/result.h"
#include "engine/core/watch.h"

namespace gridshell::window {

/// Takes each line that is said on the way: "40 %  rendering, 0:12 left".
using Heard = std::function<void(const std::string& line)>;

/// A movie or a picture in the making; one at a time.
class AsideWork {
 public:
  using Work = std::function<Result<void>(const Heard& heard, const Watch& watch)>;
  /// How it ended: what it made, and the last that was said.
  struct End {
    std::filesystem::path target;
    Result<void> made;
    std::string last_words;
  };

  AsideWork() = default;
  ~AsideWork();  ///< stops what is under way
  AsideWork(const AsideWork&) = delete;
  AsideWork& operator=(const AsideWork&) = delete;

  /// Where none is under way.
  void begin(Work work, const std::filesystem::path& target);
  void stop();
  bool under_way() const;
  /// Whether none is under way and the end of the last one was taken.
  bool idle() const;
  /// The last that was said.
  std::string standing() const;
  /// The end of the last one, once.
  std::optional<End> take_end();
  /// Waits until none is under way.
  void wait();

 private:
  mutable std::mutex mutex_;
  std::thread thread_;
  std::optional<Watch> watch_;  // of what is under way or has just ended
  std::filesystem::path target_;
  std::string said_;
  bool under_way_ = false;
  std::optional<Result<void>> made_;
};

}  // namespace gridshell::window
