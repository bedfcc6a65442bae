// Meshes as Wavefront OBJ: vertices and faces.
#include "engine/preset/mesh_draft.h"
#include "engine/preset/obj_file.h"

namespace gridshell::preset {

Result<SurfaceData> read_obj(std::string_view bytes, const std::string& name) {
  MeshDraft draft;
  return read_obj_lines(
             bytes, name, "f",
             {[&](const auto& xyz, const auto& at) { return draft.add_vertex(xyz, at); },
              [&](const auto& corners, const auto& at) { return draft.add_polygon(corners, at); }})
      .and_then([&] { return draft.take(name); });
}

}  // namespace gridshell::preset
