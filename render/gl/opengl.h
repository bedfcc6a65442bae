// The OpenGL 3.3 core functions that the renderer calls, taken from the current context, and
// classes that own OpenGL objects. One table of functions serves OSMesa, EGL and GLFW; a linked
// libGL would not serve OSMesa.
#pragma once

#define GL_GLEXT_PROTOTYPES  // declares the functions for their types; nothing is linked
#include <GL/glcorearb.h>
#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/core/result.h"
#include "render/gl/mesh.h"

// The names of the functions without "gl".
// clang-format off
#define GRIDSHELL_GL_FUNCTIONS(X) \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindFramebuffer) X(BindTexture) \
  X(BindVertexArray) X(BlendFunc) X(BlendFuncSeparate) X(BufferData) X(CheckFramebufferStatus) \
  X(Clear) X(ClearColor) X(ColorMask) X(CompileShader) X(CreateProgram) X(CreateShader) \
  X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteShader) X(DeleteTextures) \
  X(DeleteVertexArrays) X(DepthFunc) X(DepthMask) X(Disable) X(DrawArrays) X(DrawBuffer) \
  X(DrawElements) X(Enable) X(EnableVertexAttribArray) X(Finish) X(FramebufferTexture2D) \
  X(GenBuffers) X(GenFramebuffers) X(GenTextures) X(GenVertexArrays) X(GetError) X(GetIntegerv) \
  X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv) X(GetUniformLocation) \
  X(LinkProgram) X(PixelStorei) X(PolygonOffset) X(ReadBuffer) X(ReadPixels) X(Scissor) \
  X(ShaderSource) X(TexImage2D) X(TexParameteri) X(Uniform1f) X(Uniform1i) X(Uniform2f) \
  X(Uniform3f) X(Uniform4f) X(UniformMatrix4fv) X(UseProgram) X(VertexAttribPointer) X(Viewport)
// clang-format on

namespace gridshell::render {

class Context;

/// gl.DrawArrays(...) is glDrawArrays(...).
struct Gl {
#define GRIDSHELL_GL_MEMBER(name) decltype(&gl##name) name = nullptr;  // NOLINT: a name
  GRIDSHELL_GL_FUNCTIONS(GRIDSHELL_GL_MEMBER)
#undef GRIDSHELL_GL_MEMBER

  /// Takes all functions from a context. Errors: Fault::io with the first one that it lacks.
  static Result<Gl> load(const Context& context);
};

/// Owns an OpenGL object: a name made by `Generate` and freed by `Delete` (members of Gl).
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

/// Declares where the bound vertex array finds the shader's input `index` in the bound buffer: in
/// every vertex of `stride` bytes, `size` numbers of `type` from byte `at`. `unit`: integers
/// represent [0, 1], signed ones [-1, 1].
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

/// A framebuffer with a colour texture and, if requested, a depth texture. Its storage is allocated
/// again only if another size or format is requested.
class Target {
 public:
  enum class Depth { none, plain, compared };  ///< compared: read by a sampler2DShadow

  /// The colour texture has `levels`, each half the size of the one before; drawing goes to the
  /// first. Several levels are read with linear interpolation, a single one texel by texel.
  Target(const Gl& gl, Depth depth, int levels = 1)
      : gl_(&gl), depth_kind_(depth), levels_(levels), frame_(gl), colour_(gl), depth_(gl) {}

  /// Binds it for drawing over width x height pixels of the internal format `format`.
  /// Errors: Fault::io when the context cannot make it.
  Result<void> bind(int width, int height, GLenum format);

  GLuint frame() const { return frame_.id(); }
  GLuint colour() const { return colour_.id(); }
  GLuint depth() const { return depth_.id(); }

 private:
  void allocate();

  const Gl* gl_;
  Depth depth_kind_;
  int levels_;
  Framebuffer frame_;
  Texture colour_, depth_;
  int width_ = 0, height_ = 0;
  GLenum format_ = 0;
};

/// A Mesh in the memory of the graphics processor.
class VertexStore {
 public:
  using Lists = std::initializer_list<std::reference_wrapper<const std::vector<std::uint32_t>>>;

  explicit VertexStore(const Gl& gl);

  /// Copies the mesh, and more lists of triangles over its vertices.
  void upload(const Mesh& mesh, Lists more = {});
  /// Draws a list of triangles: 0 is the mesh's own, then the others in order.
  void draw(std::size_t list = 0) const;
  /// Draws indices `begin` to `end` - 1 of the mesh's own list.
  void draw_range(std::size_t begin, std::size_t end) const;

 private:
  const Gl* gl_;
  VertexArray layout_;
  Buffer vertices_, indices_;
  std::vector<std::size_t> starts_;  ///< first index of each list, and the end of the last
};

/// The text of a file of shaders/ ("ribbon.vert"), embedded at build time; empty if there is no
/// such file.
std::string_view shader_text(std::string_view name);

/// A linked pair of shaders. Several files of a stage are joined in their order.
class Program {
 public:
  using Files = std::initializer_list<std::string_view>;

  /// Compiles and links files of shaders/. `defines`: lines of #define before all files. Errors:
  /// Fault::io with the files and the compiler's log.
  static Result<Program> create(const Gl& gl, Files vertex, Files fragment,
                                std::string_view defines = {});
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;

  void use() const;
  // sets a uniform of this program, which must be in use; a name that no shader reads is ignored
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Eigen::Vector2f& value) const;
  void set(const char* name, const Eigen::Vector3f& value) const;
  void set(const char* name, const Eigen::Vector4f& value) const;
  void set(const char* name, const Eigen::Matrix4f& value) const;

 private:
  Program(const Gl& gl, GLuint id) : gl_(&gl), id_(id) {}
  GLint location(const char* name) const;

  const Gl* gl_;
  GLuint id_;
};

}  // namespace gridshell::render
