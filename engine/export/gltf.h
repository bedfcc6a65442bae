// A run as one binary glTF 2.0 file (.glb), which Blender, browsers and slides play.
#pragma once

#include <string>

#include "engine/core/result.h"
#include "engine/export/shape.h"

namespace gridshell::exports {

/// Rods as tubes and cells in the colour of their last K, both as morph targets of up to 60 key
/// shapes, joints as spheres that move; an animation `run` of `seconds`. In metres, y up, as the
/// format wants it. Runs whose key shapes would take more than 20 MB have fewer sides and fewer of
/// them. Errors: bad_input for what takes more than that in one shape; what the frames say.
Result<std::string> to_glb(const record::Trajectory& run, const std::string& title, double seconds);

}  // namespace gridshell::exports
