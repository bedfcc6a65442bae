// The state of the window: the shell, how it is shown, what is picked, what plays. It uses neither
// OpenGL nor the interface library; panels show it, actions and the view change it.
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

/// The heading under which the page of presets has the preset of this name.
const char* group_of(const std::string& preset);

/// The format of saved pictures.
struct PictureFormat {
  int width = 0, height = 0;  ///< pixels; 0: twice the view's
  render::Quality quality = render::Quality::movie;
  bool legend = true;  ///< with a legend of the colours
  double dpi = 0;      ///< resolution in the file; 0: none
};

/// Checks the size of a picture, pixels. Errors (bad_input): too small or too large.
Result<void> check_picture(int width, int height);

/// Everything that a picture depends on.
struct PictureRequest {
  std::shared_ptr<const ShellView> shell;
  render::Camera camera;
  PictureSize view;  ///< size of the picture that the camera sees
  Show show;
  PictureFormat format;
};

/// A point of the timeline: the state after a step, and the events of the step.
struct TimelineEntry {
  std::string text, event;
  bool stable = true;
  std::shared_ptr<const preset::Step> event_at = {};  ///< the step that had the event
};
/// The last step, as text: "pushed (0, 0): 8.16 mm, 0.0342 N".
std::string text_of_step(const ShellView& shell);
/// A sentence with the estimated error of the joints, which one mesh alone does not give.
std::string text_of_error(const Certificate& certificate);

/// Purpose of a file prompt.
enum class FileUse { open, compare, save_preset, save_picture, export_shell };
/// Whether the file is read; else it is written.
constexpr bool is_read(FileUse use) { return use == FileUse::open || use == FileUse::compare; }

/// A file prompt.
struct FileRequest {
  FileUse use = FileUse::open;
  std::string path;                 ///< as typed so far
  std::string folder;               ///< the folder that is shown; a name without a folder is in it
  double width_mm = 85, dpi = 300;  ///< size and resolution of a picture in print
  std::string replaced = {};        ///< an existing file that the user agreed to replace
};

/// Functions that load presets and runs and make files, and the folder for saved files.
struct Library {
  std::vector<PresetCard> cards;
  std::function<Result<preset::Preset>(const std::string& name)> load;
  std::function<Result<void>(const PictureRequest& request, const std::filesystem::path& file)>
      draw_picture;
  /// Draws the view at full resolution on any thread, for shells that take long; empty: the thread
  /// of the window draws.
  std::function<Result<render::Image>(const PictureRequest& request)> draw_still;
  /// Writes a preset; its tables are in separate files whose names begin with that of the preset.
  std::function<Result<void>(const preset::Preset& preset, const std::filesystem::path& file)>
      write_preset;
  /// Makes the movie of a preset's file, in a folder.
  std::function<Result<void>(const std::filesystem::path& preset,
                             const std::filesystem::path& folder, const ProgressListener&,
                             const Watch&)>
      make_movie;
  /// Writes the shell of a preset, in the format of the file's ending.
  std::function<Result<void>(const preset::Preset& preset, const std::filesystem::path& file,
                             const ProgressListener&, const Watch&)>
      export_shell;
  std::vector<app::ExportFormat> export_formats;
  /// Loads the last state of a run, or the joints of a scan.
  std::function<Result<OtherShell>(const std::filesystem::path& run)> load_run;
  /// Shows the manual in a browser. Errors: io if there is none, with the path of the manual.
  std::function<Result<void>(const Watch& watch)> show_manual;
  std::filesystem::path save_to = "out";
};

/// A node of a rod.
struct PointOnRod {
  int rod = -1;   ///< -1: none
  int point = 0;  ///< index of the node in the rod
};

/// A quantity of the plots, named like the columns of frames.csv.
struct Quantity {
  const char *name, *label;
  double PlotPoint::*value;
};
inline constexpr Quantity quantities[] = {
    {"equilibrium", "equilibrium number", &PlotPoint::equilibrium},
    {"progress", "progress", &PlotPoint::progress},
    {"boundary_radius_mm", "Rₐ (mm)", &PlotPoint::radius_mm},
    {"depth_mm", "depth (mm)", &PlotPoint::depth_mm},
    {"force_N", "force (N)", &PlotPoint::force_N},
    {"height_mm", "height (mm)", &PlotPoint::height_mm},
    {"energy_mJ", "total energy (mJ)", &PlotPoint::energy_mJ},
    {"total_K", "ΣK□ (rad)", &PlotPoint::total_K},
    {"residual_N", "residual (N)", &PlotPoint::residual_N},
    {"error_estimate_mm", "error estimate (mm)", &PlotPoint::error_mm}};
/// The index of a quantity; -1 if there is none with this name.
constexpr int quantity_called(std::string_view name) {
  for (std::size_t k = 0; k < std::size(quantities); ++k)
    if (quantities[k].name == name) return int(k);
  return -1;
}

/// The quantities of a plot, as indices; x below 0: that which was moved last.
struct PlotAxes {
  int x = -1, y = 0;
};

struct Curve;

/// The camera and the colours with which a shell was last shown.
struct SavedCamera {
  std::string preset;  ///< its name
  render::Camera camera;
  ColourBy colour_by = ColourBy::K;
};

/// What the next design may change, and its number of iterations.
struct DesignOptions {
  preset::Inverse inverse;
  int most_iterations = 25;
};

/// The resolution of the view. `moving`: half of it, rods and cells with few triangles, for a
/// camera that moves; `still`: full.
enum class Resolution { moving, still };

/// The state of the window.
class ViewerState {
 public:
  explicit ViewerState(Library library) : library(std::move(library)) {}

  // ---- what is shown ----

  Library library;
  EngineThread engine;
  std::shared_ptr<const ShellView> shell = std::make_shared<ShellView>();
  render::Camera camera;
  PictureSize view;  ///< size of the shell's picture, pixels; if two are side by side, of each
  Show show;
  std::optional<SavedCamera> saved_camera;  ///< used when a shell of that preset is shown
  RangeOf range_of = RangeOf::run;          ///< of the colours
  bool numbers = false, plots = true, help = false, terms = false, picking = true,
       design_panel = false;
  bool small_window = false;      ///< one column has space next to the view
  bool plots_when_small = false;  ///< whether that column shows the plots
  bool find_number = false;       ///< gives the keyboard to the search over the numbers
  bool take_keyboard = false;     ///< gives the keyboard to the first control of the panels
  bool new_shell = false;         ///< the form of a new shell is shown
  std::string menu_to_open;       ///< menu that the keyboard opens in the next frame
  DesignOptions design;
  std::vector<PlotPoint> plot_points;
  std::vector<TimelineEntry> timeline;  ///< indexed by the number of steps that can be undone
  std::array<PlotAxes, 3> plot_axes{PlotAxes{-1, quantity_called("height_mm")},
                                    PlotAxes{-1, quantity_called("energy_mJ")},
                                    PlotAxes{-1, quantity_called("force_N")}};
  std::string message;  ///< the last message or error
  bool message_bad = false;
  int picked_joint = -1, picked_cell = -1;  ///< the panel shows their values
  PointOnRod picked_rod;
  bool measuring = false;                 ///< a click on a joint measures
  std::vector<int> measured;              ///< joints, at most three
  int joint_under = -1, edge_under = -1;  ///< under the cursor, marked
  bool push_freely = false;  ///< a joint follows the mouse instead of moving along its normal
  bool animate_mode = false;
  double mode_phase = 0;
  bool playing = false;
  double play_head = 1, play_speed = 0.25;  ///< play_speed: fraction of the path per second
  PictureFormat picture;
  BackgroundTask picture_task, movie_task, export_task, manual_task;
  std::array<BackgroundTask*, 4> tasks() {
    return {&picture_task, &movie_task, &export_task, &manual_task};
  }
  std::optional<FileRequest> file_request;
  std::string last_folders[2];      ///< of the last saved file, and of the last opened one
  std::vector<std::string> recent;  ///< presets and runs that were opened, the last first
  static constexpr std::size_t most_recent = 8;
  std::string copied;  ///< text for the clipboard
  bool timed = true;   ///< whether times are shown
  bool over = false;   ///< whether the window shall close

  // ---- what is done ----

  /// Opens a preset by its name or file, or a run by its folder.
  void open(const std::string& name);
  /// Opens a preset that has no file.
  void open(preset::Preset preset);
  /// Adds a joint to the measurement; after three it starts again.
  void measure(int joint);
  /// Posts a command of the current drag, which ends with the first command that is not `passing`.
  /// It is refused while a design is running.
  void post(Edit edit, bool passing);
  /// Posts a command that belongs to no drag; it stops a running design.
  void send_command(Edit edit);
  /// Ends the drag, after which the shell is computed on finer meshes.
  void end_drag();
  /// Moves the boundary to a progress; for a preset with a push, pushes to a fraction of its depth.
  void go(double part, bool passing);
  void play(bool on);
  /// Undoes or repeats steps until `step` of them can be undone. If that is the current number and
  /// the last step had an event, undoes that step.
  void go_to_step(int step);
  /// Restores one of the states that were found; the last one is followed by the first.
  void recall(int state);
  /// The index of the found state that is shown; -1: none is.
  int current_state() const;
  /// Moves the boundary to the middle of the next unstable interval on its path.
  void go_to_loss();
  /// Stops the engine; the last step of a design remains.
  void stop();
  /// Starts a design with the chosen options, and colours the shell by its deviation.
  void start_design();
  /// Fraction of the path, 0 to 1, at which the shell is.
  double part() const;
  /// Sets the range of the colours; does nothing unless low < high.
  void set_range(double low, double high);
  /// Switches the rods' weight. Without a density it takes that of their material and reports it;
  /// if their material is not known either, it is refused.
  void toggle_gravity();
  bool gravity() const { return shell->preset.loads.gravity_m_s2 != 0; }
  void fit_view();
  void look(const render::ViewDirection& from);
  void say(const std::string& text, bool bad = false);

  // ---- what is saved ----

  /// The preset of the current shell, with its radius or its steps, camera and colours.
  preset::Preset preset_to_save() const;
  void save_preset();
  void save_picture();
  /// Opens the file prompt, with a path to begin with.
  void ask_file(FileUse use);
  /// Uses the chosen file and closes the prompt; if the path is not valid, the prompt remains open.
  void take_file();
  /// Compares the shell with the last state of a run or with a scan; with its current state; with
  /// the net that it was designed on; or with any other state (null: with none).
  void compare_with(const std::filesystem::path& run);
  void compare_with_this();
  void compare_with_net();
  void compare(std::shared_ptr<const OtherShell> other);
  /// Shows the other state next to the shell instead of over it.
  void show_side_by_side(bool on);
  /// The distances of the joints from those with the same indices in the other shell: "largest
  /// distance 3.2 mm at joint (0, 1), mean 1.1 mm".
  std::string difference_text() const;
  PictureRequest picture_request() const { return {shell, camera, view, show, picture}; }
  /// Sets the size of saved pictures, pixels; 0 x 0: twice the view's. A size that is not possible
  /// is reported.
  void size_picture(int width, int height);
  /// Makes a movie in the background: of the steps, or, if there are none, of the preset.
  void save_movie();
  /// Saves plots of curves, which are not empty, as PDF, SVG, PNG and a table.
  void save_plots(const std::vector<Curve>& curves);
  /// Saves all plots that are not empty.
  void save_plots();
  /// Copies the camera, as keys of [movie].
  void copy_camera();
  /// Shows the manual in a browser.
  void show_manual();

  /// Once per frame: takes the latest view, plays, checks the preset's file. Returns whether
  /// anything is to be drawn again.
  bool tick(double seconds);

 private:
  void form(preset::Preset preset);
  void clear_picked();
  void take(std::shared_ptr<const ShellView> next);
  void reset_view();
  void add_plot_point();
  void note_step();
  void watch_file(double seconds);
  render::Camera fitted_view() const;
  void put_view(preset::Preset& preset) const;
  double largest_push_mm(const preset::Preset& preset) const;
  std::filesystem::path path_to_save(const std::vector<std::string>& endings) const;
  Result<void> write_preset(const preset::Preset& preset, const std::filesystem::path& file) const;
  void save_preset_as(const std::filesystem::path& file);
  void draw_picture_as(const std::filesystem::path& file, const PictureFormat& format);
  void export_as(const std::filesystem::path& file);
  void report_finished_tasks();

  int drag_ = 1;
  double size_mm_ = 0;       // length scale of the shell that is shown
  bool run_opened_ = false;  // a run was opened: its path is followed to the end once it is formed
  bool fresh_ = true;        // the next view is of another shell, so the camera is set again
  std::filesystem::path file_;
  std::filesystem::file_time_type written_{};
  double since_look_ = 0;
};

}  // namespace gridshell::window
