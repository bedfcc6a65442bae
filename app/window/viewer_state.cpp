#include "app/window/viewer_state.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "engine/core/json.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_readings = 4000;
constexpr double look_every_s = 0.5;  // at the preset's file
constexpr double earth_m_s2 = 9.81, nitinol_kg_m3 = 6450;

}  // namespace

void ViewerState::say(const std::string& text, bool bad) {
  message = text;
  message_bad = bad;
}

// ---- wishes ----

void ViewerState::post(Edit edit, bool passing) {
  if (sight->designing()) {
    if (!std::holds_alternative<RefineAfterDrag>(edit))
      say("the shell is being designed; Esc stops that, and it can be moved", true);
    return;
  }
  engine.post({std::move(edit), stroke_, passing});
  if (!passing) ++stroke_;
}

void ViewerState::send_command(Edit edit) {
  if (sight->designing()) engine.cancel();
  engine.post({std::move(edit), 0, false});
  ++stroke_;
}

void ViewerState::let_go() { post(RefineAfterDrag{}, false); }

void ViewerState::open(const std::string& name) {
  auto preset = library.load(name);
  if (!preset) return say(preset.error().message, true);
  file_ = fs::exists(name) ? fs::path(name) : fs::path();
  std::error_code error;
  if (!file_.empty()) written_ = fs::last_write_time(file_, error);
  picking = playing = false;
  fresh_ = true;
  plot_points.clear();
  picked_joint = picked_cell = -1;
  picked_rod = {};
  say("forming '" + preset->title + "'");
  send_command(Open{std::move(*preset)});
}

void ViewerState::change(const preset::Preset& preset, bool passing) {
  post(Change{preset}, passing);
}

void ViewerState::move(double progress, bool passing) { post(Move{progress}, passing); }

void ViewerState::go(double part, bool passing) {
  const PresetPush& whole = sight->push;
  if (whole.joint < 0) return move(std::max(part, sight->least_progress), passing);
  const bool free = sight->preset.indentation.lateral == preset::Lateral::free;
  push(whole.joint, whole.from + part * whole.displacement,
       free ? whole.displacement.normalized() : Eigen::Vector3d::Zero(), passing);
}

double ViewerState::part() const {
  const PresetPush& whole = sight->push;
  if (whole.joint < 0 || !sight->any()) return sight->progress;
  const Eigen::Vector3d moved = sight->frame.nodes.col(whole.joint) - whole.from;
  return moved.dot(whole.displacement) / whole.displacement.squaredNorm();
}

void ViewerState::push(int joint, const Eigen::Vector3d& to, const Eigen::Vector3d& along,
                       bool passing) {
  post(Push{joint, to, along}, passing);
}

void ViewerState::drag_edge(int edge_point, const Eigen::Vector3d& to, bool passing) {
  post(DragEdge{edge_point, to}, passing);
}

void ViewerState::set_range(double low, double high) {
  if (!(low < high)) return;
  range_of = RangeOf::hand;
  show.scale.low = low;
  show.scale.high = high;
}

// ---- design ----

void ViewerState::stop() {
  playing = help = false;
  engine.cancel();
}

void ViewerState::start_design() {
  if (const std::string why = why_not_designed(*sight); !why.empty()) return say(why, true);
  if (sight->designing()) return say("the shell is being designed already", true);
  if (design.inverse.vary.empty())
    return say("nothing may change: tick pins, legs, directions or diameters", true);
  design_panel = true;
  play(false);
  // of all steps, so that what is left is seen beside what was
  show.colour_by = ColourBy::deviation;
  show.scale = scale_of(values_of(*sight, show.colour_by), show.colour_by);
  range_of = RangeOf::run;
  send_command(Design{design.inverse, design.most_iterations});
}

void ViewerState::end_design(Edit keep_or_put_back) { send_command(std::move(keep_or_put_back)); }

void ViewerState::toggle_gravity() {
  if (!sight->any()) return;
  preset::Preset preset = sight->preset;
  preset.loads.gravity_m_s2 = gravity() ? 0 : earth_m_s2;
  if (preset.rod.density_kg_m3 == 0) preset.rod.density_kg_m3 = nitinol_kg_m3;
  change(preset, false);
}

void ViewerState::play(bool on) {
  if (on && !playing) play_head = part() >= 1 - 1e-6 ? 0 : std::max(0.0, part());
  if (!on && playing) let_go();
  playing = on;
}

// ---- the camera ----

/// From where the camera looks, all in sight.
render::Camera ViewerState::fitted_view() const {
  render::Camera fitted = camera;
  // rods and both boundaries
  const record::Layout& layout = *sight->layout;
  Eigen::Matrix3Xd points(3, sight->frame.nodes.cols() + layout.original_boundary.cols());
  points << sight->frame.nodes, layout.original_boundary;
  fit(fitted, view, points);
  return fitted;
}

void ViewerState::fit_view() {
  if (sight->any()) camera = fitted_view();
}

void ViewerState::look(const ViewFrom& from) {
  look_from(camera, from);
  fit_view();
}

// ---- frame by frame ----

bool ViewerState::tick(double seconds) {
  bool anew = false;
  if (auto next = engine.sight(); next != sight) {
    take(std::move(next));
    anew = true;
  }
  if (playing && sight->any()) {
    play_head = std::min(1.0, play_head + play_speed * seconds);
    go(play_head, true);
    if (play_head >= 1) play(false);
    anew = true;
  }
  if (animate_mode && !sight->stable() && sight->soft_mode.cols() > 0) {
    mode_phase += seconds;
    show.mode_mm = 0.06 * sight->layout->length_scale_mm * std::sin(3 * mode_phase);
    anew = true;
  } else if (show.mode_mm != 0) {
    show.mode_mm = mode_phase = 0;
    anew = true;
  }
  report_finished_tasks();
  watch_file(seconds);
  return anew;
}

void ViewerState::take(std::shared_ptr<const ShellView> next) {
  const bool newer = next->equilibria != sight->equilibria;
  sight = std::move(next);
  if (!sight->trouble.empty())
    say(sight->trouble, true);
  else if (!sight->told.empty())
    say(sight->told);
  else if (newer)
    say("");
  if (!sight->any() || !newer) return;
  if (fresh_) reset_view();
  show.scale =
      next_scale(show.scale, scale_of(values_of(*sight, show.colour_by), show.colour_by), range_of);
  add_plot_point();
}

/// Another shell: as its preset would have it seen, or as it was seen last.
void ViewerState::reset_view() {
  fresh_ = false;
  const preset::Movie& movie = sight->preset.movie;
  show.footprint = show.net = false;
  design = {sight->preset.inverse};
  // one that says what may change asks for it
  if (!design.inverse.vary.empty()) design_panel = true;
  if (design.inverse.vary.empty()) design.inverse.vary = {preset::Vary::pins};
  // the same words
  if (const auto by = find_word<ColourBy>(word_of(movie.colour_by))) show.colour_by = *by;
  camera.field_of_view_deg = movie.orthographic ? 0 : 20;
  look({movie.azimuth_deg, movie.elevation_deg});
  if (saved_camera && saved_camera->preset == sight->preset.name) {
    camera = saved_camera->camera;
    show.colour_by = saved_camera->colour_by;
  } else if (saved_camera && range_of == RangeOf::hand) {
    range_of = RangeOf::state;  // that was of another quantity
  }
  saved_camera.reset();
  // it has a range of its own
  if (range_of == RangeOf::run)
    show.scale = scale_of(values_of(*sight, show.colour_by), show.colour_by);
}

void ViewerState::add_plot_point() {
  PlotPoint now;
  const record::Frame& frame = sight->frame;
  now.radius_mm = frame.boundary_radius_mm;
  now.progress = sight->progress;
  now.height_mm = frame.height_mm;
  now.energy_mJ = frame.energies.total();
  now.total_K = frame.total_K;
  now.stable = sight->stable();
  now.steps = sight->steps.size();
  now.refined = sight->refined;
  if (!sight->held.empty()) {
    const HeldJoint& held = sight->held.back();
    now.joint = held.joint;
    now.depth_mm = held.moved_mm.norm();
    const double along = held.force_N.dot(held.moved_mm.normalized());
    now.force_N = std::isfinite(along) ? along : 0;
  }
  // the finer meshes of a drag's end take the place of its coarse one
  if (now.refined && !plot_points.empty() && !plot_points.back().refined &&
      plot_points.back().steps == now.steps)
    plot_points.pop_back();
  plot_points.push_back(now);
  if (plot_points.size() > most_readings)
    plot_points.erase(plot_points.begin(), plot_points.begin() + most_readings / 4);
}

/// A preset that was changed in its file is taken anew; a broken one says so, and the last good one
/// stays.
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
  change(*preset, false);
}

namespace {

/// Calls visit(key, value) for what is on or off.
template <class AnyDesk, class Visit>
void each_switch(AnyDesk& viewer, const Visit& visit) {
  visit("joints", viewer.show.joints);
  visit("boundaries", viewer.show.rings);
  visit("ground", viewer.show.ground);
  visit("net", viewer.show.net);
  visit("footprint", viewer.show.footprint);
  visit("dark", viewer.show.dark);
  visit("numbers", viewer.numbers);
  visit("plots", viewer.plots);
  visit("design", viewer.design_panel);
}

/// The same for the camera's numbers.
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

/// The member of an object, or null.
const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

bool take(const Json& object, const char* key, double& value, double low, double high) {
  const Json* number = member(object, key);
  if (!number || !number->is_number()) return false;
  const double asked = number->get<double>();
  if (!(asked >= low && asked <= high)) return false;
  value = asked;
  return true;
}

template <class Enum>
void take_word(const Json& object, const char* key, Enum& value) {
  const Json* word = member(object, key);
  if (!word || !word->is_string()) return;
  if (const auto found = find_word<Enum>(word->get<std::string>())) value = *found;
}

}  // namespace

std::string workspace_text(const ViewerState& viewer) {
  Json json = Json::object();
  json["preset"] = viewer.sight->preset.name;
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
  return text_of(json);
}

Result<void> take_workspace(ViewerState& viewer, const std::string& text) {
  const Json json = parsed(text);
  if (!json.is_object()) return fail(Fault::bad_input, "the workspace is no JSON object");
  if (const Json* shown = member(json, "shown"))
    each_switch(viewer, [&](const char* key, bool& on) {
      if (const Json* flag = member(*shown, key); flag && flag->is_boolean())
        on = flag->get<bool>();
    });
  if (const Json* colour = member(json, "colour")) {
    take_word(*colour, "by", viewer.show.colour_by);
    take_word(*colour, "range", viewer.range_of);
    double low = 0, high = 0;
    if (viewer.range_of == RangeOf::hand && take(*colour, "low", low, -1e9, 1e9) &&
        take(*colour, "high", high, -1e9, 1e9))
      viewer.set_range(low, high);
  }
  const Json *camera = member(json, "camera"), *preset = member(json, "preset");
  if (!camera || !preset || !preset->is_string()) return {};
  SavedCamera kept{preset->get<std::string>(), viewer.camera, viewer.show.colour_by};
  bool whole = true;
  each_number(kept.camera, [&](const char* key, double& value) {
    whole = take(*camera, key, value, -1e6, 1e6) && whole;
  });
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
