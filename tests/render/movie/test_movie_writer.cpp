#include <new>
#include <vector>

#include "render/gl/image.h"
#include "render/movie/movie_writer.h"
#include "tests/render/movie/fake_renderer.h"
#include "tests/render/synthetic.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;

namespace {

MovieStyle small(int width = 160, int height = 120) {
  MovieStyle style;
  style.size = {width, height};
  style.title = "two shells";
  return style;
}

/// Writes the frames of a run in memory.
Result<void> write(const record::Trajectory& run, Renderer& renderer,
                   const std::filesystem::path& folder, Watch& watch,
                   const FrameCallback& on_frame = {}) {
  return write_movie(source_of(run), summarise_run(run), small(), {}, renderer, folder, watch,
                     on_frame);
}

}  // namespace

TEST_CASE("a movie is numbered frames, each reported when it is complete") {
  const TemporaryFolder folder;
  const record::Trajectory run = synthetic::dome(3, 2);
  test::FakeRenderer renderer;
  Watch watch;
  std::vector<int> reported;
  const auto report =
      write(run, renderer, folder / "frames", watch, [&](int index, const Image& picture) {
        reported.push_back(index);
        const auto file = value_of(read_png(folder / "frames" / frame_name(index)));
        CHECK(file.rgba == picture.rgba);
        CHECK(watch.progress() == Approx((index + 1) / 3.0));
      });
  REQUIRE(report);
  CHECK(reported == std::vector<int>{0, 1, 2});
  CHECK(watch.progress() == 1);
  CHECK(names_in(folder / "frames") ==
        std::vector<std::string>{"frame_00000.png", "frame_00001.png", "frame_00002.png"});
  CHECK(renderer.outside == 0);
  CHECK(renderer.last_quality.shadow);
}

TEST_CASE("a cancelled movie stops between frames and keeps the finished ones") {
  const TemporaryFolder folder;
  const record::Trajectory run = synthetic::dome(5, 2);
  test::FakeRenderer renderer;
  Watch watch;
  const auto stop = [&](int index, const Image&) {
    if (index == 1) watch.cancel();
  };
  CHECK(refusal(write(run, renderer, folder, watch, stop), Fault::cancelled) ==
        "stopped after 2 of 5 frames");
  CHECK(folder.entries() == std::vector<std::string>{"frame_00000.png", "frame_00001.png"});
  CHECK(read_png(folder / "frame_00001.png"));
}

TEST_CASE("what goes wrong is passed on: the renderer, the disk, the run") {
  const TemporaryFolder folder;
  const record::Trajectory run = synthetic::dome(3, 2);
  Watch watch;
  test::FakeRenderer lost;
  lost.fail_at = 2;
  CHECK(refusal(write(run, lost, folder, watch), Fault::io) == "the context was lost");
  CHECK(folder.entries() == std::vector<std::string>{"frame_00000.png"});

  test::FakeRenderer renderer;
  {
    const FileSizeLimit full(500);
    CHECK_THAT(refusal(write(run, renderer, folder / "b", watch), Fault::io),
               Catch::Contains("frame_00000.png"));
  }
  CHECK(std::filesystem::is_empty(folder / "b"));

  CHECK_FALSE(write({}, renderer, folder / "c", watch));
  CHECK_FALSE(std::filesystem::exists(folder / "c"));
}

TEST_CASE("a movie is drawn from one frame at a time, and is that of the run in memory") {
  const TemporaryFolder folder;
  const record::Trajectory run = synthetic::dome(4, 2);
  test::FakeRenderer renderer;
  Watch watch;
  REQUIRE(write(run, renderer, folder / "memory", watch));
  std::vector<int> requested;
  const FrameSource source{&run.layout, 4, [&](int k) -> Result<record::Frame> {
                             requested.push_back(k);
                             return run.frames[std::size_t(k)];
                           }};
  REQUIRE(write_movie(source, summarise_run(run), small(), {}, renderer, folder / "one", watch));
  CHECK(requested == std::vector<int>{0, 1, 2, 3});
  for (int k = 0; k < 4; ++k) {
    const auto a = read_png(folder / "memory" / frame_name(k));
    const auto b = read_png(folder / "one" / frame_name(k));
    REQUIRE((a && b));
    CHECK(a->rgba == b->rgba);
  }
  // an error of the source is passed on
  const FrameSource broken{&run.layout, 4, [](int) -> Result<record::Frame> {
                             return fail(Fault::io, "the file is gone");
                           }};
  CHECK(refusal(write_movie(broken, summarise_run(run), small(), {}, renderer, folder / "b", watch),
                Fault::io) == "the file is gone");
}

TEST_CASE("nothing to show next to one another is refused, a stopped movie keeps complete frames") {
  const TemporaryFolder folder;
  test::FakeRenderer renderer;
  Watch watch;
  const auto beside = [&](const std::vector<NamedRun>& runs, Fault fault) {
    return refusal(write_side_by_side(runs, small(480, 270), renderer, folder, watch), fault);
  };
  CHECK(beside({}, Fault::bad_input) == "there is no run to show");
  // the longest run decides
  const record::Trajectory run = synthetic::dome(3, 2), shorter = synthetic::dome(2, 2);
  CHECK(beside({{&shorter, "a"}, {&run, "b"}}, Fault::io) == "none");
  CHECK(names_in(folder).size() == 3);
  CHECK(value_of(read_png(folder / frame_name(2))).width == 480);
  CHECK(renderer.outside == 0);
  watch.cancel();
  CHECK(beside({{&run, "a"}}, Fault::cancelled) == "stopped");
}

TEST_CASE("a worker does its jobs on one thread of its own and says how each ended") {
  Worker worker;
  REQUIRE(worker.wait());  // there is no job
  std::vector<std::thread::id> threads;
  for (int k = 0; k < 3; ++k) {
    worker.begin([&]() -> Result<void> {
      threads.push_back(std::this_thread::get_id());
      if (k == 1) return fail(Fault::io, "no room");
      return {};
    });
    const auto ended = worker.wait();
    CHECK(ended.has_value() == (k != 1));
    CHECK(worker.wait());  // reported once
  }
  REQUIRE(threads.size() == 3);
  CHECK(threads[0] == threads[2]);
  CHECK(threads[0] != std::this_thread::get_id());
}

TEST_CASE("an exception of a worker's job reaches who waits for it") {
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
