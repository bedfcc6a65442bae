// Saves presets, pictures, movies and exports of the shell; compares it with others.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

#include "app/window/viewer_state.h"
#include "engine/core/file_io.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr int least_px = 16, most_px = 16384;
constexpr double least_zoom = 0.01, most_zoom = 100;  // of [movie] zoom
constexpr double shift_seen_px = 2;                   // a smaller shift of the camera is not saved

double rounded(double value, double per_unit) { return std::round(per_unit * value) / per_unit; }

/// What a saved preset may not reproduce; empty: nothing.
std::string left_out(const ShellView& shell) {
  std::string text;
  if (shell.rods_changed_late) text += "; numbers that were changed later apply from its start";
  if (!shell.accuracy_warning.empty())
    text += "; its state is " + shell.accuracy_warning + ": 'run' may reach another";
  return text;
}

Result<void> make_folder_of(const fs::path& file) {
  return file.has_parent_path() ? make_folder(file.parent_path()) : Result<void>();
}

/// Default ending of a file that is written.
const char* ending_of(FileUse use) {
  switch (use) {
    case FileUse::save_preset:
      return ".toml";
    case FileUse::save_picture:
      return ".png";
    case FileUse::export_shell:
      return ".vtp";
    case FileUse::open:
    case FileUse::compare:
      break;
  }
  return "";
}

/// Why a file cannot be written under this name; empty if it can.
std::string error_of(FileUse use, const fs::path& file,
                     const std::vector<app::ExportFormat>& formats) {
  std::error_code error;
  // the file's folder may be new, but not the folder that contains it
  const fs::path folder = fs::absolute(file, error).parent_path();
  if (!fs::is_directory(folder, error) && !fs::is_directory(folder.parent_path(), error))
    return "there is no folder '" + folder.string() + "'";
  const std::string ending = file.extension().string();
  if (use != FileUse::export_shell)
    return ending == ending_of(use)
               ? ""
               : fmt::format("'{}': it is written as {}", ending, ending_of(use));
  std::string all;
  for (const app::ExportFormat& format : formats) {
    if (format.ending == ending) return "";
    all += " " + format.ending;
  }
  return fmt::format("format: got '{}', expected one of{}", ending, all);
}

}  // namespace

Result<void> check_picture(int width, int height) {
  if (std::min(width, height) >= least_px && std::max(width, height) <= most_px) return {};
  return invalid("a picture of {} x {}: expected {} to {} pixels for each side", width, height,
                 least_px, most_px);
}

/// The first path PRESET_1, PRESET_2 ... in the folder for which no file has one of the endings.
fs::path ViewerState::path_to_save(const std::vector<std::string>& endings) const {
  const std::string name = fs::path(shell->preset.name).filename().string();
  for (int k = 1;; ++k) {
    const fs::path path = library.save_to / fmt::format("{}_{}", name, k);
    const bool taken = std::ranges::any_of(endings, [&](const std::string& ending) {
      std::error_code error;
      return fs::exists(path.string() + ending, error);
    });
    if (!taken) return path;
  }
}

/// Writes camera and colours into the keys of [movie] and [style].
void ViewerState::put_view(preset::Preset& preset) const {
  preset::Movie& movie = preset.movie;
  movie.azimuth_deg = rounded(camera.azimuth_deg, 10);
  movie.elevation_deg = rounded(camera.elevation_deg, 10);
  movie.view = preset::View::free;
  movie.turn_deg = 0;
  movie.orthographic = camera.field_of_view_deg == 0;
  const render::Camera fitted = fitted_view();
  movie.zoom = std::clamp(rounded(fitted.half_extent_mm / camera.half_extent_mm, 100), least_zoom,
                          most_zoom);
  movie.target_mm.clear();
  // a movie of all parts is framed later, when all of its frames are known
  const double shift_mm = shift_seen_px * mm_per_pixel(camera, view);
  if ((camera.target - fitted.target).norm() > shift_mm)
    for (const double value : camera.target) movie.target_mm.push_back(rounded(value, 10));
  const bool displacement = show.colour_by == ColourBy::displacement;
  const double pushed_mm = displacement ? largest_push_mm(preset) : 0;
  const bool known = show.colour_by == ColourBy::none || values_of(*shell, show).size() > 0;
  if (known && (!displacement || pushed_mm > 0)) movie.colour_by = show.colour_by;
  // an earlier range is that of another quantity
  if (movie.colour_by != shell->preset.movie.colour_by) preset.style.range.clear();
  if (range_of != RangeOf::hand || movie.colour_by != show.colour_by) return;
  preset.style.range.clear();
  // the displacements of a movie are over the depth of its push, those of the window in mm
  const double unit = displacement ? pushed_mm : 1;
  if (!displacement || !show.other)
    preset.style.range = {show.scale.low / unit, show.scale.high / unit};
}

/// The largest depth, mm, of the push of a preset of this shell or of the pushes in its steps; 0:
/// nothing is pushed.
double ViewerState::largest_push_mm(const preset::Preset& preset) const {
  if (preset.indentation.requested()) return shell->push.displacement.norm();
  double largest = 0;
  // at the ends of steps: a drag may have been deeper before
  for (std::size_t k = 0; k < plot_points.size(); ++k)
    if (k + 1 == plot_points.size() || plot_points[k + 1].steps > plot_points[k].steps)
      largest = std::max(largest, plot_points[k].depth_mm);
  return largest;
}

preset::Preset ViewerState::preset_to_save() const {
  preset::Preset preset = shell->preset;
  preset.indentation = {};
  put_view(preset);
  // if only a circular boundary was moved, the preset with its radius gives the same shell
  const bool circle = preset.footprint.kind == preset::FootprintKind::circle;
  const bool moves = std::ranges::all_of(shell->steps, [](const auto& step) {
    return step->kind == preset::StepKind::move && step->edge_points.empty();
  });
  if (circle && moves && !shell->snapped) return preset;
  preset.step = steps_of(shell->steps);
  // which state a perturbed shell reaches depends on round-off, but not on a given mesh
  const bool perturbed = std::ranges::any_of(
      preset.step, [](const auto& step) { return step.kind == preset::StepKind::jitter; });
  if (perturbed) preset.accuracy.edges_per_segment = shell->meshes.back();
  if (circle) preset.actuation.radius_mm = shell->radius_end_mm;
  return preset;
}

Result<void> ViewerState::write_preset(const preset::Preset& preset, const fs::path& file) const {
  return make_folder_of(file).and_then([&] { return library.write_preset(preset, file); });
}

void ViewerState::save_preset() {
  if (!shell->any()) return say("there is no shell to save", true);
  save_preset_as(path_to_save({".toml", "_ends.csv", "_rods.csv"}).string() + ".toml");
}

void ViewerState::save_preset_as(const fs::path& file) {
  if (auto written = write_preset(preset_to_save(), file); !written)
    return say(written.error().message, true);
  say("saved " + fs::absolute(file).string() + left_out(*shell));
}

void ViewerState::save_picture() {
  if (!shell->any()) return say("there is no shell to draw", true);
  draw_picture_as(path_to_save({".png"}).string() + ".png", picture);
}

void ViewerState::draw_picture_as(const fs::path& file, const PictureFormat& format) {
  if (picture_task.under_way()) return say("one picture is being drawn already", true);
  if (auto made = make_folder_of(file); !made) return say(made.error().message, true);
  PictureRequest request = picture_request();
  request.format = format;
  picture_task.begin([draw = library.draw_picture, request, file](
                         const ProgressListener&, const Watch&) { return draw(request, file); },
                     file);
  say("drawing " + file.string());
}

// ---- file prompts ----

void ViewerState::ask_file(FileUse use) {
  if (use != FileUse::open && !shell->any()) return say("there is no shell yet", true);
  say("");
  FileRequest request;
  request.use = use;
  const char* ending = ending_of(use);
  std::error_code error;
  const auto there = [&](const fs::path& folder) {
    return !folder.empty() && fs::is_directory(folder, error);
  };
  // begins in the folder of the last file; a desktop may start programs in the root folder
  const fs::path here = fs::current_path(error), last = last_folders[is_read(use)];
  const char* home = std::getenv("HOME");
  const fs::path start = there(last)                                           ? last
                         : !is_read(use)                                       ? library.save_to
                         : use == FileUse::compare && there(library.save_to)   ? library.save_to
                         : here == here.root_path() && there(home ? home : "") ? fs::path(home)
                                                                               : here;
  request.path =
      (*ending ? start / (path_to_save({ending}).filename().string() + ending) : start / "")
          .string();
  request.folder = fs::path(request.path).parent_path().string();
  file_request = request;
}

void ViewerState::take_file() {
  const FileRequest request = *file_request;
  if (request.path.empty()) return say("a path is to be typed or picked", true);
  fs::path file = request.path;
  std::error_code error;
  if (!file.has_parent_path() && !fs::exists(file, error)) file = request.folder / file;
  if (request.use == FileUse::save_preset || request.use == FileUse::save_picture)
    if (!file.filename().empty() && !file.has_extension()) file += ending_of(request.use);
  const bool reads = is_read(request.use);
  if (!reads && (file.filename().empty() || fs::is_directory(file, error)))
    return say("'" + request.path + "' is a folder: a file's name is to follow", true);
  if (const std::string fault = reads ? "" : error_of(request.use, file, library.export_formats);
      !fault.empty())
    return say(fault, true);
  if (!reads && fs::exists(file, error) && request.replaced != request.path) {
    file_request->replaced = request.path;
    return say("it is there already: once more replaces it", true);
  }
  message_bad = false;
  switch (request.use) {
    case FileUse::open:
      open(file.string());
      break;
    case FileUse::compare:
      compare_with(file);
      break;
    case FileUse::save_preset:
      save_preset_as(file);
      break;
    case FileUse::save_picture: {
      PictureFormat format = picture;
      format.dpi = request.dpi;
      format.width = int(std::lround(request.width_mm / 25.4 * request.dpi));
      format.height = int(std::lround(format.width * view.height / view.width));
      if (auto fits = check_picture(format.width, format.height); !fits)
        return say(fits.error().message, true);
      draw_picture_as(file, format);
      break;
    }
    case FileUse::export_shell:
      export_as(file);
      break;
  }
  // after an error the prompt remains, so that the path can be corrected
  if (message_bad) return;
  last_folders[reads] = fs::absolute(file, error).lexically_normal().parent_path().string();
  file_request.reset();
}

/// Exports the shell in the background.
void ViewerState::export_as(const fs::path& file) {
  if (export_task.under_way()) return say("an export is running already", true);
  if (auto made = make_folder_of(file); !made) return say(made.error().message, true);
  export_task.begin([make = library.export_shell, preset = preset_to_save(), file](
                        const ProgressListener& listener,
                        const Watch& watch) { return make(preset, file, listener, watch); },
                    file);
  say("exporting " + file.string());
}

void ViewerState::compare_with(const fs::path& run) {
  auto loaded = library.load_run(run);
  if (!loaded) return say(loaded.error().message, true);
  compare(std::make_shared<const OtherShell>(std::move(*loaded)));
  say("compared with " + show.other->name + ": " + difference_text());
}

void ViewerState::compare_with_this() {
  compare(std::make_shared<const OtherShell>(OtherShell{"before", shell}));
}

void ViewerState::compare_with_net() {
  const record::Layout& layout = *shell->layout;
  record::Frame frame;
  frame.progress = frame.actuation = shell->frame.actuation;
  frame.nodes = layout.net_nodes;
  frame.cell_K = shell->net_K;
  compare(std::make_shared<const OtherShell>(OtherShell{"net", view_of(layout, frame, frame)}));
}

void ViewerState::compare(std::shared_ptr<const OtherShell> other) {
  show_side_by_side(show.side_by_side && other);
  show.other = std::move(other);
  // the colours may show the distance from it
  if (show.colour_by == ColourBy::displacement) show.scale = scale_of(*shell, show);
}

void ViewerState::show_side_by_side(bool on) {
  if (on == show.side_by_side) return;
  show.side_by_side = on;
  view.width *= on ? 0.5 : 2;
  fit_view();
  if (on && range_of == RangeOf::run)
    show.scale = next_scale(show.scale, scale_of(*show.other->seen, show), range_of);
}

std::string ViewerState::difference_text() const {
  std::map<std::pair<int, int>, int> others;
  const ShellView& other = *show.other->seen;
  for (const record::Joint& joint : other.layout->joints) others[{joint.i, joint.j}] = joint.node;
  double largest = -1, sum = 0;
  int count = 0;
  const record::Joint* at = nullptr;
  for (const record::Joint& joint : shell->layout->joints) {
    const auto same = others.find({joint.i, joint.j});
    if (same == others.end()) continue;
    const double apart =
        (shell->frame.nodes.col(joint.node) - other.frame.nodes.col(same->second)).norm();
    sum += apart, ++count;
    if (apart > largest) largest = apart, at = &joint;
  }
  if (!at) return "no joint has the same name in both";
  return fmt::format("largest distance {:.3g} mm at joint ({}, {}), mean {:.3g} mm", largest, at->i,
                     at->j, sum / count);
}

void ViewerState::size_picture(int width, int height) {
  if (width != 0 || height != 0)
    if (auto fits = check_picture(width, height); !fits) return say(fits.error().message, true);
  picture.width = width, picture.height = height;
}

void ViewerState::save_movie() {
  if (!shell->any()) return say("there is no shell to make a movie of", true);
  if (movie_task.under_way()) return say("one movie is being made; 'Stop the movie' ends it", true);
  const fs::path folder = path_to_save({".toml", "_ends.csv", "_rods.csv", ""}),
                 file = folder.string() + ".toml";
  preset::Preset preset = preset_to_save();
  if (shell->steps.empty()) {
    preset = shell->preset;
    put_view(preset);
  }
  if (auto written = write_preset(preset, file); !written)
    return say(written.error().message, true);
  movie_task.begin([make = library.make_movie, file, folder](
                       const ProgressListener& listener,
                       const Watch& watch) { return make(file, folder, listener, watch); },
                   folder);
  say("making a movie in " + folder.string() + left_out(*shell));
}

void ViewerState::report_finished_tasks() {
  for (BackgroundTask* work : tasks()) {
    const auto end = work->take_end();
    if (!end) continue;
    if (end->made)
      say((work == &manual_task ? "shown in the browser: " : "saved ") +
          fs::absolute(end->target).string());
    else if (end->made.error().fault == Fault::cancelled)
      say("stopped: " + end->last_words);
    else
      say(end->made.error().message, true);
  }
}

void ViewerState::show_manual() {
  if (manual_task.under_way()) return;
  manual_task.begin([show = library.show_manual](const ProgressListener&,
                                                 const Watch& watch) { return show(watch); },
                    "the manual");
}

void ViewerState::copy_camera() {
  if (!shell->any()) return say("there is no shell to look at", true);
  preset::Preset looked = shell->preset;
  put_view(looked);
  const preset::Movie& movie = looked.movie;
  copied = fmt::format("azimuth_deg = {:g}\nelevation_deg = {:g}\nturn_deg = 0\nzoom = {:g}\n",
                       movie.azimuth_deg, movie.elevation_deg, movie.zoom);
  if (movie.orthographic) copied += "orthographic = true\n";
  if (movie.target_mm.size() == 3)
    copied += fmt::format("target_mm = [{:g}, {:g}, {:g}]\n", movie.target_mm[0],
                          movie.target_mm[1], movie.target_mm[2]);
  say("copied the camera as keys of [movie]");
}

}  // namespace gridshell::window
