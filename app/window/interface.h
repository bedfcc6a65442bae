// The complete interface, frame by frame: takes events, lays out the panels and draws them.
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
  /// Context, renderer and viewer must outlive it. Errors: io if OpenGL fails or there is no font.
  static Result<std::unique_ptr<Interface>> create(const render::Context& context,
                                                   render::Renderer& renderer, ViewerState& viewer);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Sets the size in pixels, and `density`, pixels per point of text. Errors: as create().
  Result<void> resize(int width, int height, double density);
  /// Queues an event for one of the next frames; a frame takes at most one press or release of a
  /// button. Errors: bad_input for the name of an action or control that does not exist.
  Result<void> take(const InputEvent& event);

  /// Makes one frame, `seconds` after the last one, in framebuffer 0. Returns false, and draws
  /// nothing, if it would look like the last one. Errors: those of the renderer.
  Result<bool> frame(double seconds);
  /// Makes one frame in a framebuffer of its own, from which read() takes the picture.
  Result<void> frame_offscreen(double seconds);
  /// Makes frame() draw the next frame in any case.
  void force_redraw() { drawn_.clear(); }
  render::Image read();

  /// Whether events are queued, or the picture is not drawn at full resolution yet.
  bool busy() const;
  bool events_wait() const { return !events_.empty(); }
  /// The shape of the cursor for what is under the mouse.
  render::Cursor cursor() const;
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  /// What a picture of the shell depends on, in addition to the ShellView.
  struct ShownShell {
    render::Camera camera;
    PictureSize view;
    Show show;
    bool operator==(const ShownShell&) const = default;
  };

  Interface(const render::Gl& gl, render::Renderer& renderer, ViewerState& viewer);
  void feed();
  void feed(const InputEvent& event);
  Result<Eigen::Vector2d> pixel_of(const InputEvent& event) const;
  void press_key(Key key);
  void open_menu(Key key);
  bool reaches_controls(Key key) const;
  bool close_top();
  void lay_out();
  void view_panel(const Panel& panel, render::Box box);
  Result<void> draw_shell();
  bool take_still(const PictureRequest& shown);
  Result<void> draw_states();
  Result<bool> compose(double seconds);
  bool is_new();
  void paint(bool upwards);

  render::Gl gl_;  // other members point to it
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
  bool keyboard_ = false;  // whether keys move between the controls
  bool alt_ = false, mouse_over_view_ = false;
  std::deque<InputEvent> events_;
  std::map<std::string, render::Box> controls_;
  render::Box view_;
  int width_ = 1280, height_ = 720;
  double density_ = 1;
  double still_seconds_ = 0;
  bool redraw_shell_ = true, sharp_ = false, dark_ = false;
  std::optional<ShownShell> shown_;           // what the last picture of the shell shows
  std::uint64_t pictures_ = 0;                // drawn so far
  std::vector<char> drawn_;                   // the draw lists of the last frame
  std::future<Result<render::Image>> still_;  // a sharp picture that another thread draws
  std::uint64_t still_of_ = 0;                // number of the picture that it replaces
};

// The interface in a window of the desktop.

/// Opens the window and returns when it is closed or `stopped` returns true. Calls `seen` with
/// every event. Errors: io, with what helps, if there is no GLFW, no display or no OpenGL.
Result<void> run_desktop(ViewerState& viewer, const std::function<void(const InputEvent&)>& seen,
                         const std::function<bool()>& stopped);

// The interface without a user: a recording played off-screen, and the bench that drags by itself.

/// Plays events one by one and waits after each for the equilibrium that it requests, so that every
/// machine reaches the same states. Returns when the view is sharp. Errors: those of the events and
/// the renderer, with the event.
Result<void> play(Interface& interface, ViewerState& viewer, const std::vector<InputEvent>& events);

/// What a bench measured.
struct BenchFigures {
  double interface_fps = 0, equilibria_per_s = 0, worst_frame_ms = 0, cancel_ms = 0;
  /// processor time of this process per frame, which other load on the machine does not change
  double frame_cpu_ms = 0;
};

/// Drags the radius forward and back for some seconds and rotates the camera, at most 60 frames a
/// second and each a new picture, with the engine on its own thread; then waits until the view is
/// sharp. Frames of the first second do not count as worst ones. Errors: no_equilibrium if the
/// preset has no shell; those of the renderer.
Result<BenchFigures> bench(Interface& interface, ViewerState& viewer, double seconds);

}  // namespace gridshell::window
