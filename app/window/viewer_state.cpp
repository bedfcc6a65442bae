#include "app/window/viewer_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/gridshell.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_points = 4000;
constexpr double look_every_s = 0.5;  // interval of checking the preset's file
constexpr double other_size = 0.02;   // relative change of size that fits the camera again
constexpr double earth_m_s2 = 9.81;

/// The named material of a rod, or that which its stiffness means: Nitinol, of which the default
/// rods are.
preset::Material material_of(const preset::Rod& rod) {
  const auto nitinol = preset::Material::nitinol;
  const bool as_stiff = rod.young_GPa == preset::rod_of(nitinol).young_GPa;
  return rod.material == preset::Material::none && as_stiff ? nitinol : rod.material;
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
  std::string remark;
  for (preset::Rod* rod : {&preset.rod, static_cast<preset::Rod*>(&preset.rod_v)}) {
    const bool v = rod == &preset.rod_v;
    if (gravity() || rod->has_mass() || (v && !preset.rod_v.differs)) continue;
    const preset::Material material = material_of(*rod);
    const std::string key = fmt::format("[{}] density_kg_m3", v ? "rod_v" : "rod");
    if (material == preset::Material::none)
      return say("the rods' weight needs their density: expected " + key +
                     " above 0 (Ctrl+F finds it), or a material",
                 true);
    rod->density_kg_m3 = preset::rod_of(material).density_kg_m3;
    remark = fmt::format("{} = {:g} was assumed, that of {}", key, rod->density_kg_m3,
                         word_of(material));
  }
  post(Change{preset, remark}, false);
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

}  // namespace gridshell::window
