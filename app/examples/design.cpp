// Inverse design: moves the pins of a cap until its joints are on the sphere.
#include <cstdio>

#include "engine/gridshell.h"

int main() {
  using namespace gridshell;
  preset::Preset preset;
  preset.footprint.kind = preset::FootprintKind::net;
  preset.net.radius_mm = 60;
  preset.net.cut_height = 0.5;
  preset.actuation.start = preset::Start::net;
  preset.inverse.vary = {preset::Vary::pins_radial};
  Watch watch;
  const auto found = design(preset, watch, [](const DesignStep& step) {
    std::printf("step %d: %.4f mm at most\n", step.iteration, step.max_mm);
  });
  if (!found) {
    std::fprintf(stderr, "%s\n", found.error().message.c_str());
    return 1;
  }
  std::printf("from %.3f to %.3f mm, %zu ends in its table\n", found->before.back().max_mm,
              found->after.back().max_mm, found->table.size());
}
