#include "app/loading.h"

#include "app/preset_library.h"

namespace gridshell::app {

Result<preset::Presets> load(const Options& options) {
  return overrides_of(options).and_then(
      [&](const auto& overrides) { return load_preset(options.input, overrides); });
}

std::vector<preset::Case> runs_of(const preset::Presets& presets) {
  if (!presets.cases.empty()) return presets.cases;
  return {{"", presets.base}};
}

Result<experiment::Plan> plan_of(const preset::Preset& preset) {
  return experiment::plan(preset).map_error([&](Error error) {
    error.message = preset.name + ": " + error.message;
    return error;
  });
}

}  // namespace gridshell::app
