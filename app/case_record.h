// A finished run of a preset or of one of its cases, kept for the pictures that show several.
#pragma once

#include "engine/preset/preset.h"
#include "engine/record/snapshot.h"

namespace gridshell::app {

struct CaseRecord {
  preset::Preset preset;
  record::Trajectory run;
};

}  // namespace gridshell::app
