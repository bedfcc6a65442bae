#include "app/window/workspace.h"

#include <cmath>
#include <cstdlib>
#include <type_traits>

#include "engine/core/json.h"

namespace gridshell::window {
namespace {

namespace fs = std::filesystem;

constexpr double most_number = 1e9;  // largest number that is read from a workspace

/// Calls visit(key, value) for each flag of the workspace.
template <class AnyViewer, class Visit>
void each_switch(AnyViewer& viewer, const Visit& visit) {
  visit("joints", viewer.show.joints);
  visit("boundaries", viewer.show.rings);
  visit("ground", viewer.show.ground);
  visit("net", viewer.show.net);
  visit("footprint", viewer.show.footprint);
  visit("dark", viewer.show.dark);
  visit("loads", viewer.show.loads);
  visit("braces", viewer.show.braces);
  visit("numbers", viewer.numbers);
  visit("plots", viewer.plots);
  visit("design", viewer.design_panel);
}

/// Calls visit(key, value) for each number of the camera.
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

/// Reads a member of an object; returns false, and leaves `value`, if it is missing or no Value.
template <class Value>
bool take(const Json& object, const char* key, Value& value) {
  if (!object.is_object() || !object.contains(key)) return false;
  const Json& member = object[key];
  if constexpr (std::is_enum_v<Value>) {
    const auto found = find_word<Value>(member.is_string() ? member.get<std::string>() : "");
    if (found) value = *found;
    return found.has_value();
  } else if constexpr (std::is_same_v<Value, double>) {
    if (!member.is_number() || std::abs(member.get<double>()) > most_number) return false;
  } else if constexpr (std::is_same_v<Value, bool>) {
    if (!member.is_boolean()) return false;
  } else if constexpr (std::is_same_v<Value, std::string>) {
    if (!member.is_string()) return false;
  }
  value = member.get<Value>();
  return true;
}

}  // namespace

std::string workspace_text(const ViewerState& viewer) {
  Json json = Json::object();
  json["preset"] = viewer.shell->preset.name;
  Json camera = Json::object();
  each_number(viewer.camera, [&](const char* key, double value) { camera[key] = value; });
  json["camera"] = camera;
  Json colour = Json::object();
  colour["by"] = word_of(viewer.show.colour_by);
  colour["range"] = word_of(viewer.range_of);
  colour["low"] = viewer.show.scale.low;
  colour["high"] = viewer.show.scale.high;
  json["colour"] = colour;
  Json shown = Json::object();
  each_switch(viewer, [&](const char* key, bool on) { shown[key] = on; });
  json["shown"] = shown;
  json["recent"] = viewer.recent;
  json["saved_in"] = viewer.last_folders[0];
  json["opened_from"] = viewer.last_folders[1];
  return text_of(json);
}

Result<void> take_workspace(ViewerState& viewer, const std::string& text) {
  const Json json = parsed(text);
  if (!json.is_object()) return invalid("the workspace is no JSON object");
  Json shown, colour, camera;
  if (take(json, "shown", shown))
    each_switch(viewer, [&](const char* key, bool& on) { take(shown, key, on); });
  double low = 0, high = 0;
  if (take(json, "colour", colour)) {
    take(colour, "by", viewer.show.colour_by);
    take(colour, "range", viewer.range_of);
    if (viewer.range_of == RangeOf::hand && take(colour, "low", low) && take(colour, "high", high))
      viewer.set_range(low, high);
  }
  if (json.contains("recent") && json["recent"].is_array())
    for (const Json& one : json["recent"])
      if (one.is_string() && viewer.recent.size() < ViewerState::most_recent)
        viewer.recent.push_back(one.get<std::string>());
  take(json, "saved_in", viewer.last_folders[0]);
  take(json, "opened_from", viewer.last_folders[1]);
  SavedCamera kept{"", viewer.camera, viewer.show.colour_by};
  if (!take(json, "camera", camera) || !take(json, "preset", kept.preset)) return {};
  bool whole = true;
  each_number(kept.camera,
              [&](const char* key, double& value) { whole = take(camera, key, value) && whole; });
  const render::Camera& seen = kept.camera;
  if (whole && seen.half_extent_mm > 0 && std::abs(seen.elevation_deg) <= 90 &&
      seen.field_of_view_deg >= 0 && seen.field_of_view_deg < 120)
    viewer.saved_camera = kept;
  return {};
}

std::filesystem::path workspace_file() {
  const auto of = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value ? value : "");
  };
  fs::path state = of("XDG_STATE_HOME");
  if (!state.is_absolute() && of("HOME").is_absolute()) state = of("HOME") / ".local/state";
  return state.is_absolute() ? state / "gridshell/workspace.json" : fs::path();
}

}  // namespace gridshell::window
