// The program's pictures compared with those in tests/images, which were looked at and saved.
#include <map>

#include "render/gl/image.h"
#include "tests/app/bench.h"
#include "tests/results.h"

using namespace gridshell;

namespace {

const fs::path images = fs::path(GRIDSHELL_SOURCE_DIR) / "tests/images";

std::string frame_name(int frame) { return "frame_0000" + std::to_string(frame) + ".png"; }

render::Image picture(const fs::path& path) { return value_of(render::read_png(path)); }

double worst(const render::Image& a, const render::Image& b) {
  return value_of(render::compare(a, b)).difference;
}

/// The lines of the list: a name, and the program's arguments.
std::map<std::string, std::string> list() {
  std::map<std::string, std::string> lines;
  std::ifstream file(images / "list.txt");
  for (std::string line; std::getline(file, line);)
    if (const auto end = line.find(": "); !line.starts_with('#') && end != line.npos)
      lines[line.substr(0, end)] = line.substr(end + 2);
  return lines;
}

void check_kept(const std::string& name, const fs::path& drawn) {
  const TemporaryFolder folder;
  const Ended ended = gridshell_program(
      {"compare", (images / name).string(), drawn.string(), "--selected"}, folder);
  INFO(drawn << "\n" << ended.out << ended.err);
  CHECK(ended.code == 0);
}

/// The part of a picture between the window's panels.
render::Image middle(const render::Image& all) {
  const int left = all.width * 9 / 20, top = all.height / 10;
  render::Image part(all.width * 3 / 10, all.height * 3 / 4);
  for (int y = 0; y < part.height; ++y)
    std::copy_n(all.pixel(left, top + y), 4 * part.width, part.pixel(0, y));
  return part;
}

/// Compares pictures of the window with the saved ones. Other versions of ImGui draw other widgets
/// and move a slider to another value under the same mouse.
void check_kept_window(const fs::path& drawn) {
  const std::string imgui = "1.86";  // version that drew the saved pictures
  if (imgui == GRIDSHELL_IMGUI) return check_kept("window", drawn);
  WARN("ImGui " << GRIDSHELL_IMGUI << ", kept pictures are of " << imgui
                << ": only what lies between the panels is compared, after no slider was dragged");
  const auto kept = files_under(images / "window", ".png");
  CHECK(files_under(drawn, ".png").size() == kept.size());
  for (const fs::path& file : kept) {
    INFO(file);
    if (file.stem() == "slider" || file.stem() == "unstable") continue;
    CHECK(worst(middle(picture(file)), middle(picture(drawn / file.filename()))) <=
          render::default_difference_threshold);
  }
}

}  // namespace

TEST_CASE("every preset is run, and kept pictures are few, small and each of a run") {
  std::string all;
  for (const auto& [name, arguments] : list()) all += arguments + " ";
  for (const auto& file : files_under(fs::path(GRIDSHELL_SOURCE_DIR) / "presets", ".toml"))
    CHECK_THAT(all, Contains(" " + file.stem().string() + " "));
  const auto pictures = files_under(images, ".png");
  CHECK(pictures.size() <= 150);
  std::uintmax_t bytes = 0;
  for (const fs::path& picture : pictures) {
    const std::string run = picture.lexically_relative(images).begin()->string();
    INFO(picture);
    CHECK((run == "window" || list().contains(run)));
    bytes += fs::file_size(picture);
  }
  CHECK(bytes <= 9'000'000);
}

TEST_CASE("every kind of picture and visit of the window looks as kept", "[shared]") {
  for (const auto& [name, arguments] : list()) {
    const fs::path run = shared_run(name);
    if (fs::exists(images / name)) check_kept(name, run);
  }
  check_kept_window(shared_run("window"));
  // the threshold distinguishes a frame from its neighbour
  const fs::path kept = images / "s1_actuation/frames";
  for (int frame = 0; frame < 4; ++frame)
    CHECK(worst(picture(kept / frame_name(frame)), picture(kept / frame_name((frame + 1) % 4))) >
          render::default_difference_threshold);
}

TEST_CASE("every picture is the same in either context", "[full][shared]") {
  const TemporaryFolder at;
  // EGL draws by the processor, too, as OSMesa does
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  for (const std::string context : {"osmesa", "egl"}) {
    for (const auto& [name, arguments] : list()) {
      if (!fs::exists(images / name)) continue;
      const Ended ended = gridshell_program(
          {"render", shared_run(name).string(), "-o", name, "--context", context, "--quiet"}, at);
      INFO(name << "\n" << ended.err);
      CHECK(ended.code == 0);
      check_kept(name, at / name);
    }
    const std::string visits = "OPTIONS='--context " + context + "' '" +
                               (images / "draw.sh").string() + "' '" + GRIDSHELL_PROGRAM + "' '" +
                               at.path().string() + "' window";
    REQUIRE(std::system(visits.c_str()) == 0);
    check_kept_window(at / "window");
  }
}

TEST_CASE("another rasteriser's width, another processor, a finer tolerance look the same",
          "[full]") {
  // LP_NATIVE_VECTOR_WIDTH=128 is left out: with AVX Mesa 22 then frees memory twice; the variation
  // sse2 has that width
  for (const char* variation :
       {"LP_NATIVE_VECTOR_WIDTH=256", "LP_NUM_THREADS=0", "GALLIUM_OVERRIDE_CPU_CAPS=nosse",
        "GALLIUM_OVERRIDE_CPU_CAPS=sse2", "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",
        "GALLIUM_OVERRIDE_CPU_CAPS=avx", "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2", "finer"}) {
    TemporaryFolder folder;
    const bool finer = std::string(variation) == "finer";
    std::string command = "cd '" + folder.path().string() + "' && " + (finer ? "" : variation) +
                          " '" + GRIDSHELL_PROGRAM + "' " + list()["s1_actuation"] +
                          " -o s1 --quiet";
    if (finer) command += " --set accuracy.tolerance=1e-6";
    REQUIRE(std::system(command.c_str()) == 0);
    INFO(variation);
    check_kept("s1_actuation", folder / "s1");
  }
}

TEST_CASE("presets that are drawn on one coarse mesh run at their own accuracy", "[full]") {
  const TemporaryFolder folder;
  for (const auto& [name, arguments] : list()) {
    const std::string coarse = " --set accuracy.edges_per_segment=4";
    const auto at = arguments.find(coarse);
    if (at == arguments.npos) continue;
    std::string run = "cd '" + folder.path().string() + "' && '" + GRIDSHELL_PROGRAM + "' run " +
                      name + arguments.substr(at + coarse.size()) + " --frames 5 --quiet";
    INFO(run);
    CHECK(std::system(run.c_str()) == 0);
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
  const fs::path kept = folder / "kept", now = folder / "now";
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
    return gridshell_program(more, folder);
  };
  const Ended selected = compare({"--selected"});
  CHECK_THAT(selected.out, Contains("gone.png: is missing") && !Contains("new.png"));
  CHECK_THAT(selected.out, Contains("2 of 3 pictures differ"));
  const Ended first = compare({"--difference", "sheet.png"});
  CHECK(first.code == 3);
  CHECK_THAT(first.out,
             Contains("in/other.png: differs by 110.00") && Contains("gone.png: is missing"));
  CHECK_THAT(first.out, Contains("new.png: is new") && !Contains("same.png") &&
                            Contains("3 of 4 pictures differ"));
  const auto sheet = value_of(render::read_png(folder / "sheet.png"));
  CHECK(sheet.width > 1400);

  CHECK(compare({"--update"}).code == 2);
  CHECK(fs::exists(kept / "gone.png"));
  CHECK(compare({"--update", "--why", "a lighter grey"}).code == 0);
  CHECK(compare({}).code == 0);
  CHECK_FALSE(fs::exists(kept / "gone.png"));
  const auto why = value_of(read_file(kept / "WHY.md"));
  CHECK(why.find("a lighter grey (gone.png, in, new.png)") != std::string::npos);
  CHECK(gridshell_program("compare kept now/same.png", folder).code == 2);
  // a folder named wrongly neither passes nor removes what is saved
  REQUIRE(make_folder(folder / "empty"));
  check_refused("compare kept empty --update --why typo", folder, Contains("none of the pictures"));
  check_refused("compare empty empty", folder, Contains("none of the pictures"));
  check_refused("compare kept nothing", folder, Contains("'nothing' does not exist"));
  CHECK(compare({}).code == 0);
  // of runs, one that was not made again is neither different nor removed
  REQUIRE(make_folder(kept / "run"));
  REQUIRE(render::write_png(paint(90), kept / "run/frame.png"));
  CHECK(compare({"--selected", "--update", "--why", "one run of two"}).code == 0);
  CHECK(fs::exists(kept / "run/frame.png"));
  CHECK(compare({"--update", "--why", "all runs"}).code == 0);
  CHECK_FALSE(fs::exists(kept / "run/frame.png"));
}

TEST_CASE("a picture of the pages that cannot be written completely leaves the one before it") {
  const TemporaryFolder at;
  // a program whose movie is a link, so that only the copy is written
  const auto run = [](const std::string& command) { return std::system(command.c_str()); };
  REQUIRE(write_file(at / "movie.png", std::string(50'000, 'x')));
  REQUIRE(write_file(at / "program",
                     "#!/bin/sh\nwhile [ \"$1\" != -o ]; do shift; done\nmkdir -p \"$2/frames\"\n"
                     "ln -s \"${0%/*}/movie.png\" \"$2/frames/last.png\"\n"));
  fs::permissions(at / "program", fs::perms::owner_all);
  fs::create_directory(at / "to");
  const fs::path picture = at / "to/s1_actuation.png";
  REQUIRE(write_file(picture, "before"));
  const std::string draw = "TO='" + (at / "to").string() +
                           "' " GRIDSHELL_SOURCE_DIR "/presets/pictures/draw.sh '" +
                           (at / "program").string() + "' s1_actuation 2>/dev/null";
  CHECK(run("ulimit -f 8; " + draw) != 0);
  CHECK(text_of(picture) == "before");
  CHECK(files_under(at / "to", ".part").empty());
  CHECK(run(draw) == 0);
  CHECK(text_of(picture).size() == 50'000);
}
