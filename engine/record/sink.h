// Where the frames of a run go as they are found.
#pragma once

#include <algorithm>
#include <utility>

#include "engine/core/result.h"
#include "engine/record/snapshot.h"

namespace gridshell::record {

/// Takes a run's layout, then its certified frames one by one as they are found, in any order:
/// `Frame::index` says which is which. An error stops the run and is passed on.
class Sink {
 public:
  virtual ~Sink() = default;
  /// May come again, when a finer mesh takes over: what came before is then dropped.
  virtual Result<void> begin(Layout layout) = 0;
  virtual Result<void> take(Frame frame) = 0;
};

/// Keeps all frames, in the order of their index.
class MemorySink final : public Sink {
 public:
  Result<void> begin(Layout layout) override {
    trajectory_ = {std::move(layout), {}};
    return {};
  }
  Result<void> take(Frame frame) override {
    auto& frames = trajectory_.frames;
    const auto after =
        std::upper_bound(frames.begin(), frames.end(), frame.index,
                         [](int index, const Frame& other) { return index < other.index; });
    frames.insert(after, std::move(frame));
    return {};
  }
  Trajectory& trajectory() { return trajectory_; }

 private:
  Trajectory trajectory_;
};

}  // namespace gridshell::record
