// A network, formed on one mesh and told in three frames.
#pragma once

#include "engine/preset/preset.h"

namespace gridshell {

inline preset::Preset network(const preset::NetworkData& file, int edges) {
  preset::Preset p;
  p.footprint.kind = preset::FootprintKind::network;
  p.footprint.file = file;
  p.accuracy.edges_per_segment = edges;
  p.movie.frames = 3;
  return p;
}

}  // namespace gridshell
