// A state of a shell seen from above [Baek 2018, Fig. 2C]: which of its rods are of the first order
// and which planes it is symmetric in.
#pragma once

#include "engine/record/snapshot.h"
#include "engine/record/states.h"
#include "render/plot/canvas.h"

namespace gridshell::render {

/// Rods without and with inflections.
inline constexpr Colour first_order_ink{0.10f, 0.10f, 0.12f, 1},
    higher_order_ink{0.85f, 0.45f, 0.10f, 1};
inline constexpr Colour mirror_ink{0.16f, 0.42f, 0.78f, 1};  ///< of planes and axes of symmetry

/// The numbers of StateRow::inflections, rod by rod; empty where it is none of those.
std::vector<int> inflections_of(const record::StateRow& row);

/// Units of the canvas a millimetre at which the shell fills the box.
double state_map_scale(const Box& box, const record::Layout& layout);

/// The rods of a frame at rest, its boundary and, dashed, the mirrors of its group (a square in the
/// middle where it is turns by 90 degrees alone), in the middle of the box.
void draw_state_map(Canvas& canvas, const Box& box, double units_per_mm,
                    const record::Layout& layout, const record::Frame& frame,
                    const record::StateRow& row);

}  // namespace gridshell::render
