// Journals have every frame on the disk as soon as it is found, so that those of a killed run can
// be read.
#include <random>

#include "engine/core/file_io.h"
#include "engine/record/journal.h"
#include "tests/engine/record/sample_run.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::record;
namespace fs = std::filesystem;

namespace {

Frame frame_of(int index) {
  Frame frame = sample_trajectory().frames[2];
  frame.index = index;
  frame.progress = index / 100.0;
  return frame;
}

/// a journal of frames 0 ... count - 1 of the sample
std::string journal_of(int count) {
  const TemporaryFolder folder;
  auto journal = value_of(JournalWriter::create(folder / "j", {"s1_actuation", Kind::movie},
                                                sample_trajectory().layout));
  for (int k = 0; k < count; ++k) REQUIRE(journal.append(frame_of(k)));
  return read_file(folder / "j").value();
}

Result<Journal> read_bytes(const std::string& bytes) {
  const TemporaryFolder folder;
  REQUIRE(write_file(folder / "j", bytes));
  return read_journal(folder / "j", false);
}

}  // namespace

TEST_CASE("frames come back from a journal in order of their index, bit for bit") {
  const TemporaryFolder folder;
  const Trajectory run = sample_trajectory();
  auto journal =
      value_of(JournalWriter::create(folder / "j", {"s1_actuation", Kind::figure}, run.layout));
  for (const std::size_t k : {2, 0, 1}) REQUIRE(journal.append(run.frames[k]));
  // found again: the later one counts
  Frame again = run.frames[1];
  again.event = "again";
  REQUIRE(journal.append(again));
  CHECK(journal.frames() == 3);
  const auto back = value_of(read_journal(folder / "j"));
  CHECK(back.name.preset == "s1_actuation");
  CHECK(back.name.kind == Kind::figure);
  CHECK(back.trajectory.layout.rods == run.layout.rods);
  const FrameList& frames = back.trajectory.frames;
  REQUIRE(frames.size() == 3);
  for (std::size_t k = 0; k < 3; ++k)
    CHECK(packed_frame(frames[k]) == packed_frame(k == 1 ? again : run.frames[k]));
}

TEST_CASE("a journal cut anywhere reads up to its last whole frame", "[standard]") {
  const std::string whole = journal_of(4), three = journal_of(3), none = journal_of(0);
  const std::size_t a_frame = whole.size() - three.size();
  REQUIRE(three.size() == none.size() + 3 * a_frame);
  for (std::size_t size = 0; size <= whole.size(); size += 7) {
    const auto read = read_bytes(whole.substr(0, size));
    INFO(size);
    REQUIRE(bool(read) == (size >= none.size()));
    if (read) CHECK(read->trajectory.frames.size() == (size - none.size()) / a_frame);
  }
}

TEST_CASE("a journal with a changed bit reads up to the frame before it") {
  const std::string whole = journal_of(4), none = journal_of(0);
  const std::size_t a_frame = (whole.size() - none.size()) / 4;
  std::mt19937 random(1);
  for (int trial = 0; trial < 300; ++trial) {
    const std::size_t at = random() % whole.size();
    std::string wrong = whole;
    wrong[at] = char(wrong[at] ^ (1 << random() % 8));
    const auto read = read_bytes(wrong);
    INFO(at);
    REQUIRE(bool(read) == (at >= none.size()));
    if (read) CHECK(read->trajectory.frames.size() == (at - none.size()) / a_frame);
  }
}

TEST_CASE("frames of another shell are left out of a journal") {
  const TemporaryFolder folder;
  const Trajectory run = sample_trajectory();
  auto journal = value_of(JournalWriter::create(folder / "j", {"x", Kind::run}, run.layout));
  REQUIRE(journal.append(run.frames[0]));
  Frame other = run.frames[1];
  other.nodes.conservativeResize(3, 11);
  REQUIRE(journal.append(other));
  REQUIRE(journal.append(run.frames[2]));
  const auto back = value_of(read_journal(folder / "j"));
  CHECK(back.trajectory.frames.size() == 2);
}

TEST_CASE("a frame of an older version, which kept no forces, is read without them") {
  Frame frame = sample_trajectory().frames[1];
  const std::string head = packed_head({"s1_actuation", Kind::run}, {});
  const auto columns = unpacked_head(head)->columns;
  // nine empty matrices, each its rows and columns
  const std::string packed = packed_frame(frame);
  const auto old = value_of(unpacked_frame(packed.substr(0, packed.size() - 144), columns));
  // the last six were added later, one after the other
  for (const int bytes : {16, 32, 48, 64, 80, 96})
    CHECK(unpacked_frame(packed.substr(0, packed.size() - std::size_t(bytes)), columns));
  CHECK(same_bits(old.nodes, frame.nodes));
  CHECK(same_bits(old.K_bins, frame.K_bins));
  CHECK(old.axial_force_N.size() == 0);
  CHECK_FALSE(unpacked_frame(packed.substr(0, packed.size() - 24), columns));
}

TEST_CASE("frames in any order give the same files of a run") {
  const TemporaryFolder folder;
  Trajectory run = sample_trajectory();
  run.origin = {"A title", "s1_actuation", std::string("gridshell ") + version()};
  REQUIRE(write_run(folder / "at once", run, sample_summary()));
  FolderSink sink(folder / "found", {"s1_actuation", Kind::run, "A title"});
  REQUIRE(sink.begin(run.layout));
  for (const std::size_t k : {1, 2, 0}) REQUIRE(sink.take(run.frames[k]));
  const auto finished = value_of(sink.finish(sample_summary()));
  // the frames are read from the journal, whose name is removed already
  CHECK(same_bits(finished.frames[1].nodes, run.frames[1].nodes));
  for (const char* name : {"frames.csv", "joints.csv", "cells.csv", "bins.csv", "seams.csv",
                           "trajectory.h5", "summary.json"}) {
    INFO(name);
    CHECK(read_file(folder / "at once" / name).value() ==
          read_file(folder / "found" / name).value());
  }
  CHECK_FALSE(fs::exists(folder / "found" / journal_name));
}

TEST_CASE("frames of a coarser mesh are kept until the finer one has as many") {
  const TemporaryFolder folder;
  const Layout layout = sample_trajectory().layout;
  const auto found = [&] { return read_journal_of(folder)->trajectory.frames.size(); };
  FolderSink sink(folder, {"s1_actuation", Kind::run});
  REQUIRE(sink.begin(layout));
  for (int k = 0; k < 5; ++k) REQUIRE(sink.take(frame_of(k)));
  REQUIRE(sink.begin(layout));
  CHECK(found() == 5);
  for (int k = 0; k < 4; ++k) REQUIRE(sink.take(frame_of(k)));
  CHECK(found() == 5);
  CHECK(fs::exists(folder / coarser_journal_name));
  for (int k = 4; k < 6; ++k) REQUIRE(sink.take(frame_of(k)));
  CHECK(found() == 6);
  CHECK_FALSE(fs::exists(folder / coarser_journal_name));
}

TEST_CASE("a continued run keeps the frames it had until it has as many") {
  const TemporaryFolder folder;
  const Layout layout = sample_trajectory().layout;
  const auto begun_again = [&](int frames) {
    FolderSink sink(folder, {"s1_actuation", Kind::run});
    REQUIRE(sink.begin(layout));
    for (int k = 0; k < frames; ++k) REQUIRE(sink.take(frame_of(k)));
    return frames_in_journals(folder);
  };
  CHECK(begun_again(5) == 5);
  CHECK(begun_again(0) == 5);
  CHECK(begun_again(2) == 5);
  CHECK(begun_again(6) == 6);
  CHECK_FALSE(fs::exists(folder / coarser_journal_name));
}

TEST_CASE("a disk that fills up leaves a journal of whole frames") {
  const TemporaryFolder folder;
  const std::size_t some = journal_of(3).size();
  FolderSink sink(folder, {"s1_actuation", Kind::run});
  REQUIRE(sink.begin(sample_trajectory().layout));
  {
    const FileSizeLimit full_disk(some + 100);
    for (int k = 0; k < 3; ++k) REQUIRE(sink.take(frame_of(k)));
    CHECK(refusal(sink.take(frame_of(3)), Fault::io) ==
          "cannot write '" + (folder / journal_name).string() + "': File too large");
  }
  CHECK(fs::file_size(folder / journal_name) == some);
  // and continues once there is space
  REQUIRE(sink.take(frame_of(3)));
  CHECK(frames_in_journals(folder) == 4);
}

TEST_CASE("a list of frames on the disk keeps few of them and reads like one in memory") {
  struct Counted : FrameSource {
    std::size_t size() const override { return 1000; }
    Result<Frame> read(std::size_t k) const override {
      ++reads;
      if (k == 500) return fail(Fault::io, "cannot read a frame");
      Frame frame;
      frame.index = int(k);
      frame.nodes = Eigen::Matrix3Xd::Zero(3, 100000);
      return frame;
    }
    mutable int reads = 0;
  };
  const auto source = std::make_shared<Counted>();
  const FrameList frames(source);
  CHECK(frames.size() == 1000);
  CHECK(frames.front().index == 0);
  CHECK(frames.back().index == 999);
  const Frame& first = frames.front();
  int sum = 0;
  for (const Frame& frame : frames) sum += frame.index;
  CHECK(sum == 999 * 1000 / 2 - 500);
  CHECK(source->reads == 1000);
  CHECK(first.index == 0);
  // the frames read last are still there
  CHECK(frames[998].index == 998);
  CHECK(source->reads == 1000);
  REQUIRE(frames.fault());
  CHECK(frames.fault()->message == "cannot read a frame");
}
