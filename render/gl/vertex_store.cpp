#include "render/gl/vertex_store.h"

#include <cstddef>

namespace gridshell::render {

VertexStore::VertexStore(const Gl& gl) : gl_(&gl), layout_(gl), vertices_(gl), indices_(gl) {
  gl.BindVertexArray(layout_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  const auto attribute = [&gl](GLuint index, GLint size, GLenum type, bool unit, std::size_t at) {
    describe_attribute(gl, index, size, type, unit, sizeof(Vertex), at);
  };
  attribute(0, 3, GL_FLOAT, false, offsetof(Vertex, position));
  attribute(1, 4, GL_SHORT, true, offsetof(Vertex, normal));
  attribute(2, 4, GL_UNSIGNED_SHORT, true, offsetof(Vertex, colour));
}

void VertexStore::upload(const Mesh& mesh, Lists more) {
  const auto bytes = [](const auto& list) { return GLsizeiptr(list.size() * sizeof(list[0])); };
  std::vector<std::uint32_t> indices = mesh.indices;
  starts_ = {0, indices.size()};
  for (const auto& list : more) {
    indices.insert(indices.end(), list.get().begin(), list.get().end());
    starts_.push_back(indices.size());
  }
  gl_->BindVertexArray(layout_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, bytes(mesh.vertices), mesh.vertices.data(), GL_STREAM_DRAW);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(indices), indices.data(), GL_STREAM_DRAW);
}

void VertexStore::draw(std::size_t list) const {
  if (list + 1 < starts_.size()) draw_range(starts_[list], starts_[list + 1]);
}

void VertexStore::draw_range(std::size_t begin, std::size_t end) const {
  if (begin >= end) return;
  gl_->BindVertexArray(layout_.id());
  gl_->DrawElements(GL_TRIANGLES, GLsizei(end - begin), GL_UNSIGNED_INT,
                    reinterpret_cast<const void*>(begin * sizeof(std::uint32_t)));
}

}  // namespace gridshell::render
