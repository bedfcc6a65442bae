#include <catch2/catch.hpp>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

#include "engine/core/atomic_file.h"
#include "render/movie/encode.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
namespace fs = std::filesystem;

namespace {

// a PATH of one folder, with a made-up ffmpeg in it or none
class FakeFfmpeg {
 public:
  explicit FakeFfmpeg(const std::string& script) : before_(std::getenv("PATH")) {
    if (!script.empty()) {
      const fs::path program = folder_.path() / "ffmpeg";
      std::ofstream(program) << "#!/bin/sh\n" << script;
      fs::permissions(program, fs::perms::owner_all);
    }
    setenv("PATH", folder_.path().c_str(), 1);
  }
  ~FakeFfmpeg() { setenv("PATH", before_.c_str(), 1); }

 private:
  TemporaryFolder folder_;
  std::string before_;
};

}  // namespace

TEST_CASE("without ffmpeg the command line is told instead, ready for a shell") {
  const FakeFfmpeg none("");
  const TemporaryFolder folder;
  const auto encoding = encode_movie("out/my run/frames", 30, folder.path() / "movie.mp4", {});
  REQUIRE(encoding);
  CHECK_FALSE(encoding->made);
  CHECK(encoding->command.find("ffmpeg -nostdin -y") == 0);
  CHECK(encoding->command.find("'file:out/my run/frames/frame_%05d.png'") != std::string::npos);
  CHECK(encoding->command.find("-framerate 30") != std::string::npos);
  CHECK(folder.entries().empty());
}

TEST_CASE("with ffmpeg the movie appears whole, under its name") {
  // the last argument is the file; everything it was given goes into it
  const FakeFfmpeg ffmpeg("for last; do :; done\nprintf '%s\\n' \"$@\" > \"${last#file:}\"\n");
  const TemporaryFolder folder;
  const auto encoding = encode_movie("frames of 100%", 25, folder.path() / "movie.mp4", {});
  REQUIRE(encoding);
  CHECK(encoding->made);
  CHECK(folder.entries() == std::vector<std::string>{"movie.mp4"});
  const auto arguments = read_whole(folder.path() / "movie.mp4");
  REQUIRE(arguments);
  CHECK(arguments->find("\nfile:frames of 100%%/frame_%05d.png\n") != std::string::npos);
  CHECK(arguments->find("\n-framerate\n25\n") != std::string::npos);
}

TEST_CASE("a failing ffmpeg is an error with its last words and leaves nothing") {
  const FakeFfmpeg ffmpeg(
      "for last; do :; done\necho half > \"${last#file:}\"\n"
      "echo 'first line' >&2\necho 'Unknown encoder libx264' >&2\nexit 8\n");
  const TemporaryFolder folder;
  const auto encoding = encode_movie("frames", 30, folder.path() / "movie.mp4", {});
  REQUIRE_FALSE(encoding);
  CHECK(encoding.error().fault == Fault::io);
  CHECK(encoding.error().message.find("failed with exit code 8: Unknown encoder libx264") !=
        std::string::npos);
  CHECK(folder.entries().empty());
}

TEST_CASE("a cancel ends ffmpeg within a second") {
  const FakeFfmpeg ffmpeg("exec /bin/sleep 30\n");
  const TemporaryFolder folder;
  Watch watch;
  const auto start = std::chrono::steady_clock::now();
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    watch.cancel();
  });
  const auto encoding = encode_movie("frames", 30, folder.path() / "movie.mp4", watch);
  stopper.join();
  REQUIRE_FALSE(encoding);
  CHECK(encoding.error().fault == Fault::cancelled);
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(2));
  CHECK(folder.entries().empty());
}

TEST_CASE("a shell reads the words back as they were") {
  const std::vector<std::string> words = {"plain", "two words", "it's", "", "$HOME", "a=b", "é"};
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();
  REQUIRE(std::system(("printf '%s\\n' " + shell_line(words) + " > " + out).c_str()) == 0);
  std::string expected;
  for (const std::string& word : words) expected += word + "\n";
  CHECK(read_whole(out).value() == expected);
}
