// A Mesh on the graphics side.
#pragma once

#include <cstdint>
#include <functional>
#include <initializer_list>
#include <vector>

#include "render/draw/mesh.h"
#include "render/gl/objects.h"

namespace gridshell::render {

class VertexStore {
 public:
  using Lists = std::initializer_list<std::reference_wrapper<const std::vector<std::uint32_t>>>;

  explicit VertexStore(const Gl& gl);

  /// The mesh, and more lists of triangles over its vertices.
  void upload(const Mesh& mesh, Lists more = {});
  /// List 0 is the mesh's own, then the others in order.
  void draw(std::size_t list = 0) const;
  /// Indices `begin` to `end` - 1 of the mesh's own list.
  void draw_range(std::size_t begin, std::size_t end) const;

 private:
  const Gl* gl_;
  VertexArray layout_;
  Buffer vertices_, indices_;
  std::vector<std::size_t> starts_;  ///< of each list among the indices, and their end
};

}  // namespace gridshell::render
