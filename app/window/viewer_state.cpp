#include "app/window/viewer_state.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <type_traits>

#include "engine/core/json.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_points = 4000;
constexpr std::size_t most_recent = 8;
constexpr double look_every_s = 0.5;  // interval of checking the preset's file
constexpr double most_number = 1e9;   // largest number that is read from a workspace
constexpr double other_size = 0.02;   // relative change of size that fits the camera again
constexpr double earth_m_s2 = 9.81, nitinol_kg_m3 = 6450;

/// Calls visit(key, value) for each flag of the workspace.
template <class AnyViewer, class Visit>
void each_switch(AnyViewer& viewer, const Visit& visit) {
  visit("joints", viewer.show.joints);
  visit("boundaries", viewer.show.rings);
  visit("ground", viewer.show.ground);
  visit("net", viewer.show.net);
  visit("footprint", viewer.show.footprint);
  visit("dark", viewer.show.dark);
  visit("loads", viewer.show.loads);
  visit("braces", viewer.show.braces);
  visit("numbers", viewer.numbers);
  visit("plots", viewer.plots);
  visit("design", viewer.design_panel);
}

/// Calls visit(key, value) for each number of the camera.
template <class AnyCamera, class Visit>
void each_number(AnyCamera& camera, const Visit& visit) {
  visit("azimuth_deg", camera.azimuth_deg);
  visit("elevation_deg", camera.elevation_deg);
  visit("half_extent_mm", camera.half_extent_mm);
  visit("field_of_view_deg", camera.field_of_view_deg);
  visit("target_x_mm", camera.target.x());
  visit("target_y_mm", camera.target.y());
  visit("target_z_mm", camera.target.z());
}

/// Reads a member of an object; returns false, and leaves `value`, if it is missing or no Value.
template <class Value>
bool take(const Json& object, const char* key, Value& value) {
  if (!object.is_object() || !object.contains(key)) return false;
  const Json& member = object[key];
  if constexpr (std::is_enum_v<Value>) {
    const auto found = find_word<Value>(member.is_string() ? member.get<std::string>() : "");
    if (found) value = *found;
    return found.has_value();
  } else if constexpr (std::is_same_v<Value, double>) {
    if (!member.is_number() || std::abs(member.get<double>()) > most_number) return false;
  } else if constexpr (std::is_same_v<Value, bool>) {
    if (!member.is_boolean()) return false;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    if (!member.is_string()) return false;
  }
  value = member.get<Value>();
  return true;
}

}  // namespace

void ViewerState::say(const std::string& text, bool bad) {
  message = text;
  message_bad = bad;
}

// ---- commands ----

void ViewerState::post(Edit edit, bool passing) {
  if (shell->designing()) {
    if (!std::holds_alternative<RefineAfterDrag>(edit))
      say("the shell is being designed; Esc stops that, and it can be moved", true);
    return;
  }
  engine.post({std::move(edit), drag_, passing});
  if (!passing) ++drag_;
}

void ViewerState::send_command(Edit edit) {
  if (shell->designing()) engine.cancel();
  engine.post({std::move(edit), 0, false});
  ++drag_;
}

void ViewerState::end_drag() { post(RefineAfterDrag{}, false); }

void ViewerState::open(const std::string& name) {
  auto preset = library.load(name);
  if (!preset) return say(preset.error().message, true);
  std::erase(recent, name);
  recent.insert(recent.begin(), name);
  recent.resize(std::min(recent.size(), most_recent));
  show.other.reset();
  std::error_code error;
  run_opened_ = fs::is_directory(name, error);
  file_ = fs::is_regular_file(name, error) ? fs::path(name) : fs::path();
  if (!file_.empty()) written_ = fs::last_write_time(file_, error);
  form(std::move(*preset));
}

void ViewerState::open(preset::Preset preset) {
  show.other.reset();
  run_opened_ = false;
  file_.clear();
  form(std::move(preset));
}

void ViewerState::form(preset::Preset preset) {
  picking = playing = new_shell = false;
  fresh_ = true;
  plot_points.clear();
  timeline.clear();
  clear_picked();
  say("forming '" + preset.title + "'");
  send_command(Open{std::move(preset)});
}

void ViewerState::clear_picked() {
  picked_joint = picked_cell = joint_under = edge_under = -1;
  picked_rod = {};
  measured.clear();
}

void ViewerState::go(double part, bool passing) {
  const PresetPush& whole = shell->push;
  if (whole.joint < 0) return post(Move{std::max(part, shell->least_progress)}, passing);
  const bool free = shell->preset.indentation.lateral == preset::Lateral::free;
  const Eigen::Vector3d along = free ? whole.displacement.normalized() : Eigen::Vector3d::Zero();
  post(Push{whole.joint, whole.from + part * whole.displacement, along}, passing);
}

double ViewerState::part() const {
  const PresetPush& whole = shell->push;
  if (whole.joint < 0 || !shell->any()) return shell->progress;
  const Eigen::Vector3d moved = shell->frame.nodes.col(whole.joint) - whole.from;
  return moved.dot(whole.displacement) / whole.displacement.squaredNorm();
}

void ViewerState::measure(int joint) {
  if (measured.size() >= 3) measured.clear();
  if (std::ranges::find(measured, joint) == measured.end()) measured.push_back(joint);
}

void ViewerState::set_range(double low, double high) {
  if (!(low < high)) return;
  range_of = RangeOf::hand;
  show.scale.low = low;
  show.scale.high = high;
}

// ---- design ----

void ViewerState::stop() {
  playing = help = terms = false;
  engine.cancel();
}

void ViewerState::start_design() {
  if (design.inverse.vary.empty())
    return say("nothing may change: tick pins, legs, directions or diameters", true);
  design_panel = true;
  play(false);
  // the range of all steps, so that they can be compared with the first one
  show.colour_by = ColourBy::deviation;
  show.scale = scale_of(*shell, show);
  range_of = RangeOf::run;
  send_command(Design{design.inverse, design.most_iterations});
}

void ViewerState::toggle_gravity() {
  preset::Preset preset = shell->preset;
  preset.loads.gravity_m_s2 = gravity() ? 0 : earth_m_s2;
  if (preset.rod.density_kg_m3 == 0) preset.rod.density_kg_m3 = nitinol_kg_m3;
  post(Change{preset}, false);
}

void ViewerState::play(bool on) {
  if (on && !playing) play_head = part() >= 1 - 1e-6 ? 0 : std::max(0.0, part());
  if (!on && playing) end_drag();
  playing = on;
}

// ---- the camera ----

/// The camera, not turned, moved so that the complete shell is in the view.
render::Camera ViewerState::fitted_view() const {
  render::Camera fitted = camera;
  // rods and both boundaries
  const record::Layout& layout = *shell->layout;
  Eigen::Matrix3Xd points(3, shell->frame.nodes.cols() + layout.original_boundary.cols());
  points << shell->frame.nodes, layout.original_boundary;
  if (show.shells() == 1 || show.colour_by == ColourBy::none) {
    fit(fitted, view, points);
    return fitted;
  }
  // two shells leave space at the right for the legend of colours
  const double legend_px = 0.18 * view.width;
  fit(fitted, {view.width - legend_px, view.height}, points);
  pan(fitted, view, -0.5 * legend_px, 0);
  return fitted;
}

void ViewerState::fit_view() {
  if (shell->any()) camera = fitted_view();
}

void ViewerState::look(const render::ViewDirection& from) {
  look_from(camera, from);
  fit_view();
}

// ---- frame by frame ----

bool ViewerState::tick(double seconds) {
  bool again = false;
  if (auto next = engine.shell(); next != shell) {
    take(std::move(next));
    again = true;
  }
  if (playing && shell->any()) {
    play_head = std::min(1.0, play_head + play_speed * seconds);
    go(play_head, true);
    if (play_head >= 1) play(false);
    again = true;
  }
  if (animate_mode && !shell->stable() && shell->soft_mode.cols() > 0) {
    mode_phase += seconds;
    show.mode_mm = 0.06 * shell->layout->length_scale_mm * std::sin(3 * mode_phase);
    again = true;
  } else if (show.mode_mm != 0) {
    show.mode_mm = mode_phase = 0;
    again = true;
  }
  report_finished_tasks();
  watch_file(seconds);
  return again;
}

void ViewerState::take(std::shared_ptr<const ShellView> next) {
  const bool newer = next->equilibria != shell->equilibria;
  // indices of joints, rods and cells are those of one footprint
  if (shell->any() && next->any() && !same_joints(shell->layout->joints, next->layout->joints))
    clear_picked();
  shell = std::move(next);
  if (!shell->error.empty())
    say(shell->error, true);
  else if (!shell->message.empty())
    say(shell->message);
  else if (newer)
    say("");
  if (!shell->any() || !newer) return;
  const bool to_end = fresh_ && std::exchange(run_opened_, false) && part() < 1;
  const double size_mm = shell->layout->length_scale_mm;
  if (fresh_)
    reset_view();
  else if (std::abs(size_mm - size_mm_) > other_size * size_mm_)
    fit_view();
  size_mm_ = size_mm;
  if (to_end) go(1, false), say("on to where the run ended");
  show.scale = next_scale(show.scale, scale_of(*shell, show), range_of);
  if (shell->frame.loads_N.cols() > 0)
    show.largest_load_N =
        std::max(show.largest_load_N, shell->frame.loads_N.colwise().norm().maxCoeff());
  add_plot_point();
  note_step();
}

/// Sets camera and colours for another shell: those of its preset, or those of the workspace.
void ViewerState::reset_view() {
  fresh_ = false;
  const preset::Movie& movie = shell->preset.movie;
  show.footprint = show.net = false;
  show.largest_load_N = 0;
  design = {shell->preset.inverse};
  // a preset that is to be designed opens the panel
  if (!design.inverse.vary.empty()) design_panel = true;
  if (design.inverse.vary.empty()) design.inverse.vary = {preset::Vary::pins};
  show.colour_by = movie.colour_by;
  camera.field_of_view_deg = movie.orthographic ? 0 : 20;
  look({movie.azimuth_deg, movie.elevation_deg});
  if (saved_camera && saved_camera->preset == shell->preset.name) {
    camera = saved_camera->camera;
    show.colour_by = saved_camera->colour_by;
  } else if (saved_camera && range_of == RangeOf::hand) {
    range_of = RangeOf::run;  // the saved range is that of another quantity
  }
  saved_camera.reset();
  // the range of another shell does not apply
  if (range_of == RangeOf::run) show.scale = scale_of(*shell, show);
}

void ViewerState::add_plot_point() {
  const PlotPoint now = plot_point_of(*shell);
  // removes the points of undone steps
  while (!plot_points.empty() && plot_points.back().steps > now.steps) plot_points.pop_back();
  // the refined state replaces the coarse one at the end of a drag
  if (now.refined && !plot_points.empty() && !plot_points.back().refined &&
      plot_points.back().steps == now.steps)
    plot_points.pop_back();
  for (const PlotPoint& point : shell->push_path)
    if (plot_points.empty() || point.equilibrium > plot_points.back().equilibrium)
      plot_points.push_back(point);
  plot_points.push_back(now);
  if (plot_points.size() > most_points)
    plot_points.erase(plot_points.begin(), plot_points.begin() + most_points / 4);
}

/// Reads the preset again if its file changed; if that has errors, the last valid preset remains.
void ViewerState::watch_file(double seconds) {
  since_look_ += seconds;
  if (file_.empty() || since_look_ < look_every_s) return;
  since_look_ = 0;
  std::error_code error;
  const auto written = fs::last_write_time(file_, error);
  if (error || written == written_) return;
  written_ = written;
  auto preset = library.load(file_.string());
  if (!preset) return say(preset.error().message, true);
  say("read " + file_.string() + " again");
  post(Change{*preset}, false);
}

std::string workspace_text(const ViewerState& viewer) {
  Json json = Json::object();
  json["preset"] = viewer.shell->preset.name;
  Json camera = Json::object();
  each_number(viewer.camera, [&](const char* key, double value) { camera[key] = value; });
  json["camera"] = camera;
  Json colour = Json::object();
  colour["by"] = word_of(viewer.show.colour_by);
  colour["range"] = word_of(viewer.range_of);
  colour["low"] = viewer.show.scale.low;
  colour["high"] = viewer.show.scale.high;
  json["colour"] = colour;
  Json shown = Json::object();
  each_switch(viewer, [&](const char* key, bool on) { shown[key] = on; });
  json["shown"] = shown;
  json["recent"] = viewer.recent;
  json["saved_in"] = viewer.last_folders[0];
  json["opened_from"] = viewer.last_folders[1];
  return text_of(json);
}

Result<void> take_workspace(ViewerState& viewer, const std::string& text) {
  const Json json = parsed(text);
  if (!json.is_object()) return invalid("the workspace is no JSON object");
  Json shown, colour, camera;
  if (take(json, "shown", shown))
    each_switch(viewer, [&](const char* key, bool& on) { take(shown, key, on); });
  double low = 0, high = 0;
  if (take(json, "colour", colour)) {
    take(colour, "by", viewer.show.colour_by);
    take(colour, "range", viewer.range_of);
    if (viewer.range_of == RangeOf::hand && take(colour, "low", low) && take(colour, "high", high))
      viewer.set_range(low, high);
  }
  if (json.contains("recent") && json["recent"].is_array())
    for (const Json& one : json["recent"])
      if (one.is_string() && viewer.recent.size() < most_recent)
        viewer.recent.push_back(one.get<std::string>());
  take(json, "saved_in", viewer.last_folders[0]);
  take(json, "opened_from", viewer.last_folders[1]);
  SavedCamera kept{"", viewer.camera, viewer.show.colour_by};
  if (!take(json, "camera", camera) || !take(json, "preset", kept.preset)) return {};
  bool whole = true;
  each_number(kept.camera,
              [&](const char* key, double& value) { whole = take(camera, key, value) && whole; });
  const render::Camera& seen = kept.camera;
  if (whole && seen.half_extent_mm > 0 && std::abs(seen.elevation_deg) <= 90 &&
      seen.field_of_view_deg >= 0 && seen.field_of_view_deg < 120)
    viewer.saved_camera = kept;
  return {};
}

std::filesystem::path workspace_file() {
  const auto of = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  std::filesystem::path state = of("XDG_STATE_HOME");
  if (!state.is_absolute() && of("HOME").is_absolute()) state = of("HOME") / ".local/state";
  return state.is_absolute() ? state / "gridshell/workspace.json" : std::filesystem::path();
}

}  // namespace gridshell::window
