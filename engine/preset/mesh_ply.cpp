// Meshes of triangles in PLY files.
#include "engine/preset/mesh_draft.h"
#include "engine/preset/ply.h"

namespace gridshell::preset {

Result<SurfaceData> read_ply(std::string_view bytes, const std::string& name) {
  MeshDraft draft;
  const auto read = each_ply_item(bytes, name, [&](const PlyItem& item) -> Result<void> {
    if (item.element == "vertex")
      return draft.add_vertex({item.xyz.x(), item.xyz.y(), item.xyz.z()}, item.place(name));
    if (item.element == "face") return draft.add_polygon(item.corners, item.place(name));
    return {};
  });
  if (!read) return tl::unexpected(read.error());
  return draft.take(name);
}

}  // namespace gridshell::preset
