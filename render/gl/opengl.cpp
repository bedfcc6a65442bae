#include "render/gl/opengl.h"

#include <string>

#include "engine/core/try.h"
#include "render/gl/context.h"

namespace gridshell::render {

Result<Gl> Gl::load(const Context& context) {
  Gl gl;
  const char* missing = nullptr;
#define GRIDSHELL_GL_LOAD(name)                                                    \
  gl.name = reinterpret_cast<decltype(gl.name)>(context.proc_address("gl" #name)); \
  if (!gl.name && !missing) missing = "gl" #name;
  GRIDSHELL_GL_FUNCTIONS(GRIDSHELL_GL_LOAD)
#undef GRIDSHELL_GL_LOAD
  if (missing)
    return fail(Fault::io, std::string("the ") + context.kind_name() + " context has no function " +
                               missing + "; OpenGL 3.3 core is needed");
  return gl;
}

namespace {

void filter(const Gl& gl, GLint smaller, GLint larger) {
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, smaller);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, larger);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

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
    gl.DeleteShader(shader);  // it is freed with the program
    return {};
  }
  std::string log(log_size, '\0');
  gl.GetShaderInfoLog(shader, log_size, nullptr, log.data());
  gl.DeleteShader(shader);
  return fail(Fault::io, "shader " + names + " does not compile: " + log.c_str());
}

}  // namespace

void Target::allocate() {
  gl_->BindTexture(GL_TEXTURE_2D, colour_.id());
  for (int level = 0; level < levels_; ++level)
    gl_->TexImage2D(GL_TEXTURE_2D, level, GLint(format_), width_ >> level, height_ >> level, 0,
                    GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  filter(*gl_, levels_ > 1 ? GL_LINEAR_MIPMAP_LINEAR : GL_NEAREST,
         levels_ > 1 ? GL_LINEAR : GL_NEAREST);
  gl_->BindFramebuffer(GL_FRAMEBUFFER, frame_.id());
  gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colour_.id(), 0);
  if (depth_kind_ == Depth::none) return;

  gl_->BindTexture(GL_TEXTURE_2D, depth_.id());
  gl_->TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, width_, height_, 0, GL_DEPTH_COMPONENT,
                  GL_FLOAT, nullptr);
  const bool compared = depth_kind_ == Depth::compared;
  filter(*gl_, compared ? GL_LINEAR : GL_NEAREST, compared ? GL_LINEAR : GL_NEAREST);
  if (compared) {
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    gl_->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  }
  gl_->FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depth_.id(), 0);
}

Result<void> Target::bind(int width, int height, GLenum format) {
  const bool fits = width == width_ && height == height_ && format == format_;
  if (!fits) {
    width_ = width;
    height_ = height;
    format_ = format;
    allocate();
  }
  gl_->BindFramebuffer(GL_FRAMEBUFFER, frame_.id());
  gl_->Viewport(0, 0, width, height);
  if (fits || gl_->CheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE) return {};
  width_ = height_ = 0;
  return fail(Fault::io, "OpenGL cannot draw into {} x {} samples", width, height);
}

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
