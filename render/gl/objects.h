// OpenGL objects that delete themselves: textures, framebuffers, vertex arrays, buffers.
#pragma once

#include <cstddef>
#include <utility>

#include "render/gl/functions.h"

namespace gridshell::render {

/// Owns one name made by `Generate` and freed by `Delete` (members of Gl).
template <auto Generate, auto Delete>
class Object {
 public:
  explicit Object(const Gl& gl) : gl_(&gl) { (gl.*Generate)(1, &id_); }
  ~Object() {
    if (id_) (gl_->*Delete)(1, &id_);
  }
  Object(Object&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}
  Object& operator=(Object&& other) noexcept {
    std::swap(gl_, other.gl_);
    std::swap(id_, other.id_);
    return *this;
  }

  GLuint id() const { return id_; }

 private:
  const Gl* gl_;
  GLuint id_ = 0;
};

/// Where the shader's input `index` stands in the vertices of the buffer that is bound, `stride`
/// bytes each: `size` numbers of `type` from byte `at` on; `unit`: integers stand for 0 to 1.
inline void describe_attribute(const Gl& gl, GLuint index, GLint size, GLenum type, bool unit,
                               std::size_t stride, std::size_t at) {
  gl.VertexAttribPointer(index, size, type, unit, GLsizei(stride),
                         reinterpret_cast<const void*>(at));
  gl.EnableVertexAttribArray(index);
}

using Texture = Object<&Gl::GenTextures, &Gl::DeleteTextures>;
using Framebuffer = Object<&Gl::GenFramebuffers, &Gl::DeleteFramebuffers>;
using VertexArray = Object<&Gl::GenVertexArrays, &Gl::DeleteVertexArrays>;
using Buffer = Object<&Gl::GenBuffers, &Gl::DeleteBuffers>;

}  // namespace gridshell::render
