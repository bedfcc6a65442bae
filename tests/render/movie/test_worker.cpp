#include "render/movie/frame_writer.h"

#include <catch2/catch.hpp>
#include <new>
#include <vector>

using namespace gridshell;
using namespace gridshell::render;

TEST_CASE("a worker does its jobs on one thread of its own and says how each ended") {
  Worker worker;
  REQUIRE(worker.wait());  // of none
  std::vector<std::thread::id> threads;
  for (int k = 0; k < 3; ++k) {
    worker.begin([&]() -> Result<void> {
      threads.push_back(std::this_thread::get_id());
      if (k == 1) return fail(Fault::io, "no room");
      return {};
    });
    const auto ended = worker.wait();
    CHECK(ended.has_value() == (k != 1));
    CHECK(worker.wait());  // said once
  }
  REQUIRE(threads.size() == 3);
  CHECK(threads[0] == threads[2]);
  CHECK(threads[0] != std::this_thread::get_id());
}

TEST_CASE("what a worker's job throws is thrown where it is waited for") {
  Worker worker;
  worker.begin([]() -> Result<void> { throw std::bad_alloc(); });
  CHECK_THROWS_AS(worker.wait(), std::bad_alloc);
  worker.begin([]() -> Result<void> { return {}; });
  CHECK(worker.wait());
}

TEST_CASE("a worker that goes waits for its job") {
  bool done = false;
  {
    Worker worker;
    worker.begin([&]() -> Result<void> {
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
      done = true;
      return {};
    });
  }
  CHECK(done);
}
