// The library in one header: presets, scenes, sessions, experiments, designs, run folders. Programs
// of 30 lines stand in app/examples/.
#pragma once

#include "engine/core/result.h"             // IWYU pragma: export
#include "engine/core/version.h"            // IWYU pragma: export
#include "engine/core/watch.h"              // IWYU pragma: export
#include "engine/design/design.h"           // IWYU pragma: export
#include "engine/experiment/experiment.h"   // IWYU pragma: export
#include "engine/measure/deviation.h"       // IWYU pragma: export
#include "engine/preset/reader.h"           // IWYU pragma: export
#include "engine/preset/writer.h"           // IWYU pragma: export
#include "engine/record/folder_sink.h"      // IWYU pragma: export
#include "engine/record/run_folder.h"       // IWYU pragma: export
#include "engine/record/trajectory_file.h"  // IWYU pragma: export
#include "engine/scan/scan.h"               // IWYU pragma: export
#include "engine/scene/scene.h"             // IWYU pragma: export
#include "engine/session/session.h"         // IWYU pragma: export
