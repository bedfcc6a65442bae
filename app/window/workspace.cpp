#include "app/window/workspace.h"

#include <cmath>
#include <cstdlib>

#include "engine/record/json.h"

namespace gridshell::window {
namespace {

using record::Json;

/// Calls visit(key, value) for what is on or off.
template <class AnyDesk, class Visit>
void each_switch(AnyDesk& desk, const Visit& visit) {
  visit("joints", desk.show.joints);
  visit("boundaries", desk.show.rings);
  visit("ground", desk.show.ground);
  visit("net", desk.show.net);
  visit("footprint", desk.show.footprint);
  visit("dark", desk.show.dark);
  visit("numbers", desk.numbers);
  visit("plots", desk.plots);
  visit("design", desk.design_panel);
}

/// The same for the camera's numbers.
template <class AnyCamera, class Visit>
void each_number(AnyCamera& camera, const Visit& visit) {
  visit("azimuth_deg", camera.azimuth_deg);
  visit("elevation_deg", camera.elevation_deg);
  visit("half_extent_mm", camera.half_extent_mm);
  visit("field_of_view_deg", camera.field_of_view_deg);
  visit("target_x_mm", camera.target.x());
  visit("target_y_mm", camera.target.y());
  visit("target_z_mm", camera.target.z());
}

/// The member of an object, or null.
const Json* member(const Json& object, const char* key) {
  if (!object.is_object()) return nullptr;
  const auto found = object.find(key);
  return found == object.end() ? nullptr : &*found;
}

bool take(const Json& object, const char* key, double& value, double low, double high) {
  const Json* number = member(object, key);
  if (!number || !number->is_number()) return false;
  const double asked = number->get<double>();
  if (!(asked >= low && asked <= high)) return false;
  value = asked;
  return true;
}

template <class Enum>
void take_word(const Json& object, const char* key, Enum& value) {
  const Json* word = member(object, key);
  if (!word || !word->is_string()) return;
  if (const auto found = find_word<Enum>(word->get<std::string>())) value = *found;
}

}  // namespace

std::string workspace_text(const Desk& desk) {
  Json json = Json::object();
  json["preset"] = desk.sight->preset.name;
  Json camera = Json::object();
  each_number(desk.camera, [&](const char* key, double value) { camera[key] = value; });
  json["camera"] = camera;
  Json colour = Json::object();
  colour["by"] = word_of(desk.show.colour_by);
  colour["range"] = word_of(desk.range_of);
  colour["low"] = desk.show.scale.low;
  colour["high"] = desk.show.scale.high;
  json["colour"] = colour;
  Json shown = Json::object();
  each_switch(desk, [&](const char* key, bool on) { shown[key] = on; });
  json["shown"] = shown;
  return record::text_of(json);
}

Result<void> take_workspace(Desk& desk, const std::string& text) {
  const Json json = record::parsed(text);
  if (!json.is_object()) return fail(Fault::bad_input, "the workspace is no JSON object");
  if (const Json* shown = member(json, "shown"))
    each_switch(desk, [&](const char* key, bool& on) {
      if (const Json* flag = member(*shown, key); flag && flag->is_boolean())
        on = flag->get<bool>();
    });
  if (const Json* colour = member(json, "colour")) {
    take_word(*colour, "by", desk.show.colour_by);
    take_word(*colour, "range", desk.range_of);
    double low = 0, high = 0;
    if (desk.range_of == RangeOf::hand && take(*colour, "low", low, -1e9, 1e9) &&
        take(*colour, "high", high, -1e9, 1e9))
      desk.set_range(low, high);
  }
  const Json *camera = member(json, "camera"), *preset = member(json, "preset");
  if (!camera || !preset || !preset->is_string()) return {};
  KeptView kept{preset->get<std::string>(), desk.camera, desk.show.colour_by};
  bool whole = true;
  each_number(kept.camera, [&](const char* key, double& value) {
    whole = take(*camera, key, value, -1e6, 1e6) && whole;
  });
  const render::Camera& seen = kept.camera;
  if (whole && seen.half_extent_mm > 0 && std::abs(seen.elevation_deg) <= 90 &&
      seen.field_of_view_deg >= 0 && seen.field_of_view_deg < 120)
    desk.kept_view = kept;
  return {};
}

std::filesystem::path workspace_file() {
  const auto of = [](const char* name) {
    const char* value = std::getenv(name);
    return std::filesystem::path(value ? value : "");
  };
  std::filesystem::path state = of("XDG_STATE_HOME");
  if (!state.is_absolute() && of("HOME").is_absolute()) state = of("HOME") / ".local/state";
  return state.is_absolute() ? state / "gridshell/workspace.json" : std::filesystem::path();
}

}  // namespace gridshell::window
