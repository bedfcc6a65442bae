// Presets that are saved: the camera as keys, and remarks on what a run may not reach.
#include <limits>

#include "app/window/viewer_state.h"
#include "engine/core/file_io.h"
#include "tests/app/window/edited_shell.h"
#include "tests/temporary_folder.h"

using namespace gridshell;
using namespace gridshell::window;
namespace fs = std::filesystem;

TEST_CASE("a preset is valid however far the camera is away or near, and its angles are short") {
  ViewerState viewer({});
  viewer.view = {800, 600};
  viewer.shell = std::make_shared<const ShellView>(EditedShell().view());
  viewer.fit_view();
  const double fits = viewer.camera.half_extent_mm;
  for (const double times : {1e-4, 1e-3, 1e3, 1e4}) {
    viewer.camera.half_extent_mm = times * fits;
    const preset::Preset saved = viewer.preset_to_save();
    CAPTURE(times, saved.movie.zoom);
    CHECK(check_preset(saved));
  }
  viewer.camera.azimuth_deg = -52.4;
  const std::string text = preset::to_toml(viewer.preset_to_save());
  CHECK_THAT(text, Catch::Contains("azimuth_deg = -52.4 "));
}

TEST_CASE("the prompt of a preset that is saved closes, also with a remark") {
  const TemporaryFolder folder;
  Library library;
  library.save_to = folder.path();
  library.write_preset = [](const preset::Preset& preset, const fs::path& file) {
    return write_file(file, preset::to_toml(preset));
  };
  ViewerState viewer(std::move(library));
  viewer.view = {800, 600};
  EditedShell edited;
  edited.act(Move{0.9});
  preset::Preset stiffer = edited.view().preset;
  stiffer.rod.young_GPa *= 2;
  edited.act(Change{stiffer});
  viewer.shell = std::make_shared<const ShellView>(edited.view());
  viewer.ask_file(FileUse::save_preset);
  REQUIRE(viewer.file_request);
  viewer.file_request->path = (folder / "mine.toml").string();
  viewer.take_file();
  CHECK(fs::exists(folder / "mine.toml"));
  CHECK_FALSE(viewer.file_request);
  CHECK_FALSE(viewer.message_bad);
  CHECK_THAT(viewer.message, Catch::Contains("mine.toml; numbers that were changed later"));
}

TEST_CASE("a range of displacements is saved over the depth of the push, as movies have it") {
  ViewerState viewer({});
  viewer.view = {800, 600};
  EditedShell edited;
  const auto show = [&] {
    viewer.shell = std::make_shared<const ShellView>(edited.view());
    viewer.plot_points.push_back(plot_point_of(*viewer.shell));
  };
  show();
  viewer.show.colour_by = ColourBy::displacement;
  viewer.set_range(0, 10);
  CHECK(viewer.preset_to_save().style.range.empty());  // nothing is pushed
  const int joint = edited.joint(0, 0);
  edited.act(Push{joint, edited.node(joint) - Eigen::Vector3d(0, 0, 4)});
  show();
  const preset::Preset saved = viewer.preset_to_save();
  REQUIRE(saved.style.range.size() == 2);
  CHECK(saved.style.range[0] == 0);
  CHECK(saved.style.range[1] == Approx(2.5));
  CHECK(saved.movie.colour_by == ColourBy::displacement);
  viewer.compare_with_this();
  CHECK(viewer.preset_to_save().style.range.empty());  // distances from the other shell
  viewer.show.colour_by = ColourBy::energy;
  viewer.set_range(0, 10);
  CHECK(viewer.preset_to_save().style.range == std::vector<double>{0, 10});
}

TEST_CASE("the range of colours that a preset had is not saved with another quantity") {
  ViewerState viewer({});
  viewer.view = {800, 600};
  ShellView shell = EditedShell().view();
  shell.preset.style.range = {-1, 1};
  viewer.shell = std::make_shared<const ShellView>(shell);
  viewer.show.colour_by = shell.preset.movie.colour_by;
  CHECK(viewer.preset_to_save().style.range == shell.preset.style.range);
  viewer.show.colour_by = ColourBy::energy;
  CHECK(viewer.preset_to_save().style.range.empty());
}
