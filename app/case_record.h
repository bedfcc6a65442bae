// A finished run of a preset or of one of its cases, kept for the pictures that show several.
#pragma once

#include <string>

#include "engine/preset/preset.h"
#include "engine/record/snapshot.h"
#include "engine/record/states.h"

namespace gridshell::app {

struct CaseRecord {
  preset::Preset preset;
  record::Trajectory run;
  record::StateTables states = {};  ///< of a search for states
  std::string name = {};            ///< what pictures call it; empty: after its net
};

}  // namespace gridshell::app
