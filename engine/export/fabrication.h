// Files for the workshop: the footprint and the plate as drawings, the cut list and the pins as
// tables.
#pragma once

#include "engine/core/result.h"
#include "engine/export/drawing.h"
#include "engine/export/workpiece.h"

namespace gridshell::exports {

/// The flat footprint; u-rods begin at the left, v-rods below. Layers: `rods`, `joints` (a cross
/// each), `boundary`, `labels`, and where there is a second ring `tails` (a tick across a rod at
/// its edge point).
Drawing footprint_drawing(const Workpiece& work);

/// The plate that holds the shell: the actuated boundary and a hole of the rods' diameter for each
/// pin of the ring. Layers: `boundary`, `holes`, `labels`. Errors (bad_input): the pins do not lie
/// in one horizontal plane.
Result<Drawing> plate_drawing(const Workpiece& work);

/// `rod,length_mm,joint_marks_mm,pin_marks_mm,leg_begin_mm,leg_end_mm,note`, a line a rod; marks
/// are measured from the rod's begin, apart by blanks.
std::string cut_list_csv(const Workpiece& work);

/// `pin,ring,x_mm,y_mm,z_mm`, those of the second ring too.
std::string pins_csv(const Workpiece& work);

}  // namespace gridshell::exports
