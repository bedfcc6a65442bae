#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

#include "engine/core/file_io.h"
#include "render/gl/image.h"
#include "render/movie/encode.h"
#include "render/movie/movie_style.h"
#include "render/movie/movie_writer.h"
#include "tests/results.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::render;
namespace fs = std::filesystem;

namespace {

/// Six frames at 20 a second, the last one repeated, after a title.
preset::Movie of_size(int width, int height) {
  preset::Movie timing;
  timing.frames = 6;
  timing.size = {width, height};
  timing.fps = 20;
  timing.seconds = 0.3;
  timing.hold_s = timing.title_s = 0.5;
  return timing;
}

/// Pictures of one size that differ.
Image shade(int k) {
  Image image(64, 49);
  for (std::size_t n = 0; n < image.rgba.size(); ++n)
    image.rgba[n] = n % 4 == 3 ? 255 : std::uint8_t(40 * k + int(n / 64) % 7);
  return image;
}

/// Six of them as frames, and the title's card, in a folder.
fs::path six_frames(const fs::path& folder, const std::string& title = "") {
  MovieStyle style;
  style.size = {64, 49};
  style.title = title;
  REQUIRE(make_folder(folder / "frames"));
  REQUIRE(write_png(value_of(title_card(style)), folder / "title.png"));
  for (int k = 0; k < 6; ++k) REQUIRE(write_png(shade(k), folder / "frames" / frame_name(k)));
  return folder / "frames";
}

/// Cancels `work` after 150 ms; it must end as cancelled within 10 s, and would take 30 s
/// otherwise.
template <class Work>
void check_cancelled(Work work) {
  Watch watch;
  const auto start = std::chrono::steady_clock::now();
  std::thread stopper([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(150));
    watch.cancel();
  });
  const auto ended = work(watch);
  stopper.join();
  CHECK_THAT(refusal(ended, Fault::cancelled), Catch::StartsWith("stopped "));
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
}

// a PATH of one folder, with a made-up ffmpeg in it or none
class FakeFfmpeg {
 public:
  explicit FakeFfmpeg(const std::string& script) : path_("PATH", folder_.path().string()) {
    if (script.empty()) return;
    std::ofstream(folder_ / "ffmpeg") << "#!/bin/sh\n" << script;
    fs::permissions(folder_ / "ffmpeg", fs::perms::owner_all);
  }

 private:
  TemporaryFolder folder_;
  Environment path_;
};

}  // namespace

TEST_CASE("without ffmpeg the command line is printed instead, ready for a shell") {
  const FakeFfmpeg none("");
  const TemporaryFolder folder;
  REQUIRE(encode_movie("out/my run/frames", {}, folder / "movie.mp4", {}));
  CHECK(folder.entries().empty());
  const auto line = shell_line(encode_arguments("out/my run/frames", {}, "movie.mp4"));
  CHECK(line.find("ffmpeg -nostdin -y") == 0);
  CHECK(line.find("'file:out/my run/frames/frame_%05d.png'") != std::string::npos);
  CHECK(line.find("-framerate 30") != std::string::npos);
}

TEST_CASE("with ffmpeg the movie appears whole, under its name") {
  // a program that writes all its arguments to the file that the last one names
  const FakeFfmpeg ffmpeg("for last; do :; done\nprintf '%s\\n' \"$@\" > \"${last#file:}\"\n");
  const TemporaryFolder folder;
  preset::Movie slow;
  slow.fps = 25;
  REQUIRE(encode_movie("frames of 100%", slow, folder / "movie.mp4", {}));
  CHECK(folder.entries() == std::vector<std::string>{"movie.mp4"});
  const auto arguments = value_of(read_file(folder / "movie.mp4"));
  CHECK(arguments.find("\nfile:frames of 100%%/frame_%05d.png\n") != std::string::npos);
  CHECK(arguments.find("\n-framerate\n25\n") != std::string::npos);
}

TEST_CASE("a failing ffmpeg is an error with its last words and leaves nothing") {
  const FakeFfmpeg ffmpeg(
      "for last; do :; done\necho half > \"${last#file:}\"\n"
      "echo 'first line' >&2\necho 'Unknown encoder libx264' >&2\nexit 8\n");
  const TemporaryFolder folder;
  CHECK_THAT(refusal(encode_movie("frames", {}, folder / "movie.mp4", {}), Fault::io),
             Catch::Contains("failed with exit code 8: Unknown encoder libx264"));
  CHECK(folder.entries().empty());
}

TEST_CASE("a cancel ends ffmpeg before its time") {
  const FakeFfmpeg ffmpeg("exec /bin/sleep 30\n");
  const TemporaryFolder folder;
  check_cancelled(
      [&](Watch& watch) { return encode_movie("frames", {}, folder / "movie.mp4", watch); });
  CHECK(folder.entries().empty());
}

TEST_CASE("a cancel ends an ffmpeg that does not listen to it") {
  const FakeFfmpeg deaf("trap '' TERM\nexec /bin/sleep 30\n");
  const TemporaryFolder folder;
  check_cancelled(
      [&](Watch& watch) { return encode_movie("frames", {}, folder / "movie.mp4", watch); });
}

TEST_CASE("a shell reads the words back as they were") {
  const std::vector<std::string> words = {"plain", "two words", "it's", "", "$HOME", "a=b", "é"};
  const TemporaryFolder folder;
  const std::string out = (folder / "out").string();
  REQUIRE(std::system(("printf '%s\\n' " + shell_line(words) + " > " + out).c_str()) == 0);
  std::string expected;
  for (const std::string& word : words) expected += word + "\n";
  CHECK(read_file(out).value() == expected);
}

TEST_CASE("`hold`, pace, title card and the kind of file are in the command") {
  const auto line = [](const preset::Movie& timing, const char* file) {
    return shell_line(encode_arguments("frames", timing, file));
  };
  preset::Movie held, timed, eased, titled;
  held.hold_first_s = 1;
  held.hold_s = 1.5;
  timed.frames = eased.frames = 60;
  timed.seconds = 4;
  eased.pace = Pace::eased;
  titled.title_s = 2;
  CHECK_THAT(line(held, "m.mp4"),
             Catch::Contains(
                 "tpad=start_mode=clone:start_duration=1.000:stop_mode=clone:stop_duration=1.500"));
  CHECK_THAT(line(timed, "m.mp4"), Catch::Contains("N*0.066667/TB"));
  CHECK_THAT(line(eased, "m.mp4"), Catch::Contains("asin(1-2*N/59)"));
  CHECK_THAT(line(titled, "m.mp4"), Catch::Contains("file:title.png"));
  CHECK_THAT(line({}, "m.mp4"), Catch::Contains("-color_primaries bt709"));
  CHECK_THAT(line({}, "m.webm"), Catch::Contains("libvpx-vp9"));
  CHECK_THAT(line({}, "m.gif"), Catch::Contains("paletteuse"));
}

TEST_CASE("a real ffmpeg makes movies of the requested length", "[standard]") {
  if (find_program("ffmpeg").empty() || find_program("ffprobe").empty()) {
    WARN("no ffmpeg, skipped");
    return;
  }
  const TemporaryFolder folder;
  const fs::path frames = six_frames(folder, "a title");
  preset::Movie timing = of_size(64, 49);
  timing.seconds = 1;
  timing.pace = Pace::eased;
  for (const char* name : {"movie.mp4", "movie.webm", "movie.gif"}) {
    INFO(name);
    REQUIRE(encode_movie(frames, timing, folder / name, {}));
    const std::string probe =
        "ffprobe -v error -show_entries format=duration:stream=color_primaries "
        "-of default=nk=1:nw=1 " +
        shell_line({(folder / name).string()}) + " > " + shell_line({(folder / "probe").string()});
    REQUIRE(std::system(probe.c_str()) == 0);
    const auto said = value_of(read_file(folder / "probe"));
    const bool gif = std::string(name) == "movie.gif";
    if (!gif) CHECK(said.find("bt709") != std::string::npos);
    std::istringstream lines(said);
    double seconds = 0;
    for (std::string line; std::getline(lines, line);)
      if (!line.empty() && std::isdigit(static_cast<unsigned char>(line[0])))
        seconds = std::stod(line);
    CHECK(seconds == Approx(2.0).margin(0.15));
  }
}

TEST_CASE("a movie made while its frames are drawn is that of the frames, to the bit") {
  if (find_program("ffmpeg").empty()) {
    WARN("no ffmpeg, skipped");
    return;
  }
  const TemporaryFolder folder;
  const fs::path frames = six_frames(folder);
  const preset::Movie timing = of_size(64, 49);
  auto movie = value_of(MovieEncoder::begin(frames, timing, folder / "a.mp4"));
  REQUIRE(movie);
  for (int k = 0; k < 6; ++k) movie->put(shade(k), unwatched);
  CHECK_FALSE(fs::exists(folder / "a.mp4"));
  REQUIRE(movie->finish(unwatched));
  REQUIRE(encode_movie(frames, timing, folder / "b.mp4", unwatched));
  CHECK(read_file(folder / "a.mp4").value() == read_file(folder / "b.mp4").value());
}

TEST_CASE("without ffmpeg no movie is in the making, and one that stops reading is an error") {
  const TemporaryFolder folder;
  const Image large(800, 600);  // more than the buffer of a socket
  {
    const FakeFfmpeg none("");
    const auto movie = value_of(MovieEncoder::begin("frames", of_size(800, 600), folder / "m.mp4"));
    CHECK_FALSE(movie);
  }
  const FakeFfmpeg broken("echo 'No space left on device' >&2\nexit 3\n");
  auto movie = value_of(MovieEncoder::begin("frames", of_size(800, 600), folder / "m.mp4"));
  for (int k = 0; k < 3; ++k) movie->put(large, unwatched);
  CHECK_THAT(refusal(movie->finish(unwatched), Fault::io),
             Catch::Contains("exit code 3: No space left on device"));
  CHECK(folder.entries().empty());
}

TEST_CASE("a movie that is given up, or cancelled while ffmpeg takes nothing, leaves nothing") {
  const TemporaryFolder folder;
  const FakeFfmpeg slow("exec /bin/sleep 30\n");
  const auto begun = [&] {
    return value_of(MovieEncoder::begin("frames", of_size(800, 600), folder / "m.mp4"));
  };
  REQUIRE(begun());
  check_cancelled([movie = begun()](Watch& watch) mutable {
    movie->put(Image(800, 600), watch);
    return movie->finish(watch);
  });
  CHECK(folder.entries().empty());
}

TEST_CASE("few frames are shown longer, up to a quarter of a second each and four in all") {
  const auto chain_of = [](int frames, double seconds) {
    preset::Movie timing = of_size(64, 48);
    timing.frames = frames;
    timing.seconds = seconds;
    return shell_line(encode_arguments("frames", timing, "movie.mp4"));
  };
  CHECK(chain_of(6, 0).find("N*0.250000/TB") != std::string::npos);
  CHECK(chain_of(40, 0).find("N*0.100000/TB") != std::string::npos);
  CHECK(chain_of(80, 0).find("setpts") == std::string::npos);  // four seconds at 20 a second
  CHECK(chain_of(6, 0.3).find("setpts") == std::string::npos);
}
