// The library in one header: presets, scenes, sessions, experiments, designs, studies, run folders.
// Programs of 30 lines are in app/examples/; the program itself sees no other of the engine's
// headers but those of core/. The model of rods itself is engine/elastic/model.h.
#pragma once

#include "engine/core/result.h"                // IWYU pragma: export
#include "engine/core/system_info.h"           // IWYU pragma: export
#include "engine/core/watch.h"                 // IWYU pragma: export
#include "engine/design/design.h"              // IWYU pragma: export
#include "engine/footprint/symmetry.h"         // IWYU pragma: export
#include "engine/formats/csv.h"                // IWYU pragma: export
#include "engine/formats/point_file.h"         // IWYU pragma: export
#include "engine/preset/consistency.h"         // IWYU pragma: export
#include "engine/preset/field_table.h"         // IWYU pragma: export
#include "engine/preset/materials.h"           // IWYU pragma: export
#include "engine/preset/preset.h"              // IWYU pragma: export
#include "engine/preset/preset_file.h"         // IWYU pragma: export
#include "engine/preset/sweep_grid.h"          // IWYU pragma: export
#include "engine/record/fabrication.h"         // IWYU pragma: export
#include "engine/record/frame.h"               // IWYU pragma: export
#include "engine/record/frame_values.h"        // IWYU pragma: export
#include "engine/record/journal.h"             // IWYU pragma: export
#include "engine/record/phase_diagram.h"       // IWYU pragma: export
#include "engine/record/run_folder.h"          // IWYU pragma: export
#include "engine/record/shape_export.h"        // IWYU pragma: export
#include "engine/record/shape_measures.h"      // IWYU pragma: export
#include "engine/record/states.h"              // IWYU pragma: export
#include "engine/record/summary.h"             // IWYU pragma: export
#include "engine/record/sweep_results.h"       // IWYU pragma: export
#include "engine/record/trajectory.h"          // IWYU pragma: export
#include "engine/record/trajectory_file.h"     // IWYU pragma: export
#include "engine/scene/net_design.h"           // IWYU pragma: export
#include "engine/scene/scene.h"                // IWYU pragma: export
#include "engine/simulate/actuation.h"         // IWYU pragma: export
#include "engine/simulate/equilibrium_path.h"  // IWYU pragma: export
#include "engine/simulate/expected_cost.h"     // IWYU pragma: export
#include "engine/simulate/frames.h"            // IWYU pragma: export
#include "engine/simulate/indentation.h"       // IWYU pragma: export
#include "engine/simulate/mesh_policy.h"       // IWYU pragma: export
#include "engine/simulate/run.h"               // IWYU pragma: export
#include "engine/simulate/saved_segments.h"    // IWYU pragma: export
#include "engine/simulate/simulation.h"        // IWYU pragma: export
#include "engine/simulate/steps.h"             // IWYU pragma: export
#include "engine/solve/buckling.h"             // IWYU pragma: export
#include "engine/solve/equilibrium.h"          // IWYU pragma: export
#include "engine/study/bifurcation_diagram.h"  // IWYU pragma: export
#include "engine/study/formed_shell.h"         // IWYU pragma: export
#include "engine/study/method_studies.h"       // IWYU pragma: export
#include "engine/study/scan.h"                 // IWYU pragma: export
#include "engine/study/state_library.h"        // IWYU pragma: export
#include "engine/study/sweep_study.h"          // IWYU pragma: export
