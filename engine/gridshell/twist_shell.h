// A footprint's rods on the `twist` rung.
#pragma once

#include "engine/footprint/mesh.h"
#include "engine/gridshell/twist_model.h"

namespace gridshell {

/// Rods of `mesh`, all of one material, all ends held alike; crossing rods share their joint's
/// node. First directors stand up from the flat (+z). Node numbers are the mesh's, ghosts after
/// them.
Result<TwistModel> twist_model_of(const RodMesh& mesh, const RodMaterial& material, EndHold ends);

}  // namespace gridshell
