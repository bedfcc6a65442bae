#include "app/window/interface.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "render/gl/renderer.h"

#include "engine/core/try.h"

namespace gridshell::window {
namespace {

constexpr double least_view_px = 32;
constexpr double least_view = 400;  // width of the view, points, if plots are next to it

/// Connects keys that ImGui itself uses.
void map_keys(ImGuiIO& io) {
  const auto map = [&](ImGuiKey to, Key from) { io.KeyMap[to] = int(from); };
  map(ImGuiKey_LeftArrow, Key::left), map(ImGuiKey_RightArrow, Key::right);
  map(ImGuiKey_UpArrow, Key::up), map(ImGuiKey_DownArrow, Key::down);
  map(ImGuiKey_PageUp, Key::page_up), map(ImGuiKey_PageDown, Key::page_down);
  map(ImGuiKey_Home, Key::home), map(ImGuiKey_End, Key::end);
  map(ImGuiKey_Delete, Key::del), map(ImGuiKey_Backspace, Key::backspace);
  map(ImGuiKey_Enter, Key::enter), map(ImGuiKey_Escape, Key::escape);
  map(ImGuiKey_Tab, Key::tab), map(ImGuiKey_Space, Key::space);
  map(ImGuiKey_A, Key::a), map(ImGuiKey_C, Key::c), map(ImGuiKey_V, Key::v);
  map(ImGuiKey_X, Key::x), map(ImGuiKey_Y, Key::y), map(ImGuiKey_Z, Key::z);
}

/// Heights of the panels on the right, pixels; 0: not there.
struct Column {
  double numbers = 0, design = 0, plots = 0;
  bool any() const { return numbers + design + plots > 0; }
};

/// Distributes the height over the panels. The design has its own plot; other plots are shown with
/// it only if there is space.
Column column_of(const ViewerState& viewer, double height, double density) {
  const double least = 300 * density;
  Column column;
  double rest = height;
  if (viewer.design_panel) {
    column.design = std::min(height, std::round(480 * density));
    rest -= column.design;
  }
  const bool plots =
      viewer.plots && (!viewer.design_panel || rest >= (viewer.numbers ? 2 : 1) * least);
  if (viewer.numbers) column.numbers = plots ? rest - std::round(0.5 * rest) : rest;
  if (plots) column.plots = rest - column.numbers;
  if (!viewer.numbers && !plots && viewer.design_panel) column.design = height;
  return column;
}

/// Closes menus and lists; returns whether one was open.
bool close_popups() {
  const bool open = is_popup_open();
  if (open) ImGui::ClosePopupToLevel(0, true);
  return open;
}

/// Whether a key moves between controls or presses them.
bool moves(Key key) {
  return (key >= Key::left && key <= Key::page_down) || key == Key::space || key == Key::enter ||
         key == Key::tab;
}

/// Whether a number is typed with this key.
bool is_of_a_number(Key key) {
  return (key >= Key::n0 && key <= Key::n9) || (key >= Key::comma && key <= Key::plus);
}

bool is_modifier(Key key) { return key == Key::ctrl || key == Key::shift || key == Key::alt; }

}  // namespace

Interface::Interface(const render::Gl& gl, render::Renderer& renderer, ViewerState& viewer)
    : gl_(gl),
      imgui_(ImGui::CreateContext()),
      viewer_(viewer),
      mouse_(viewer),
      renderer_(renderer),
      picture_(gl_, renderer),
      picker_(gl_),
      target_(gl_, render::Target::Depth::none) {}

Result<std::unique_ptr<Interface>> Interface::create(const render::Context& context,
                                                     render::Renderer& renderer,
                                                     ViewerState& viewer) {
  TRY(gl, render::Gl::load(context));
  std::unique_ptr<Interface> made(new Interface(*gl, renderer, viewer));
  TRY(painter, InterfacePainter::create(made->gl_));
  made->painter_.emplace(std::move(*painter));
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::GetIO().LogFilename = nullptr;
  ImGui::GetIO().ConfigDragClickToInputText = true;
  ImGui::GetIO().ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
  map_keys(ImGui::GetIO());
  TRY_DO(made->resize(1280, 720, 1));
  return made;
}

Interface::~Interface() { ImGui::DestroyContext(imgui_); }

Result<void> Interface::resize(int width, int height, double density) {
  const bool denser = density != density_ || !ImGui::GetIO().Fonts->IsBuilt();
  width_ = width;
  height_ = height;
  density_ = density;
  redraw_shell_ = true;
  force_redraw();
  if (!denser) return {};
  TRY_DO(load_fonts(density));
  painter_->take_fonts(*ImGui::GetIO().Fonts);
  choose_colours(viewer_.show.dark, density);
  return {};
}

// ---- events ----

Result<Eigen::Vector2d> Interface::pixel_of(const InputEvent& event) const {
  if (event.text.empty()) return Eigen::Vector2d(event.x, event.y);
  const Eigen::Vector2d offset(event.x, event.y);
  int i = 0, j = 0;
  if (viewer_.shell->any() && std::sscanf(event.text.c_str(), "joint:%d,%d", &i, &j) == 2)
    for (const record::Joint& joint : viewer_.shell->layout->joints)
      if (joint.i == i && joint.j == j)
        return Eigen::Vector2d(in_view(viewer_, view_, joint.node) + offset);
  if (viewer_.shell->any() && std::sscanf(event.text.c_str(), "edge:%d", &i) == 1 && i >= 0 &&
      i < int(viewer_.shell->layout->edge_points.size()))
    return Eigen::Vector2d(
        in_view(viewer_, view_, viewer_.shell->layout->edge_points[std::size_t(i)]) + offset);
  std::string name = event.text;
  std::replace(name.begin(), name.end(), '_', ' ');
  for (const std::string& requested : {event.text, name})
    if (const auto found = controls_.find(requested); found != controls_.end()) {
      const render::Box& box = found->second;
      return Eigen::Vector2d(box.x + event.x * box.width, box.y + event.y * box.height);
    }
  return invalid("'{}': nothing of that name is shown", event.text);
}

Result<void> Interface::take(const InputEvent& event) {
  InputEvent taken = event;
  if (event.kind == InputKind::size) return resize(int(event.x), int(event.y), event.density);
  if (event.kind == InputKind::mouse) {
    TRY(pixel, pixel_of(event));
    taken.x = pixel->x();
    taken.y = pixel->y();
    taken.text.clear();
  }
  if (event.kind == InputKind::act && !find_action(event.text))
    return invalid("'{}' is no action", event.text);
  events_.push_back(std::move(taken));
  return {};
}

/// Passes the queued events on, up to the second press or release: ImGui would not see a press and
/// a release in one frame.
void Interface::feed() {
  int turns = 0;
  const auto turns_one = [](const InputEvent& event) {
    return event.kind == InputKind::press || event.kind == InputKind::release ||
           event.kind == InputKind::down || event.kind == InputKind::up;
  };
  while (!events_.empty()) {
    const InputEvent event = events_.front();
    if (turns_one(event) && turns++ > 0) return;
    // a motion after a press or release belongs to the next frame
    if (turns > 0 && event.kind == InputKind::mouse) return;
    events_.pop_front();
    feed(event);
  }
}

void Interface::feed(const InputEvent& event) {
  ImGuiIO& io = ImGui::GetIO();
  switch (event.kind) {
    case InputKind::mouse:
      io.MousePos = {float(event.x), float(event.y)};
      break;
    case InputKind::press:
    case InputKind::release:
      io.MouseDown[int(event.button)] = event.kind == InputKind::press;
      keyboard_ = false;
      break;
    case InputKind::wheel:
      io.MouseWheel += float(event.y);
      break;
    case InputKind::down:
    case InputKind::up: {
      const bool down = event.kind == InputKind::down;
      io.KeysDown[int(event.key)] = down && reaches_controls(event.key);
      if (event.key == Key::ctrl) io.KeyCtrl = down;
      if (event.key == Key::shift) io.KeyShift = down;
      if (event.key == Key::alt) alt_ = down;
      if (down) press_key(event.key);
      break;
    }
    case InputKind::type:
      io.AddInputCharactersUTF8(event.text.c_str());
      break;
    case InputKind::act:
      find_action(event.text)->perform(viewer_);
      break;
    case InputKind::open:
      viewer_.open(event.text);
      break;
    case InputKind::size:
    case InputKind::wait:
      break;
  }
}

/// Closes menus and lists, or else panels over the window; returns whether there were any.
bool Interface::close_top() {
  if (close_popups()) return true;
  const bool any = viewer_.file_request || viewer_.help || viewer_.terms || viewer_.new_shell;
  viewer_.file_request.reset();
  viewer_.help = viewer_.terms = viewer_.new_shell = false;
  return any;
}

/// Whether ImGui gets a key. Those that move between controls it gets only if the keyboard is used
/// for that, or in menus and text fields.
bool Interface::reaches_controls(Key key) const {
  return !moves(key) || keyboard_ || ImGui::GetIO().WantTextInput || is_popup_open();
}

/// Opens the menu whose name begins with the letter; F10 opens the first one.
void Interface::open_menu(Key key) {
  const std::string_view letter = word_of(key);
  for (const Action& action : actions()) {
    if (key != Key::f10 && (letter.size() != 1 || letter.front() != action.menu[0])) continue;
    viewer_.menu_to_open = action.menu;
    keyboard_ = true;
    return;
  }
}

void Interface::press_key(Key key) {
  const ImGuiIO& io = ImGui::GetIO();
  if (key == Key::escape && close_top()) return;
  if (is_modifier(key)) return;
  if (alt_ || key == Key::f10) return open_menu(key);
  if (io.WantTextInput) return;
  if (key == Key::escape && std::exchange(keyboard_, false)) return;
  if (key == Key::tab && !io.KeyCtrl && !keyboard_) {
    keyboard_ = viewer_.take_keyboard = true;
    return;
  }
  // digits typed over a number do not turn the camera
  const bool over_control =
      ImGui::GetCurrentContext()->HoveredIdPreviousFrame != 0 && !mouse_over_view_;
  if ((keyboard_ || is_popup_open()) && (moves(key) || is_of_a_number(key))) return;
  if (over_control && is_of_a_number(key)) return;
  if (key == Key::escape && viewer_.picking && viewer_.shell->any()) viewer_.picking = false;
  const Action* action = action_of({key, io.KeyCtrl, io.KeyShift});
  if (!action) return;
  // a shell that is hidden is not changed
  const bool hidden =
      viewer_.help || viewer_.terms || viewer_.picking || viewer_.file_request || viewer_.new_shell;
  const std::string menu = action->menu;
  if (hidden && (menu == "Shell" || menu == "Edit")) return;
  action->perform(viewer_);
}

// ---- a frame ----

void Interface::view_panel(const Panel& panel, render::Box box) {
  // in a window without room for it the view has still a picture
  box.width = std::max(box.width, least_view_px);
  box.height = std::max(box.height, least_view_px);
  // if two are side by side, the left one is edited
  view_ = box;
  view_.width /= viewer_.show.shells();
  viewer_.view = {view_.width, view_.height};
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
  begin_fixed("view", box, ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  ImGui::PopStyleVar();
  const ImVec2 low{float(box.x), float(box.y)}, high{float(box.right()), float(box.bottom())};
  if (viewer_.shell->any())
    ImGui::GetWindowDrawList()->AddImage(texture_id(picture_.texture()), low, high);
  ImGui::SetCursorScreenPos(low);
  ImGui::InvisibleButton("mouse", {float(box.width), float(box.height)},
                         ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight |
                             ImGuiButtonFlags_MouseButtonMiddle);
  ImGui::SetItemAllowOverlap();
  panel.controls["view"] = box;
  const ImGuiIO& io = ImGui::GetIO();
  const double x = io.MousePos.x - low.x, y = io.MousePos.y - low.y;
  mouse_over_view_ = ImGui::IsItemHovered();
  if (mouse_.dragging()) {
    mouse_.drag(x, y);
    if (!ImGui::IsItemActive()) mouse_.release(x, y);
  } else if (ImGui::IsItemHovered()) {
    mouse_.hover(x, y);
    if (io.MouseWheel != 0) mouse_.wheel(io.MouseWheel, std::fmod(x, view_.width), y);
    for (int button = 0; button < 3; ++button)
      if (ImGui::IsMouseClicked(button)) mouse_.press(Button(button), io.KeyShift, x, y);
  } else {
    mouse_.leave();
  }
  view_overlay(panel, view_);
  colour_legend(panel, box);
  ImGui::End();
}

void Interface::lay_out() {
  Panel panel{viewer_, density_, controls_};
  for (const auto& [state, picture] : states_)
    panel.states.push_back(texture_id(picture.texture()));
  const double left = std::round(272 * density_), right = std::round(272 * density_),
               status = std::round(30 * density_),
               strip = std::round((states_.empty() ? 32 : 56) * density_);
  controls_.clear();
  menu_bar(panel);
  const double top = ImGui::GetFrameHeight(), height = height_ - top - status - strip;
  viewer_.small_window = width_ - left - right < least_view * density_;
  const render::Box first{0, top, left, height};
  if (viewer_.small_window) {
    // a single column, for the panel that was requested
    if (viewer_.plots_when_small)
      plots_panel(panel, first);
    else if (viewer_.design_panel)
      design_panel(panel, first);
    else if (viewer_.numbers)
      numbers_.draw(panel, first);
    else
      shell_panel(panel, first);
    view_panel(panel, {left, top, width_ - left, height});
  } else {
    const Column column = column_of(viewer_, height, density_);
    shell_panel(panel, first);
    view_panel(panel, {left, top, width_ - left - (column.any() ? right : 0), height});
    double from = top;
    const auto next = [&](double part) {
      from += part;
      return render::Box{width_ - right, from - part, right, part};
    };
    if (column.numbers > 0) numbers_.draw(panel, next(column.numbers));
    if (column.design > 0) design_panel(panel, next(column.design));
    if (column.plots > 0) plots_panel(panel, next(column.plots));
  }
  timeline_panel(panel, {0, top + height, double(width_), strip});
  status_line(panel, {0, top + height + strip, double(width_), status});
  if (viewer_.picking && !viewer_.help) picker_.draw(panel, {left, top, width_ - left, height});
  const double around = (viewer_.small_window ? 10 : 60) * density_;
  if (viewer_.new_shell)
    new_shell_.draw(panel, render::Box{0, top, double(width_), height}.inset(around));
  if (viewer_.file_request)
    files_.draw(panel, render::Box{0, top, double(width_), height}.inset(around));
  if (viewer_.terms) terms_sheet(panel, render::Box{0, top, double(width_), height}.inset(around));
  if (viewer_.help)
    help_sheet(panel, render::Box{0, top, double(width_), height}.inset(20 * density_));
}

bool Interface::busy() const {
  return !events_.empty() || (viewer_.shell->any() && (redraw_shell_ || !sharp_));
}

render::Cursor Interface::cursor() const {
  if (ImGui::GetMouseCursor() == ImGuiMouseCursor_TextInput) return render::Cursor::text;
  if (viewer_.joint_under >= 0)
    return viewer_.measuring ? render::Cursor::cross : render::Cursor::hand;
  return viewer_.edge_under >= 0 ? render::Cursor::hand : render::Cursor::arrow;
}

}  // namespace gridshell::window
