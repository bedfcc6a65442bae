// A run that is stopped continues from the saved part of its path.
#include "engine/simulate/saved_segments.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "engine/core/file_io.h"
#include "engine/simulate/path_walk.h"
#include "tests/engine/simulate/run.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::simulate;
namespace fs = std::filesystem;

namespace {

/// A shell whose path changes to a branch with one mirror plane at progress 0.02.
preset::Preset imperfect() {
  preset::Preset p = circle(12, 126, 94.5, 4);
  p.accuracy.tolerance = 1e-3;
  return p;
}

/// The files of a folder, sorted.
std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files(fs::directory_iterator(folder), {});
  std::ranges::sort(files);
  return files;
}

struct Run {
  Result<record::Summary> summary;
  record::Trajectory trajectory;
};

/// Runs imperfect(), saves every load step in `folder` if it is given, and cancels the run once the
/// path parameter is above `stop_at`.
Run run_with(const fs::path& folder, double stop_at = 2) {
  const preset::Preset p = imperfect();
  RunContext context;
  if (!folder.empty()) context.segments = std::make_shared<SavedSegments>(folder, 0);
  Watch watch;
  std::atomic<bool> over = false;
  std::thread stopper([&] {
    // on the second mesh
    while (!over && !(watch.position().edges == 8 && watch.position().t > stop_at))
      std::this_thread::yield();
    if (!over) watch.cancel();
  });
  record::MemorySink sink;
  auto summary = run(p, shared_scene(p), false, sink, watch, context);
  over = true;
  stopper.join();
  return {std::move(summary), std::move(sink.trajectory())};
}

void check_same(const Run& a, const Run& b, double within_mm) {
  REQUIRE(a.summary);
  REQUIRE(b.summary);
  const auto &some = a.trajectory.frames, &others = b.trajectory.frames;
  REQUIRE(some.size() == others.size());
  for (std::size_t k = 0; k < some.size(); ++k) {
    CHECK(max_column_norm(some[k].nodes - others[k].nodes) <= within_mm);
    CHECK(some[k].negative_pivots == others[k].negative_pivots);
    CHECK(some[k].event == others[k].event);
  }
  CHECK(a.summary->limit_reason == b.summary->limit_reason);
}

}  // namespace

TEST_CASE("a run that is stopped on its path continues from there, to the same states",
          "[standard]") {
  const TemporaryFolder folder;
  const Run whole = run_with({});
  // on a busy machine a run may end before it is cancelled; then it is started again
  bool stopped = false;
  for (int k = 0; k < 20 && !stopped; ++k) {
    for (const fs::path& file : files_in(folder)) fs::remove(file);
    stopped = !run_with(folder, 0.3).summary;
  }
  REQUIRE(stopped);
  REQUIRE(files_in(folder).size() >= 2);
  // equal to a thousandth of the tolerance
  check_same(whole, run_with(folder), 1e-3 * 1e-3 * 126);
}

TEST_CASE("a path that was kept whole gives the same bits, and what is damaged is followed again",
          "[standard]") {
  const TemporaryFolder folder;
  const Run first = run_with(folder);
  const auto kept = files_in(folder);
  REQUIRE(kept.size() >= 2);
  check_same(first, run_with(folder), 0);
  std::string bytes = read_file(kept[0]).value();
  bytes[bytes.size() / 2] ^= 1;
  REQUIRE(write_file(kept[0], bytes));
  REQUIRE(write_file(kept[1], "segment"));
  check_same(first, run_with(folder), 0);
}

TEST_CASE("a segment that begins elsewhere is none of the run") {
  const TemporaryFolder folder;
  SavedSegment segment;
  segment.begin = {7, 0, 1, {4, 8}};
  segment.end = Outcome::reached;
  SavedSegments segments(folder, 0);
  CHECK_FALSE(segments.next(segment.begin));
  segments.save(segment);
  CHECK(SavedSegments(folder).next(segment.begin)->end == Outcome::reached);
  CHECK_FALSE(SavedSegments(folder).next({8, 0, 1, {4, 8}}));
  CHECK_FALSE(SavedSegments(folder).next({7, 0, 1, {4, 8, 16}}));
}

TEST_CASE("the history of the lowest stiffness is complete after a restart") {
  const TemporaryFolder folder;
  SavedSegment segment;
  for (const double stiffness : {10.0, 6.0, 3.0, 2.0})
    segment.lowest_stiffness.push_back({1 / stiffness, stiffness});
  CHECK(near_zero(segment.lowest_stiffness));
  SavedSegments segments(folder, 0);
  CHECK_FALSE(segments.next(segment.begin));
  segments.save(segment);
  const auto restarted = SavedSegments(folder).next(segment.begin);
  REQUIRE(restarted);
  CHECK(near_zero(restarted->lowest_stiffness));
  CHECK(shortened_step(restarted->lowest_stiffness, 1) ==
        shortened_step(segment.lowest_stiffness, 1));
  CHECK(shortened_step(segment.lowest_stiffness, 1) < 1);
}
