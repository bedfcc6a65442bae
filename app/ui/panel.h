// What panels share: where they stand, what controls are called, and their tooltips.
#pragma once

#include <imgui.h>

#include <map>
#include <memory>
#include <set>
#include <string>

#include "app/window/actions.h"
#include "engine/preset/field.h"
#include "render/plot/canvas.h"

namespace gridshell::ui {

/// One frame of the interface: what panels draw into.
struct Panel {
  window::Desk& desk;
  double density = 1;                            ///< pixels a point of text
  std::map<std::string, render::Box>& controls;  ///< where each control stands, by its name

  float px(double points) const { return float(points * density); }
  /// Notes where the last control is, and gives it a tooltip.
  void named(const std::string& name, const std::string& tip) const;
  /// A button or a tick of an action, with its help and key.
  void button(const char* action) const;
  /// With a text of its own where the panel says the rest; pale where it can do nothing now.
  void button(const char* action, const char* text, bool able) const;
  void tick(const char* action) const;
};

/// Opens a window of fixed place without a title; ImGui::End() closes it.
/// Fixed ones lie behind those that come up over them.
enum class Layer { fixed, over };
void begin_fixed(const char* name, const render::Box& box, ImGuiWindowFlags more = 0,
                 Layer layer = Layer::fixed);

/// Whether the last control is being typed into: what stands there is not meant yet.
bool is_typed_into();

/// A small heading within a panel.
void heading(const Panel& panel, const char* text);

// ---- the panels, a file each ----

void menu_bar(const Panel& panel);
void shell_panel(const Panel& panel, const render::Box& box);
void plots_panel(const Panel& panel, const render::Box& box);
void design_panel(const Panel& panel, const render::Box& box);
void status_line(const Panel& panel, const render::Box& box);
void help_sheet(const Panel& panel, const render::Box& box);
void colour_legend(const Panel& panel, const render::Box& view);

/// Every number of the preset, from the field table; remembers what is being changed.
class NumbersPanel {
 public:
  void draw(const Panel& panel, const render::Box& box);

 private:
  bool edit(const Panel& panel, const preset::Field& field);
  void look(const window::Desk& desk);
  void find_idle();

  std::shared_ptr<const window::Sight> seen_;  // that the numbers are of
  preset::Preset edited_;
  std::set<std::string> idle_;  // keys that count for nothing in it
  std::string active_;          // the key under the hand
  bool typed_ = false;          // digits that are not meant yet
};

}  // namespace gridshell::ui
