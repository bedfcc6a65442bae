#include "render/gl/opengl.h"

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

}  // namespace gridshell::render
