// The whole interface, frame by frame: takes events, lays out the panels, draws into whatever
// framebuffer is bound.
#pragma once

#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/actions.h"
#include "app/window/imgui_painter.h"
#include "app/window/input_event.h"
#include "app/window/panel.h"
#include "app/window/viewer_state.h"
#include "render/gl/context.h"
#include "render/gl/opengl.h"

struct ImGuiContext;

namespace gridshell::window {

class Interface {
 public:
  /// Context and viewer outlive it. Errors: io, of OpenGL or without a font.
  static Result<std::unique_ptr<Interface>> create(const render::Context& context,
                                                   render::Renderer& renderer, ViewerState& viewer);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Pixels, and pixels a point of text. Errors: as create().
  Result<void> resize(int width, int height, double density);
  /// Comes with one of the next frames: one press or release of a button a frame. Errors: bad_input
  /// for the name of something that is not there.
  Result<void> take(const InputEvent& event);

  /// One frame after so many seconds, into framebuffer 0; false: it would be as the last one, and
  /// nothing was drawn. Errors: the renderer's.
  Result<bool> frame(double seconds);
  /// One frame into a picture of its own, which read() gives.
  Result<void> frame_aside(double seconds);
  /// The next frame is drawn whatever it shows.
  void draw_anew() { drawn_.clear(); }
  render::Image read();

  /// Whether events wait or the picture is still to become sharp.
  bool busy() const;
  bool events_wait() const { return !events_.empty(); }
  /// What a press would do where the mouse is.
  render::Cursor cursor() const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  /// What a picture of the shell depends on, in addition to the view.
  struct ShownShell {
    render::Camera camera;
    PictureSize view;
    Show show;
    bool operator==(const ShownShell&) const = default;
  };

  Interface(const render::Gl& gl, render::Renderer& renderer, ViewerState& viewer);
  void feed();
  void feed(const InputEvent& event);
  Result<Eigen::Vector2d> place_of(const InputEvent& event) const;
  void press_key(Key key);
  void open_menu(Key key);
  bool reaches_controls(Key key) const;
  bool close_top();
  void lay_out();
  void view_panel(const Panel& panel, const render::Box& box);
  Result<void> draw_shell();
  bool take_still(const PictureRequest& shown);
  Result<void> draw_states();
  Result<bool> compose(double seconds);
  bool is_new();
  void paint(bool upwards);

  render::Gl gl_;  // others point to it
  ImGuiContext* imgui_;
  std::optional<InterfacePainter> painter_;
  ViewerState& viewer_;
  Picker mouse_;
  render::Renderer& renderer_;
  ShellPicture picture_;
  // pictures of the states that were found
  std::vector<std::pair<std::shared_ptr<const ShellView>, ShellPicture>> states_;
  NumbersPanel numbers_;
  PresetPicker picker_;
  FilePrompt files_;
  NewShellForm new_shell_;
  render::Target target_;
  bool keyboard_ = false;  // moves between the controls
  bool alt_ = false, mouse_over_view_ = false;
  std::deque<InputEvent> events_;
  std::map<std::string, render::Box> controls_;
  render::Box view_;
  int width_ = 1280, height_ = 720;
  double density_ = 1;
  double still_seconds_ = 0;
  bool shell_anew_ = true, sharp_ = false, dark_ = false;
  std::optional<ShownShell> shown_;           // the last picture
  std::uint64_t pictures_ = 0;                // drawn so far
  std::vector<char> drawn_;                   // what the last frame was drawn from
  std::future<Result<render::Image>> still_;  // being drawn on a thread of its own
  std::uint64_t still_of_ = 0;                // the picture that it makes sharp
};

// The interface in a window of the desktop.

/// Opens the window and stays until it is closed or `stopped`. Every event goes to `seen` as well.
/// Errors: io where there is no GLFW, no display or no OpenGL, saying what to use instead.
Result<void> run_desktop(ViewerState& viewer, const std::function<void(const InputEvent&)>& seen,
                         const std::function<bool()>& stopped);

// The interface without a user: a recording played off-screen, and the bench that drags by itself.

/// Plays events one by one, each with the equilibrium that it asks for awaited: the same states on
/// every machine. Ends with the view sharp. Errors: those of the events and the renderer, naming
/// the event.
Result<void> play(Interface& interface, ViewerState& viewer, const std::vector<InputEvent>& events);

/// What a bench measured.
struct BenchFigures {
  double interface_fps = 0, equilibria_per_s = 0, worst_frame_ms = 0, cancel_ms = 0;
  /// of the processor time of this process, also on a machine with other load
  double frame_cpu_ms = 0;
};

/// Drags the radius to and fro for some seconds and rotates the camera, at most 60 frames a second
/// and each a new picture, with the engine on its own thread; then waits until the view is sharp.
/// Frames of the first second do not count as worst ones. Errors: no_equilibrium if the preset has
/// no shell; those of the renderer.
Result<BenchFigures> bench(Interface& interface, ViewerState& viewer, double seconds);

}  // namespace gridshell::window
