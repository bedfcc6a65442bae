// The program `gridshell`: see README.md for its commands.
#include <cstdio>

#include "app/preset_library.h"

int main() {
  for (const auto& preset : gridshell::app::embedded_presets()) std::puts(preset.name.c_str());
}
