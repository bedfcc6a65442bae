#include "engine/design/refused_net.h"

#include "engine/scene/surface_design.h"

namespace gridshell {

std::optional<NetSoFar> refused_net(const preset::Preset& preset) {
  if (preset.footprint.kind != preset::FootprintKind::net ||
      preset.net.kind != preset::NetKind::surface)
    return std::nullopt;
  NetSoFar so_far;
  if (surface_design(preset.net, preset.footprint.spacing_mm, &so_far)) return std::nullopt;
  if (so_far.lines.empty()) return std::nullopt;
  return so_far;
}

}  // namespace gridshell
