#include "app/cli/preset_library.h"

#include <fmt/format.h>
#include <filesystem>
#include <tuple>

#include "app/cli/console.h"
#include "engine/core/file_io.h"
#include "engine/core/system_info.h"
#include "engine/core/text.h"
#include "engine/core/try.h"

namespace gridshell::app {
namespace {

constexpr std::string_view version_line = "# computed by gridshell ";

}  // namespace

Result<preset::Presets> load_preset(const std::string& argument,
                                    const std::vector<preset::Override>& overrides) {
  std::error_code error;
  const std::filesystem::path path(argument);
  if (std::filesystem::is_regular_file(path, error))
    return preset::read_preset_file(path, overrides);
  // a preset from an open pipe has no folder: files that it names are searched in the current one
  const bool opened = argument.starts_with("/dev/") || argument.starts_with("/proc/");
  if (argument == "-" || (opened && std::filesystem::is_fifo(path, error))) {
    TRY(text, read_pipe(argument == "-" ? "/dev/stdin" : argument, largest_text));
    return preset::read_preset_text(*text, "pipe", "pipe", overrides);
  }
  std::vector<std::string> names;
  for (const auto& embedded : embedded_presets()) {
    if (embedded.name == argument)
      return preset::read_preset_text(embedded.text, "built-in " + argument, argument, overrides,
                                      embedded_files());
    names.push_back(embedded.name);
  }
  if (std::filesystem::exists(path / "summary.json", error))
    return invalid(
        "'{0}' is the folder of a run, expected a preset: 'gridshell render {0}' draws it again, "
        "'gridshell movie {0} --turntable' its last state from all sides",
        argument);
  if (path.has_parent_path() || path.extension() == ".toml")
    return preset::read_preset_file(path, overrides);
  return invalid("no preset '{}': neither a file nor a listed name{} ('gridshell list' lists them)",
                 argument, did_you_mean(argument, names));
}

Result<std::string> title_of(const EmbeddedPreset& embedded) {
  TRY(presets, load_preset(embedded.name, {}));
  const auto& [title, source] = std::tie(presets->base.title, presets->base.source);
  return title + (source.empty() ? "" : " (" + source + ")");
}

Result<preset::Presets> load_preset_or_run(const std::string& argument) {
  std::error_code error;
  std::filesystem::path folder(argument);
  if (!std::filesystem::is_directory(folder, error)) return load_preset(argument, {});
  if (!folder.has_filename()) folder = folder.parent_path();
  const auto file = folder / "preset.toml";
  auto text = read_file(file, largest_text);
  if (!text) return invalid("'{}' is no run: {}", argument, text.error().message);
  return preset::read_preset_text(*text, file.string(), folder.filename().string());
}

Result<preset::Presets> load(const Options& options) {
  TRY(overrides, overrides_of(options));
  TRY(presets, load_preset(options.input, *overrides));
  if (presets->base.accuracy.leading_edges > 0)
    fmt::print(stderr,
               "{}: [accuracy] leading_edges does nothing any more: the finest mesh is followed\n",
               options.input);
  return std::move(*presets);
}

std::string saved_preset(const std::string& toml) {
  return std::string(version_line).append(version()).append("\n").append(toml);
}

std::string without_version(const std::string& saved) {
  return saved.starts_with(version_line) ? saved.substr(saved.find('\n') + 1) : saved;
}

Result<int> print_config(const preset::Presets& presets) {
  fmt::print("{}", preset::to_toml(presets));
  return printed();
}

std::vector<preset::Case> runs_of(const preset::Presets& presets) {
  if (!presets.cases.empty()) return presets.cases;
  return {{"", presets.base}};
}

Result<simulate::Plan> plan_of(const preset::Preset& preset) {
  return with_name_of(preset, simulate::plan(preset));
}

}  // namespace gridshell::app
