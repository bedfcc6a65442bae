// `gridshell list`: the presets that come with the program, and the reference of
// all keys, options and commands.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>

#include "app/commands/commands.h"
#include "app/completion.h"
#include "app/console.h"
#include "app/listing.h"
#include "app/man_page.h"
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

int print(const Result<std::string>& text) {
  if (!text) return report(text.error());
  fmt::print("{}", *text);
  return ExitCode::done;
}

}  // namespace

void add_list(CLI::App& program, Action& action) {
  struct What {
    std::string keys, completion;
    bool json = false, man = false;
  };
  const auto what = std::make_shared<What>();
  auto* command = program.add_subcommand("list", "the presets that come with the program");
  command->add_option("--keys", what->keys, "instead, the reference of all keys a preset can hold")
      ->check(CLI::IsMember({"markdown"}));
  command->add_flag("--json", what->json,
                    "instead, all commands, options, presets and keys for other programs");
  command->add_option("--completion", what->completion, "instead, a script for a shell")
      ->check(CLI::IsMember({"bash"}));
  command->add_flag("--man", what->man, "instead, the manual page");
  command->callback([&action, what] {
    action = [what]() -> int {
      if (!what->keys.empty()) return print(preset::reference_markdown());
      if (!what->completion.empty()) return print(bash_completion());
      if (what->json) return print(listing_json());
      if (what->man) return print(man_page());
      return list_presets();
    };
  });
}

}  // namespace gridshell::app
