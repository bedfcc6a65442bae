// The program's pictures against those that were looked at and kept in tests/images.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "engine/core/file_io.h"
#include "render/gl/image.h"
#include "tests/app/program.h"
#include "tests/temporary_folder.h"

namespace fs = std::filesystem;
using namespace gridshell;

namespace {

const fs::path images = fs::path(GRIDSHELL_SOURCE_DIR) / "tests/images";

std::string frame_name(int frame) { return "frame_0000" + std::to_string(frame) + ".png"; }

render::Image picture(const fs::path& path) {
  auto image = render::read_png(path);
  if (!image) FAIL(image.error().message);
  return std::move(*image);
}

double worst(const render::Image& a, const render::Image& b) {
  const auto comparison = render::compare(a, b);
  if (!comparison) FAIL(comparison.error().message);
  return comparison->difference;
}

/// The arguments of the list's line of that name, and where to write.
std::vector<std::string> arguments_of(const std::string& name, const fs::path& to) {
  std::ifstream list(images / "list.txt");
  for (std::string line; std::getline(list, line);) {
    if (!line.starts_with(name + ": ")) continue;
    std::istringstream words(line.substr(name.size() + 2));
    std::vector<std::string> arguments;
    for (std::string word; words >> word;) arguments.push_back(word);
    for (const std::string& word : {std::string("-o"), to.string(), std::string("--quiet")})
      arguments.push_back(word);
    return arguments;
  }
  FAIL("no line of that name");
  return {};
}

}  // namespace

TEST_CASE("movie S1 looks as its kept pictures do") {
  TemporaryFolder folder;
  const Ended ended = gridshell_program(arguments_of("s1_actuation", "s1"), folder.path());
  REQUIRE(ended.code == 0);
  const fs::path kept = images / "s1_actuation/frames";
  for (int frame = 0; frame < 4; ++frame) {
    INFO("frame " << frame);
    const render::Image drawn = picture(folder.path() / "s1/frames" / frame_name(frame));
    CHECK(worst(drawn, picture(kept / frame_name(frame))) <= render::default_difference_threshold);
    // the threshold tells a frame from its neighbour
    CHECK(worst(drawn, picture(kept / frame_name((frame + 1) % 4))) >
          render::default_difference_threshold);
  }
}

TEST_CASE("every preset and figure looks as its kept pictures do, in either context", "[full]") {
  const TemporaryFolder folder;
  const fs::path at = folder.path();
  const auto check_kept = [&](const char* drawn) {
    const Ended ended = gridshell_program({"compare", images.string(), drawn}, at);
    INFO(drawn << "\n" << ended.out << ended.err);
    CHECK(ended.code == 0);
  };
  const std::string command = "cd '" + at.string() + "' && RUNS=runs '" +
                              (images / "draw.sh").string() + "' '" + GRIDSHELL_PROGRAM +
                              "' osmesa --context osmesa";
  REQUIRE(std::system(command.c_str()) == 0);
  check_kept("osmesa");
  // the other context draws the same runs again, by the processor too
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  for (const auto& run : fs::directory_iterator(at / "runs")) {
    const auto name = run.path().filename().string();
    const Ended ended = gridshell_program(
        {"render", "runs/" + name, "-o", "egl/" + name, "--context", "egl", "--quiet"}, at);
    INFO(name << "\n" << ended.err);
    CHECK(ended.code == 0);
  }
  const std::string visits = "cd '" + at.string() + "' && '" + (images / "visits.sh").string() +
                             "' '" + GRIDSHELL_PROGRAM + "' egl --context egl";
  REQUIRE(std::system(visits.c_str()) == 0);
  check_kept("egl");
}

TEST_CASE("another rasteriser's width, another processor, a finer tolerance look the same",
          "[full]") {
  // not LP_NATIVE_VECTOR_WIDTH=128: with AVX beside it Mesa 22 frees memory twice; sse2 has it
  for (const char* variation :
       {"LP_NATIVE_VECTOR_WIDTH=256", "LP_NUM_THREADS=0", "GALLIUM_OVERRIDE_CPU_CAPS=nosse",
        "GALLIUM_OVERRIDE_CPU_CAPS=sse2", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
        "GALLIUM_OVERRIDE_CPU_CAPS=avx", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2", "finer"}) {
    TemporaryFolder folder;
    const bool finer = std::string(variation) == "finer";
    std::string command = "cd '" + folder.path().string() + "' && " + (finer ? "" : variation) +
                          " '" + GRIDSHELL_PROGRAM + "'";
    for (const std::string& word : arguments_of("s1_actuation", "s1")) command += " " + word;
    if (finer) command += " --set accuracy.tolerance=1e-6";
    REQUIRE(std::system(command.c_str()) == 0);
    INFO(variation);
    for (int frame = 0; frame < 4; ++frame)
      CHECK(worst(picture(folder.path() / "s1/frames" / frame_name(frame)),
                  picture(images / "s1_actuation/frames" / frame_name(frame))) <=
            render::default_difference_threshold);
  }
}

TEST_CASE("folders of pictures are compared, shown on a sheet, and replaced with a reason") {
  TemporaryFolder folder;
  const auto paint = [](int grey) {
    render::Image image(40, 30);
    for (std::size_t k = 0; k < image.rgba.size(); ++k)
      image.rgba[k] = k % 4 == 3 ? 255 : std::uint8_t(grey);
    return image;
  };
  const fs::path kept = folder.path() / "kept", now = folder.path() / "now";
  for (const auto& [file, grey] : {std::pair{kept / "same.png", 90},
                                   {now / "same.png", 91},
                                   {kept / "in/other.png", 90},
                                   {now / "in/other.png", 200},
                                   {kept / "gone.png", 10},
                                   {now / "new.png", 20}}) {
    REQUIRE(make_folder(file.parent_path()));
    REQUIRE(render::write_png(paint(grey), file));
  }
  const auto compare = [&](std::vector<std::string> more) {
    more.insert(more.begin(), {"compare", "kept", "now"});
    return gridshell_program(more, folder.path());
  };
  const Ended first = compare({"--difference", "sheet.png"});
  CHECK(first.code == 3);
  CHECK(first.out.find("in/other.png: differs by 110.00") != std::string::npos);
  CHECK(first.out.find("gone.png: is gone") != std::string::npos);
  CHECK(first.out.find("new.png: is new") != std::string::npos);
  CHECK(first.out.find("same.png") == std::string::npos);
  CHECK(first.out.find("3 of 4 pictures differ") != std::string::npos);
  const auto sheet = render::read_png(folder.path() / "sheet.png");
  REQUIRE(sheet);
  CHECK(sheet->width > 1400);

  CHECK(compare({"--update"}).code == 2);
  CHECK(fs::exists(kept / "gone.png"));
  CHECK(compare({"--update", "--why", "a lighter grey"}).code == 0);
  CHECK(compare({}).code == 0);
  CHECK_FALSE(fs::exists(kept / "gone.png"));
  const auto why = read_file(kept / "WHY.md");
  REQUIRE(why);
  CHECK(why->find("a lighter grey (gone.png, in/other.png, new.png)") != std::string::npos);
  CHECK(gridshell_program({"compare", "kept", "now/same.png"}, folder.path()).code == 2);
}
