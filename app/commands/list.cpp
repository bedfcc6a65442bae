// `gridshell list`: the presets that come with the program, and the reference of all keys.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/console.h"
#include "app/preset_library.h"
#include "engine/preset/writer.h"

namespace gridshell::app {
namespace {

int list_presets() {
  std::size_t longest = 0;
  for (const auto& embedded : embedded_presets()) longest = std::max(longest, embedded.name.size());
  for (const auto& embedded : embedded_presets()) {
    const auto presets = load_preset(embedded.name, {});
    if (!presets) return report(presets.error());
    const auto& source = presets->base.source;
    fmt::print("{:<{}}  {}{}\n", embedded.name, longest, presets->base.title,
               source.empty() ? "" : " (" + source + ")");
  }
  return ExitCode::done;
}

}  // namespace

void add_list(CLI::App& program, Action& action) {
  const auto keys = std::make_shared<std::string>();
  auto* command = program.add_subcommand("list", "the presets that come with the program");
  command->add_option("--keys", *keys, "instead, the reference of all keys a preset can hold")
      ->check(CLI::IsMember({"markdown"}));
  command->callback([&action, keys] {
    action = [keys]() -> int {
      if (keys->empty()) return list_presets();
      fmt::print("{}", preset::reference_markdown());
      return ExitCode::done;
    };
  });
}

}  // namespace gridshell::app
