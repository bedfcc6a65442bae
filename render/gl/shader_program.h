// The GLSL files of shaders/, embedded at build time.
#pragma once

#include <Eigen/Core>
#include <initializer_list>
#include <string_view>

#include "engine/core/result.h"
#include "render/gl/opengl.h"

namespace gridshell::render {

/// The text of a file of shaders/ ("solid.vert"); empty when there is no such file.
std::string_view shader_text(std::string_view name);

// A linked pair of shaders.

/// Made of files of shaders/; several files of a stage are joined in their order.
class Program {
 public:
  using Files = std::initializer_list<std::string_view>;

  /// `defines`: lines of #define that go before all files. Errors: Fault::io with the files and the
  /// compiler's log.
  static Result<Program> create(const Gl& gl, Files vertex, Files fragment,
                                std::string_view defines = {});
  ~Program();
  Program(Program&& other) noexcept;
  Program& operator=(Program&& other) noexcept;

  void use() const;
  // to the program in use; a name that no shader reads is ignored
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
