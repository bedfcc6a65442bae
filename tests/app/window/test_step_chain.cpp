#include "app/window/command.h"

#include <catch2/catch.hpp>

using namespace gridshell;
using namespace gridshell::window;

namespace {

preset::Step numbered(int seed) {
  preset::Step step;
  step.deed = preset::StepKind::jitter;
  step.seed = seed;
  return step;
}

}  // namespace

TEST_CASE("a chain of steps and its copies go on apart, sharing what came before") {
  StepHistory chain;
  CHECK(chain.empty());
  for (int k : {1, 2, 3}) chain.add(numbered(k));
  StepHistory copy = chain;
  copy.replace_last(numbered(30));
  copy.add(numbered(40));
  const auto seeds = [](const StepHistory& of) {
    std::vector<int> all;
    for (const preset::Step& step : of.all()) all.push_back(step.seed);
    return all;
  };
  CHECK(seeds(chain) == std::vector<int>{1, 2, 3});
  CHECK(seeds(copy) == std::vector<int>{1, 2, 30, 40});
  CHECK(copy.size() == 4);
  CHECK(copy.last().seed == 40);
  chain.clear();
  CHECK(seeds(copy).size() == 4);
}

TEST_CASE("a very long chain of steps is freed") {
  StepHistory chain;
  for (int k = 0; k < 200000; ++k) chain.add(numbered(k));
  const StepHistory copy = chain;
  CHECK(copy.size() == 200000);
}
