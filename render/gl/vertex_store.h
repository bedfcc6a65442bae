// A Mesh on the graphics side.
#pragma once

#include "render/draw/mesh.h"
#include "render/gl/objects.h"

namespace gridshell::render {

class VertexStore {
 public:
  explicit VertexStore(const Gl& gl);

  void upload(const Mesh& mesh);
  void draw() const;
  bool empty() const { return count_ == 0; }

 private:
  const Gl* gl_;
  VertexArray layout_;
  Buffer vertices_, indices_;
  GLsizei count_ = 0;
};

}  // namespace gridshell::render
