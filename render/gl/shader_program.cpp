#include "render/gl/shader_program.h"

#include <string>
#include <utility>

#include "engine/core/try.h"

namespace gridshell::render {
namespace {

constexpr int log_size = 2048;

/// Compiles `files` into one shader of `stage` and attaches it to `program`.
Result<void> attach(const Gl& gl, GLuint program, GLenum stage, Program::Files files,
                    std::string_view defines) {
  std::string text = "#version 330 core\n", names;
  text.append(defines);
  for (std::string_view file : files) {
    const std::string_view part = shader_text(file);
    names += (names.empty() ? "" : " + ") + std::string(file);
    if (part.empty()) return fail(Fault::io, "no shader of the name " + std::string(file));
    text.append(part);
  }
  const GLuint shader = gl.CreateShader(stage);
  const char* pointer = text.c_str();
  gl.ShaderSource(shader, 1, &pointer, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good) {
    gl.AttachShader(program, shader);
    gl.DeleteShader(shader);  // lives on as long as the program
    return {};
  }
  std::string log(log_size, '\0');
  gl.GetShaderInfoLog(shader, log_size, nullptr, log.data());
  gl.DeleteShader(shader);
  return fail(Fault::io, "shader " + names + " does not compile: " + log.c_str());
}

}  // namespace

Result<Program> Program::create(const Gl& gl, Files vertex, Files fragment,
                                std::string_view defines) {
  Program program(gl, gl.CreateProgram());
  TRY_DO(attach(gl, program.id_, GL_VERTEX_SHADER, vertex, defines));
  TRY_DO(attach(gl, program.id_, GL_FRAGMENT_SHADER, fragment, defines));
  gl.LinkProgram(program.id_);
  GLint good = 0;
  gl.GetProgramiv(program.id_, GL_LINK_STATUS, &good);
  if (good) return program;
  std::string log(log_size, '\0');
  gl.GetProgramInfoLog(program.id_, log_size, nullptr, log.data());
  return fail(Fault::io, std::string("shaders do not link: ") + log.c_str());
}

Program::~Program() {
  if (id_) gl_->DeleteProgram(id_);
}

Program::Program(Program&& other) noexcept : gl_(other.gl_), id_(std::exchange(other.id_, 0)) {}

Program& Program::operator=(Program&& other) noexcept {
  std::swap(gl_, other.gl_);
  std::swap(id_, other.id_);
  return *this;
}

void Program::use() const { gl_->UseProgram(id_); }

GLint Program::location(const char* name) const { return gl_->GetUniformLocation(id_, name); }

void Program::set(const char* name, int value) const { gl_->Uniform1i(location(name), value); }

void Program::set(const char* name, float value) const { gl_->Uniform1f(location(name), value); }

void Program::set(const char* name, const Eigen::Vector2f& value) const {
  gl_->Uniform2f(location(name), value.x(), value.y());
}

void Program::set(const char* name, const Eigen::Vector3f& value) const {
  gl_->Uniform3f(location(name), value.x(), value.y(), value.z());
}

void Program::set(const char* name, const Eigen::Vector4f& value) const {
  gl_->Uniform4f(location(name), value.x(), value.y(), value.z(), value.w());
}

void Program::set(const char* name, const Eigen::Matrix4f& value) const {
  gl_->UniformMatrix4fv(location(name), 1, GL_FALSE, value.data());
}

}  // namespace gridshell::render
