#include "engine/solve/meshed_shell.h"

namespace gridshell {

Result<void> MeshedShell::build(const Footprint& footprint, const ShellRods& rods, Mechanics rung,
                                const BoundaryMotion& boundary, int edges_per_segment) {
  mesh = mesh_rods(footprint, edges_per_segment);
  auto built = build_model(mesh, rods, rung);
  if (!built) return tl::unexpected<Error>(built.error());
  model = std::move(*built);
  motion = pinned_motion(mesh, boundary);
  system = std::make_unique<Linearisation>(model);
  return {};
}

}  // namespace gridshell
