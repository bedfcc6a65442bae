#include "engine/gridshell/twist_shell.h"

namespace gridshell {

Result<TwistModel> twist_model_of(const RodMesh& mesh, const RodMaterial& material, EndHold ends) {
  std::vector<TwistRod> rods;
  for (std::size_t r = 0; r < mesh.rods.size(); ++r)
    rods.push_back({mesh.rods[r], mesh.position[r], material, ends, ends, {0, 0, 1}});
  return build_twist_model(mesh.nodes(), rods);
}

}  // namespace gridshell
