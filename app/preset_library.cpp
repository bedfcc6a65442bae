#include "app/preset_library.h"

#include <fmt/format.h>

#include <filesystem>

#include "engine/core/atomic_file.h"
#include "engine/preset/suggest.h"

namespace gridshell::app {

Result<preset::Presets> load_preset(const std::string& argument,
                                    const std::vector<preset::Override>& overrides) {
  std::error_code error;
  const std::filesystem::path path(argument);
  if (std::filesystem::is_regular_file(path, error))
    return preset::read_preset_file(path, overrides);
  std::vector<std::string> names;
  for (const auto& embedded : embedded_presets()) {
    if (embedded.name == argument)
      return preset::read_preset_text(embedded.text, "built-in " + argument, argument, overrides,
                                      embedded_files());
    names.push_back(embedded.name);
  }
  if (path.has_parent_path() || path.extension() == ".toml")
    return preset::read_preset_file(path, overrides);
  return fail(Fault::bad_input, fmt::format("no preset '{}': neither a file nor a listed name{} "
                                            "('gridshell list' lists them)",
                                            argument, preset::did_you_mean(argument, names)));
}

Result<preset::Presets> load_preset_or_run(const std::string& argument) {
  std::error_code error;
  std::filesystem::path folder(argument);
  if (!std::filesystem::is_directory(folder, error)) return load_preset(argument, {});
  if (!folder.has_filename()) folder = folder.parent_path();
  const auto file = folder / "preset.toml";
  auto text = read_whole(file, largest_text);
  if (!text)
    return fail(Fault::bad_input,
                fmt::format("'{}' is no run: {}", argument, text.error().message));
  return preset::read_preset_text(*text, file.string(), folder.filename().string());
}

}  // namespace gridshell::app
