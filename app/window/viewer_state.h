// Everything that the window knows: the shell, how it is shown, what is picked, what
// plays. It has no OpenGL and no interface library; panels show it, actions and the view change it.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/cli/commands.h"
#include "app/window/shell_drawing.h"
#include "app/window/worker_threads.h"
#include "render/movie/movie_style.h"

namespace gridshell::window {

/// A preset that can be picked.
struct PresetCard {
  std::string name, title;
  std::string_view picture;  ///< a PNG of its shell; empty: none
};

/// How pictures are kept.
struct PictureFormat {
  int width = 0, height = 0;  ///< pixels; 0: twice the view's
  render::Quality quality = render::Quality::movie;
  bool legend = true;  ///< of the colours
  double dpi = 0;      ///< that the file says; 0: none
};

/// Errors (bad_input): pixels that no picture can have.
Result<void> check_picture(int width, int height);

/// All that a picture depends on.
struct PictureRequest {
  std::shared_ptr<const ShellView> shell;
  render::Camera camera;
  PictureSize view;  ///< that the camera looks into
  Show show;
  PictureFormat kept;
};

/// A finished step, and its events.
struct TimelineEntry {
  std::string text, event;
  bool stable = true;
  std::shared_ptr<const preset::Step> event_at = {};  ///< the step in which it happened
};
/// What led to the state that is shown: "pushed (0, 0): 8.16 mm, 0.0342 N".
std::string text_of_step(const ShellView& shell);

/// Purpose of a file prompt.
enum class FileUse { open, compare, save_preset, save_picture, export_shell };
/// Whether the file is read; else it is written.
constexpr bool is_read(FileUse use) { return use == FileUse::open || use == FileUse::compare; }

/// A file prompt.
struct FileRequest {
  FileUse use = FileUse::open;
  std::string path;                 ///< as typed so far
  std::string folder;               ///< that is shown, which a bare name is of
  double width_mm = 85, dpi = 300;  ///< of a picture
  std::string replaced = {};        ///< a file that is there and was confirmed to go
};

/// Where presets come from, what makes pictures and movies, and where all that is kept goes.
struct Library {
  std::vector<PresetCard> cards;
  std::function<Result<preset::Preset>(const std::string& name)> load;
  std::function<Result<void>(const PictureRequest& request, const std::filesystem::path& file)>
      draw_picture;
  /// The view at full resolution on any thread, for shells that take long; none: in the window's.
  std::function<Result<render::Image>(const PictureRequest& request)> draw_still;
  /// Writes a preset as a file, with its tables in separate files of the same name's start.
  std::function<Result<void>(const preset::Preset& preset, const std::filesystem::path& file)>
      write_preset;
  /// The movie of a preset's file in a folder.
  std::function<Result<void>(const std::filesystem::path& preset,
                             const std::filesystem::path& folder, const ProgressListener&,
                             const Watch&)>
      make_movie;
  /// Writes the shell of a preset, in the format of the file's ending.
  std::function<Result<void>(const preset::Preset& preset, const std::filesystem::path& file,
                             const ProgressListener&, const Watch&)>
      export_shell;
  std::vector<app::ExportFormat> export_formats;
  /// What a run ended in, or the joints of a scan.
  std::function<Result<OtherShell>(const std::filesystem::path& run)> load_run;
  /// Shows the manual in a browser. Errors: io where there is none, saying where the manual is.
  std::function<Result<void>(const Watch& watch)> show_manual;
  std::filesystem::path save_to = "out";
};

/// A rod, and which of its nodes.
struct PointOnRod {
  int rod = -1;  ///< none
  int point = 0;
};

/// What can be plotted over what; named as columns of frames.csv.
struct Quantity {
  const char *name, *label;
  double PlotPoint::*value;
};
inline constexpr Quantity quantities[] = {
    {"equilibrium", "state number", &PlotPoint::equilibrium},
    {"progress", "progress", &PlotPoint::progress},
    {"boundary_radius_mm", "Rₐ (mm)", &PlotPoint::radius_mm},
    {"depth_mm", "depth (mm)", &PlotPoint::depth_mm},
    {"force_N", "force (N)", &PlotPoint::force_N},
    {"height_mm", "height (mm)", &PlotPoint::height_mm},
    {"energy_mJ", "total energy (mJ)", &PlotPoint::energy_mJ},
    {"total_K", "ΣK□ (rad)", &PlotPoint::total_K},
    {"residual_N", "residual (N)", &PlotPoint::residual_N},
    {"error_estimate_mm", "error estimate (mm)", &PlotPoint::error_mm}};
constexpr int quantity_called(std::string_view name) {
  for (std::size_t k = 0; k < std::size(quantities); ++k)
    if (quantities[k].name == name) return int(k);
  return -1;
}

/// The quantities of a plot; x below 0: what was moved last.
struct PlotAxes {
  int x = -1, y = 0;
};

/// A plot as it is kept.
struct PlottedCurve {
  std::string x_label, y_label;
  std::vector<double> x, y;
};

/// How a shell was looked at last.
struct SavedCamera {
  std::string preset;  ///< its name
  render::Camera camera;
  ColourBy colour_by = ColourBy::K;
};

/// What the next design may change, and how far it goes.
struct DesignOptions {
  preset::Inverse inverse;
  int most_iterations = 25;
};

/// Drawn as the camera moves: at half the resolution, rods and cells in few pieces; still: at all
/// of it.
enum class Resolution { moving, still };

class ViewerState {
 public:
  explicit ViewerState(Library library) : library(std::move(library)) {}

  // ---- what is shown ----

  Library library;
  EngineThread engine;
  std::shared_ptr<const ShellView> shell = std::make_shared<ShellView>();
  render::Camera camera;
  PictureSize view;  ///< of the shell's picture, pixels; of two side by side of each
  Show show;
  std::optional<SavedCamera> saved_camera;  ///< for when that preset's shell comes
  RangeOf range_of = RangeOf::run;          ///< of the colours
  bool numbers = false, plots = true, help = false, terms = false, picking = true,
       design_panel = false;
  bool small_window = false;      ///< one column has space next to the view
  bool plots_when_small = false;  ///< and it shows the plots
  bool find_number = false;       ///< the search over the numbers is to be typed into
  bool take_keyboard = false;     ///< the first control of the panels is to be typed into
  bool new_shell = false;         ///< the form of a shell of one's own is shown
  std::string menu_to_open;       ///< by the keyboard
  DesignOptions design;
  std::vector<PlotPoint> plot_points;
  std::vector<TimelineEntry> timeline;  ///< by the number of steps that can be undone
  std::array<PlotAxes, 3> plot_axes{PlotAxes{-1, quantity_called("height_mm")},
                                    PlotAxes{-1, quantity_called("energy_mJ")},
                                    PlotAxes{-1, quantity_called("force_N")}};
  std::string message;  ///< what was done last
  bool message_bad = false;
  int picked_joint = -1, picked_cell = -1;  ///< whose figures are shown
  PointOnRod picked_rod;
  bool measuring = false;                 ///< a click on a joint measures
  std::vector<int> measured;              ///< joints, at most three
  int joint_under = -1, edge_under = -1;  ///< marked: what the cursor is at
  bool push_freely = false;  ///< a joint goes with the mouse instead of along its normal
  bool animate_mode = false;
  double mode_phase = 0;
  bool playing = false;
  double play_head = 1, play_speed = 0.25;  ///< of the path a second
  PictureFormat picture;
  BackgroundTask picture_task, movie_task, export_task, manual_task;
  std::array<BackgroundTask*, 4> tasks() {
    return {&picture_task, &movie_task, &export_task, &manual_task};
  }
  std::optional<FileRequest> file_request;
  std::string last_folders[2];      ///< of a file that was saved, and of one that was opened
  std::vector<std::string> recent;  ///< what was opened, the last first
  std::string copied;               ///< text for the clipboard
  bool timed = true;                ///< whether what took how long is shown
  bool over = false;                ///< the window is to close

  // ---- what is done ----

  /// A preset by its name or file, or a run by its folder.
  void open(const std::string& name);
  /// A preset that has no file.
  void open(preset::Preset preset);
  /// Adds a joint to the measurement; after three it starts again.
  void measure(int joint);
  /// A command of a drag while it is `passing`; a running design refuses it.
  void post(Edit edit, bool passing);
  /// A command of its own, which ends a running design.
  void send_command(Edit edit);
  /// The drag is over: the shell goes onto finer meshes.
  void end_drag();
  /// The boundary to a progress; of a preset with a push, the push to a fraction of its depth.
  void go(double part, bool passing);
  void play(bool on);
  /// Goes back or forward to a number of steps to undo; if it is the current one and has an event,
  /// to before that.
  void go_to_step(int step);
  /// To one of the states that were found, which follow one another round.
  void recall(int state);
  /// Which of them is in sight; none: -1.
  int state_in_sight() const;
  /// Moves the boundary to the next unstable position on the path that led to the current state.
  void go_to_loss();
  /// Stops what the engine is at; of a design the last step stays.
  void stop();
  /// Designs the shell by what was chosen, coloured by its deviation.
  void start_design();
  /// Where on its path the shell is, 0 to 1.
  double part() const;
  /// The colours' ends by hand; ends that are none change nothing.
  void set_range(double low, double high);
  void toggle_gravity();
  bool gravity() const { return shell->preset.loads.gravity_m_s2 != 0; }
  void fit_view();
  void look(const render::ViewDirection& from);
  void say(const std::string& text, bool bad = false);

  // ---- what is kept ----

  /// The preset of the current shell: radius, or the steps that were done; camera, colours.
  preset::Preset preset_to_save() const;
  void save_preset();
  void save_picture();
  /// Asks for a file, with a path to begin with.
  void ask_file(FileUse use);
  /// Uses the file that was chosen; a path that is not valid is requested again.
  void take_file();
  /// Shows a run's last state next to the shell, the current state, or (null) none.
  void compare_with(const std::filesystem::path& run);
  void compare_with_this();
  /// The net that it was designed on.
  void compare_with_net();
  void compare(std::shared_ptr<const OtherShell> other);
  /// Shows the other state next to the shell instead of over it.
  void set_beside(bool on);
  /// How far the joints are from those of the same name in the other shell: "largest 3.2 mm at
  /// (0, 1), mean 1.1 mm".
  std::string difference_text() const;
  PictureRequest picture_request() const { return {shell, camera, view, show, picture}; }
  /// The size of kept pictures, pixels; of no pixels twice the view's. One that cannot be says so.
  void size_picture(int width, int height);
  /// Makes a movie of the steps, or without steps of the preset, in the background.
  void save_movie();
  /// A plot as PDF, SVG, PNG and a table.
  void save_plot(const PlottedCurve& curve);
  /// All that have anything to show.
  void save_plots();
  /// The camera as keys of [movie].
  void copy_camera();
  /// The manual's page in a browser.
  void show_manual();

  /// Once per frame: takes the latest view, plays, checks the preset's file. Returns whether
  /// anything is to be drawn again.
  bool tick(double seconds);

 private:
  void form(preset::Preset preset);
  void take(std::shared_ptr<const ShellView> next);
  void reset_view();
  void add_plot_point();
  void note_step();
  void watch_file(double seconds);
  render::Camera fitted_view() const;
  void put_view(preset::Preset& preset) const;
  std::filesystem::path path_to_save(const std::vector<std::string>& endings) const;
  Result<void> write_preset(const preset::Preset& preset, const std::filesystem::path& file) const;
  void save_preset_as(const std::filesystem::path& file);
  void draw_picture_as(const std::filesystem::path& file, const PictureFormat& format);
  void export_as(const std::filesystem::path& file);
  void report_finished_tasks();

  int drag_ = 1;
  double size_mm_ = 0;       // length scale of the shell in sight
  bool run_opened_ = false;  // the next view continues at the run's end
  bool fresh_ = true;        // the next sight is of another shell: the camera goes round it
  std::filesystem::path file_;
  std::filesystem::file_time_type written_{};
  double since_look_ = 0;
};

// How somebody likes the window: camera, colours, what is shown and which panels, from one visit to
// the next.

/// As JSON.
std::string workspace_text(const ViewerState& viewer);

/// Lays what such a text says over the viewer; what it does not say, or says wrongly, stays as it
/// is. The camera is taken once the shell of the same preset comes. Errors: bad_input for what is
/// no JSON object.
Result<void> take_workspace(ViewerState& viewer, const std::string& text);

/// Where the window keeps it: $XDG_STATE_HOME/gridshell/workspace.json, or below ~/.local/state;
/// empty where neither is known.
std::filesystem::path workspace_file();

}  // namespace gridshell::window
