#include "app/window/desk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_readings = 4000;
constexpr double look_every_s = 0.5;  // at the preset's file
constexpr double earth_m_s2 = 9.81, nitinol_kg_m3 = 6450;

}  // namespace

void Desk::say(const std::string& text, bool bad) {
  message = text;
  message_bad = bad;
}

// ---- wishes ----

void Desk::post(Deed deed, bool passing) {
  if (sight->designing()) {
    if (!std::holds_alternative<Settle>(deed))
      say("the shell is being designed; Esc stops that, and it can be moved", true);
    return;
  }
  engine.post({std::move(deed), stroke_, passing});
  if (!passing) ++stroke_;
}

void Desk::wish(Deed deed) {
  if (sight->designing()) engine.cancel();
  engine.post({std::move(deed), 0, false});
  ++stroke_;
}

void Desk::let_go() { post(Settle{}, false); }

void Desk::open(const std::string& name) {
  auto preset = library.load(name);
  if (!preset) return say(preset.error().message, true);
  file_ = fs::exists(name) ? fs::path(name) : fs::path();
  std::error_code error;
  if (!file_.empty()) written_ = fs::last_write_time(file_, error);
  picking = playing = false;
  fresh_ = true;
  readings.clear();
  picked_joint = picked_cell = -1;
  picked_rod = {};
  say("forming '" + preset->title + "'");
  wish(Open{std::move(*preset)});
}

void Desk::change(const preset::Preset& preset, bool passing) { post(Change{preset}, passing); }

void Desk::move(double progress, bool passing) { post(Move{progress}, passing); }

void Desk::go(double part, bool passing) {
  const PresetPush& whole = sight->push;
  if (whole.joint < 0) return move(std::max(part, sight->least_progress), passing);
  const bool free = sight->preset.indentation.lateral == preset::Lateral::free;
  push(whole.joint, whole.from + part * whole.displacement,
       free ? whole.displacement.normalized() : Eigen::Vector3d::Zero(), passing);
}

double Desk::part() const {
  const PresetPush& whole = sight->push;
  if (whole.joint < 0 || !sight->any()) return sight->progress;
  const Eigen::Vector3d moved = sight->frame.nodes.col(whole.joint) - whole.from;
  return moved.dot(whole.displacement) / whole.displacement.squaredNorm();
}

void Desk::push(int joint, const Eigen::Vector3d& to, const Eigen::Vector3d& along, bool passing) {
  post(Push{joint, to, along}, passing);
}

void Desk::drag_edge(int edge_point, const Eigen::Vector3d& to, bool passing) {
  post(DragEdge{edge_point, to}, passing);
}

void Desk::set_range(double low, double high) {
  if (!(low < high)) return;
  range_of = RangeOf::hand;
  show.scale.low = low;
  show.scale.high = high;
}

// ---- design ----

void Desk::stop() {
  playing = help = false;
  engine.cancel();
}

void Desk::start_design() {
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
  wish(Design{design.inverse, design.most_iterations});
}

void Desk::end_design(Deed keep_or_put_back) { wish(std::move(keep_or_put_back)); }

void Desk::toggle_gravity() {
  if (!sight->any()) return;
  preset::Preset preset = sight->preset;
  preset.loads.gravity_m_s2 = gravity() ? 0 : earth_m_s2;
  if (preset.rod.density_kg_m3 == 0) preset.rod.density_kg_m3 = nitinol_kg_m3;
  change(preset, false);
}

void Desk::play(bool on) {
  if (on && !playing) play_head = part() >= 1 - 1e-6 ? 0 : std::max(0.0, part());
  if (!on && playing) let_go();
  playing = on;
}

// ---- the camera ----

/// From where the camera looks, all in sight.
render::Camera Desk::fitted_view() const {
  render::Camera fitted = camera;
  // rods and both boundaries
  const record::Layout& layout = *sight->layout;
  Eigen::Matrix3Xd points(3, sight->frame.nodes.cols() + layout.original_boundary.cols());
  points << sight->frame.nodes, layout.original_boundary;
  fit(fitted, view, points);
  return fitted;
}

void Desk::fit_view() {
  if (sight->any()) camera = fitted_view();
}

void Desk::look(const ViewFrom& from) {
  look_from(camera, from);
  fit_view();
}

// ---- frame by frame ----

bool Desk::tick(double seconds) {
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
  tell_of_kept();
  watch_file(seconds);
  return anew;
}

void Desk::take(std::shared_ptr<const Sight> next) {
  const bool newer = next->equilibria != sight->equilibria;
  sight = std::move(next);
  if (!sight->trouble.empty())
    say(sight->trouble, true);
  else if (!sight->told.empty())
    say(sight->told);
  else if (newer)
    say("");
  if (!sight->any() || !newer) return;
  if (fresh_) look_anew();
  show.scale =
      next_scale(show.scale, scale_of(values_of(*sight, show.colour_by), show.colour_by), range_of);
  read_off();
}

/// Another shell: as its preset would have it seen, or as it was seen last.
void Desk::look_anew() {
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
  if (kept_view && kept_view->preset == sight->preset.name) {
    camera = kept_view->camera;
    show.colour_by = kept_view->colour_by;
  } else if (kept_view && range_of == RangeOf::hand) {
    range_of = RangeOf::state;  // that was of another quantity
  }
  kept_view.reset();
  // it has a range of its own
  if (range_of == RangeOf::run)
    show.scale = scale_of(values_of(*sight, show.colour_by), show.colour_by);
}

void Desk::read_off() {
  Reading now;
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
  if (now.refined && !readings.empty() && !readings.back().refined &&
      readings.back().steps == now.steps)
    readings.pop_back();
  readings.push_back(now);
  if (readings.size() > most_readings)
    readings.erase(readings.begin(), readings.begin() + most_readings / 4);
}

/// A preset that was changed in its file is taken anew; a broken one says so, and the last good one
/// stays.
void Desk::watch_file(double seconds) {
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

}  // namespace gridshell::window
