// Undo and redo after a command that was refused, or that threw an exception.
#include <fcntl.h>
#include <unistd.h>

#include <filesystem>
#include <new>
#include <string>

#include "tests/app/window/edited_shell.h"
#include "tests/results.h"

using namespace gridshell;
using namespace gridshell::window;

TEST_CASE("a change that is refused leaves what was undone to be done again") {
  // also where older states are moved to a file
  EditedShell shell(small_shell(), GENERATE(0, 1 << 20));
  shell.act(Move{0.4});
  const ShellView moved = shell.view();
  shell.act(Undo{});
  const ShellView before = shell.view();
  preset::Preset wrong = before.preset;
  wrong.footprint.radius_mm = 1;
  CHECK(shell.attempt(Change{wrong}) != "");
  CHECK(shell.attempt(Push{-3}) == "no such joint");
  CHECK(shell.view().redo_steps == 1);
  CHECK(shell.view().undo_steps == before.undo_steps);
  shell.act(Redo{});
  CHECK(difference(shell, moved) == 0);
  // only another step makes redoing impossible
  shell.act(Undo{});
  shell.act(Move{0.3});
  CHECK(shell.view().redo_steps == 0);
}

TEST_CASE("an exception on the path is an error, and the shell is as before the command") {
  EditedShell shell;
  shell.act(Move{0.4});
  shell.act(Undo{});
  const ShellView before = shell.view();
  const int joint = shell.joint(0, 0);
  const Eigen::Vector3d normal = shell.view().normals.col(joint), from = shell.node(joint);
  bool throws = true;
  // a long displacement that is typed shows its equilibria as they are computed
  shell.session.set_listener([&](const ShellView&) {
    if (throws) throw std::bad_alloc();
  });
  shell.session.execute({Push{joint, from - 6 * normal, normal}, 1, true}, unwatched);
  CHECK(shell.view().error == "memory ran out");
  CHECK(difference(shell, before) == 0);
  CHECK(shell.view().steps.empty());
  CHECK(shell.view().constrained.empty());
  CHECK(shell.view().undo_steps == before.undo_steps);
  CHECK(shell.view().redo_steps == 1);
  throws = false;
  shell.session.execute({Push{joint, from - 6 * normal, normal}, 2, true}, unwatched);
  CHECK(shell.view().error.empty());
  CHECK(shell.view().steps.size() == 1);
}

namespace {

/// Empties the file without a name that this process opened last, and returns its contents.
std::pair<int, std::string> emptied_scratch_file() {
  int file = -1;
  for (const auto& open : std::filesystem::directory_iterator("/proc/self/fd")) {
    std::error_code error;
    const auto target = std::filesystem::read_symlink(open.path(), error).string();
    if (target.ends_with(" (deleted)")) file = std::max(file, std::stoi(open.path().filename()));
  }
  REQUIRE(file >= 0);
  std::string bytes(std::size_t(::lseek(file, 0, SEEK_END)), 0);
  REQUIRE(::pread(file, bytes.data(), bytes.size(), 0) == ssize_t(bytes.size()));
  REQUIRE(::ftruncate(file, 0) == 0);
  return {file, bytes};
}

}  // namespace

TEST_CASE("a step whose file cannot be read is not undone, and is once it can be") {
  // with 0 bytes only the latest state is in memory
  EditedShell shell(small_shell(), 0);
  shell.act(Move{0.9});
  const ShellView moved = shell.view();
  shell.act(Move{0.8});
  shell.act(Move{0.7});
  shell.act(Undo{});
  const ShellView before = shell.view();
  const auto [file, bytes] = emptied_scratch_file();
  for (int k = 0; k < 2; ++k) {
    CHECK_THAT(shell.attempt(Undo{}), Catch::Contains("cannot be read"));
    CHECK(difference(shell, before) == 0);
  }
  REQUIRE(::pwrite(file, bytes.data(), bytes.size(), 0) == ssize_t(bytes.size()));
  shell.act(Undo{});
  CHECK(difference(shell, moved) == 0);
}
