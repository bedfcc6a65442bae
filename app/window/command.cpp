#include "app/window/command.h"

#include <algorithm>
#include <utility>

namespace gridshell::window {

std::vector<preset::Step> steps_of(const StepHistory& history) {
  std::vector<preset::Step> steps;
  for (const auto& step : history) steps.push_back(*step);
  return steps;
}

namespace {

ChangeKind kind_of_key(const preset::Preset& preset, const preset::Field& field) {
  const auto among = [&](std::initializer_list<const char*> tables) {
    return std::ranges::any_of(tables, [&](const char* table) { return field.table == table; });
  };
  if (among({"", "movie", "style", "figure", "page", "sweep", "jitter", "inverse"}))
    return ChangeKind::looks;
  if (among({"rod", "rod_v", "joints", "loads"})) return ChangeKind::rods;
  // the rod model determines the state that a shell reaches, the other keys only its accuracy
  if (field.table == "accuracy" && field.key != "model") return ChangeKind::accuracy;
  const bool circle = preset.footprint.kind == preset::FootprintKind::circle;
  if (circle && field.table == "actuation" && (field.key == "radius_mm" || field.key == "ratio"))
    return ChangeKind::boundary;
  return ChangeKind::shape;
}

bool is_list(const preset::Field& field) {
  const auto& all = preset::tables();
  return std::ranges::any_of(
      all, [&](const preset::Table& table) { return table.list && table.name == field.table; });
}

/// The text of the tables that are lists: building blocks, their seams, steps.
std::string lists_of(const preset::Preset& preset) {
  bool any = false;
  preset::each_list([&](const char*, auto member) { any |= !(preset.*member).empty(); });
  if (!any) return "";
  const std::string text = preset::to_toml(preset);
  return text.substr(std::min(text.size(), text.find("[[")));
}

}  // namespace

ChangeKind kind_of_change(const preset::Preset& before, const preset::Preset& after) {
  ChangeKind kind = ChangeKind::none;
  int kinds = 0;
  if (lists_of(before) != lists_of(after)) return ChangeKind::shape;
  for (const preset::Field& field : preset::field_table()) {
    if (is_list(field) || value_text(field, before) == value_text(field, after)) continue;
    const ChangeKind one = kind_of_key(after, field);
    if (one == kind) continue;
    kind = std::max(kind, one);
    if (one > ChangeKind::looks) ++kinds;
  }
  // a change of two kinds at once forms the shell again
  return kinds > 1 ? ChangeKind::shape : kind;
}

std::shared_ptr<const preset::Preset> nearest_that_works(const preset::Preset& before,
                                                         preset::Preset refused) {
  using preset::FootprintKind;
  if (before.footprint.kind != FootprintKind::circle ||
      refused.footprint.kind != FootprintKind::circle)
    return nullptr;
  const auto half = [](const preset::Preset& of) { return 0.5 * (of.footprint.rods - 1); };
  const double leg = before.original_radius_mm() / before.footprint.spacing_mm - half(before),
               ratio = before.actuated_radius_mm() / before.original_radius_mm(),
               radius = refused.footprint.spacing_mm * (half(refused) + leg);
  refused.set_radii(radius, ratio * radius);
  refused.footprint.placement =
      refused.footprint.rods % 2 == 0 ? Placement::half : Placement::on_axis;
  if (!check_preset(refused) || !scene_of(refused)) return nullptr;
  return std::make_shared<const preset::Preset>(std::move(refused));
}

Result<void> check_preset(const preset::Preset& preset) {
  return preset::read_preset_text(preset::to_toml(preset), preset.name, preset.name)
      .map([](const auto&) {});
}

}  // namespace gridshell::window
