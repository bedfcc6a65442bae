#include "app/ui/preset_picker.h"

#include <algorithm>
#include <cmath>

#include "app/ui/interface_painter.h"
#include "render/image/png.h"

namespace gridshell::ui {
namespace {

constexpr double card_points = 216;             // the least width of a card
constexpr float height_of_width = 160 / 256.f;  // of the pictures in presets/pictures/cards

/// A title that is too long for its card ends in dots.
std::string shortened(const std::string& title, float width) {
  if (ImGui::CalcTextSize(title.c_str()).x <= width) return title;
  std::string begin = title;
  const auto too_long = [&] { return ImGui::CalcTextSize((begin + "…").c_str()).x > width; };
  while (!begin.empty() && too_long()) begin.pop_back();
  return begin + "…";
}

}  // namespace

void PresetPicker::load(const std::vector<window::PresetCard>& cards) {
  for (std::size_t k = pictures_.size(); k < cards.size(); ++k) {
    auto& picture = pictures_.emplace_back();
    const auto image = render::decode_png(cards[k].picture, cards[k].name);
    if (!image) continue;  // a preset without one is a card of words
    picture.emplace(*gl_);
    fill_texture(*gl_, picture->id(), image->width, image->height, image->rgba.data());
  }
}

void PresetPicker::card(const Panel& panel, const window::PresetCard& card, std::size_t number) {
  const float gap = panel.px(4), line = ImGui::GetTextLineHeight();
  const ImVec2 at = ImGui::GetCursorPos();
  const float width = ImGui::GetContentRegionAvail().x, inside = width - 2 * gap,
              high = height_of_width * inside;
  const float height = high + 2.4f * line + 2 * gap;
  ImGui::PushID(card.name.c_str());
  if (ImGui::Selectable("##card", false, 0, {0, height})) panel.desk.open(card.name);
  panel.named("preset " + card.name, card.title);
  ImGui::SetCursorPos({at.x + gap, at.y + gap});
  if (const auto& picture = pictures_[number])
    ImGui::Image(texture_id(picture->id()), {inside, high});
  ImGui::SetCursorPos({at.x + gap, at.y + high + 1.5f * gap});
  ImGui::TextUnformatted(shortened(card.name, inside).c_str());
  ImGui::SetCursorPos({at.x + gap, at.y + high + 1.5f * gap + 1.15f * line});
  ImGui::TextDisabled("%s", shortened(card.title, inside).c_str());
  ImGui::SetCursorPos({at.x, at.y + height + panel.px(6)});
  ImGui::PopID();
}

void PresetPicker::draw(const Panel& panel, const render::Box& box) {
  const std::vector<window::PresetCard>& cards = panel.desk.library.cards;
  load(cards);
  begin_fixed("presets", box, 0, Layer::over);
  ImGui::TextUnformatted("Pick a preset");
  ImGui::SameLine();
  ImGui::TextDisabled("(Ctrl+O comes back here; F1 lists keys and mouse)");
  ImGui::Separator();
  const float width = ImGui::GetContentRegionAvail().x;
  const int columns = std::max(1, int(width / panel.px(card_points)));
  if (ImGui::BeginTable("cards", columns)) {
    for (std::size_t k = 0; k < cards.size(); ++k) {
      ImGui::TableNextColumn();
      card(panel, cards[k], k);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace gridshell::ui
