#include "engine/core/team.h"

#include <catch2/catch.hpp>
#include <stdexcept>
#include <string>

using namespace gridshell;

TEST_CASE("an exception of a task reaches the caller, and the team continues") {
  Team team(GENERATE(1, 2, 4));
  const int wrong = GENERATE(0, 7, 63);
  for (int round = 0; round < 20; ++round) {
    std::atomic<int> done{0};
    const auto task = [&](int k) {
      if (k == wrong) throw std::runtime_error("task " + std::to_string(k));
      ++done;
    };
    CHECK_THROWS_WITH(team.run(64, task), "task " + std::to_string(wrong));
    CHECK(done < 64);
    done = 0;
    team.run(64, [&](int) { ++done; });
    CHECK(done == 64);
  }
}

TEST_CASE("of several tasks that throw one exception comes back, after all have ended") {
  Team team(4);
  std::atomic<int> under_way{0};
  const auto task = [&](int) {
    ++under_way;
    std::this_thread::yield();
    --under_way;
    throw std::bad_alloc();
  };
  for (int round = 0; round < 50; ++round) {
    CHECK_THROWS_AS(team.run(16, task), std::bad_alloc);
    CHECK(under_way == 0);
  }
}
