// All presets to choose from, as pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/ui/panel.h"
#include "render/gl/objects.h"

namespace gridshell::ui {

class PresetPicker {
 public:
  /// `gl` outlives it.
  explicit PresetPicker(const render::Gl& gl) : gl_(&gl) {}

  void draw(const Panel& panel, const render::Box& box);

 private:
  void load(const std::vector<window::PresetCard>& cards);
  void card(const Panel& panel, const window::PresetCard& card, std::size_t number);

  const render::Gl* gl_;
  std::vector<std::optional<render::Texture>> pictures_;  // one a card, from the first sight on
};

}  // namespace gridshell::ui
