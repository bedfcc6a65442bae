#include "app/window/step_chain.h"

#include <algorithm>
#include <utility>

namespace gridshell::window {

/// Frees what hangs on it one by one: a long chain would overflow the stack.
StepChain::Link::~Link() {
  std::shared_ptr<const Link> next = std::move(before);
  while (next && next.use_count() == 1) {
    std::shared_ptr<const Link> after = std::move(next->before);
    next = std::move(after);
  }
}

void StepChain::add(preset::Step step) {
  const int count = size() + 1;
  last_ = std::shared_ptr<const Link>(new Link{std::move(step), std::move(last_), count});
}

void StepChain::replace_last(preset::Step step) {
  last_ = std::shared_ptr<const Link>(new Link{std::move(step), last_->before, last_->count});
}

std::vector<preset::Step> StepChain::all() const {
  std::vector<preset::Step> steps;
  for (const Link* link = last_.get(); link; link = link->before.get()) steps.push_back(link->step);
  std::reverse(steps.begin(), steps.end());
  return steps;
}

}  // namespace gridshell::window
