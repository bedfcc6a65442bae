#include "render/gl/vertex_store.h"

#include <cstddef>

namespace gridshell::render {

VertexStore::VertexStore(const Gl& gl) : gl_(&gl), layout_(gl), vertices_(gl), indices_(gl) {
  gl.BindVertexArray(layout_.id());
  gl.BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl.BindBuffer(GL_ELEMENT_ARRAY_BUFFER, indices_.id());
  const auto attribute = [&gl](GLuint index, GLint size, GLenum type, bool unit, std::size_t at) {
    gl.VertexAttribPointer(index, size, type, unit, sizeof(Vertex),
                           reinterpret_cast<const void*>(at));
    gl.EnableVertexAttribArray(index);
  };
  attribute(0, 3, GL_FLOAT, false, offsetof(Vertex, position));
  attribute(1, 3, GL_SHORT, true, offsetof(Vertex, normal));
  attribute(2, 4, GL_UNSIGNED_SHORT, true, offsetof(Vertex, colour));
}

void VertexStore::upload(const Mesh& mesh) {
  const auto bytes = [](const auto& list) { return GLsizeiptr(list.size() * sizeof(list[0])); };
  gl_->BindVertexArray(layout_.id());
  gl_->BindBuffer(GL_ARRAY_BUFFER, vertices_.id());
  gl_->BufferData(GL_ARRAY_BUFFER, bytes(mesh.vertices), mesh.vertices.data(), GL_STREAM_DRAW);
  gl_->BufferData(GL_ELEMENT_ARRAY_BUFFER, bytes(mesh.indices), mesh.indices.data(),
                  GL_STREAM_DRAW);
  count_ = GLsizei(mesh.indices.size());
}

void VertexStore::draw() const {
  if (empty()) return;
  gl_->BindVertexArray(layout_.id());
  gl_->DrawElements(GL_TRIANGLES, count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace gridshell::render
