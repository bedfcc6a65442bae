// What a hand did to a shell, step by step, in the order it did it.
#pragma once

#include <memory>
#include <vector>

#include "engine/preset/preset.h"

namespace gridshell::window {

/// A copy costs nothing: it shares all steps, and what is done to it the other does not see. Copies
/// may be read on other threads.
class StepChain {
 public:
  bool empty() const { return !last_; }
  int size() const { return last_ ? last_->count : 0; }
  /// Of a chain that is not empty.
  const preset::Step& last() const { return last_->step; }
  void add(preset::Step step);
  /// Of a chain that is not empty.
  void replace_last(preset::Step step);
  void clear() { last_.reset(); }
  /// The first one first.
  std::vector<preset::Step> all() const;

 private:
  struct Link {
    preset::Step step;
    mutable std::shared_ptr<const Link> before;
    int count = 1;
    ~Link();
  };

  std::shared_ptr<const Link> last_;
};

}  // namespace gridshell::window
