// The whole interface, frame by frame: takes events, lays out the panels, draws into whatever
// framebuffer is bound.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "app/ui/interface_painter.h"
#include "app/ui/panel.h"
#include "app/ui/preset_picker.h"
#include "app/ui/shell_picture.h"
#include "app/window/input_event.h"
#include "app/window/view_hand.h"
#include "render/context/context.h"
#include "render/gl/target.h"

struct ImGuiContext;

namespace gridshell::ui {

class Interface {
 public:
  /// Context and desk outlive it. Errors: io, of OpenGL or without a font.
  static Result<std::unique_ptr<Interface>> create(const render::Context& context,
                                                   render::Renderer& renderer, window::Desk& desk);
  ~Interface();
  Interface(const Interface&) = delete;
  Interface& operator=(const Interface&) = delete;

  /// Pixels, and pixels a point of text. Errors: as create().
  Result<void> resize(int width, int height, double density);
  /// Comes with one of the next frames: one press or release of a button a frame. Errors: bad_input
  /// for the name of something that is not there.
  Result<void> take(const window::InputEvent& event);

  /// One frame after so many seconds, into framebuffer 0. Errors: the renderer's.
  Result<void> frame(double seconds);
  /// One frame into a picture of its own, which read() gives.
  Result<void> frame_aside(double seconds);
  render::Image read();

  /// Whether events wait or the picture is still to become sharp.
  bool busy() const;
  bool events_wait() const { return !events_.empty(); }
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  /// What a picture of the shell hangs on, beside the sight.
  struct ShownShell {
    render::Camera camera;
    window::PictureSize view;
    window::Show show;
    bool operator==(const ShownShell&) const = default;
  };

  Interface(const render::Gl& gl, render::Renderer& renderer, window::Desk& desk);
  void feed();
  void feed(const window::InputEvent& event);
  Result<Eigen::Vector2d> place_of(const window::InputEvent& event) const;
  Eigen::Vector2d in_view(int node) const;
  void mark_picked();
  void mark_under();
  void write_forces();
  void press_key(window::Key key);
  void lay_out();
  void view_panel(const Panel& panel, const render::Box& box);
  Result<void> draw_shell();
  Result<void> compose(double seconds);

  render::Gl gl_;  // others point to it
  ImGuiContext* imgui_;
  std::optional<InterfacePainter> painter_;
  window::Desk& desk_;
  window::ViewHand hand_;
  ShellPicture picture_;
  NumbersPanel numbers_;
  PresetPicker picker_;
  render::Target target_;
  std::deque<window::InputEvent> events_;
  std::map<std::string, render::Box> controls_;
  render::Box view_;
  int width_ = 1280, height_ = 720;
  double density_ = 1;
  double still_seconds_ = 0;
  bool shell_anew_ = true, sharp_ = false, dark_ = false;
  std::optional<ShownShell> shown_;  // the last picture
};

}  // namespace gridshell::ui
