// One triangle over the whole target, top row first, with the ends of every pixel's line of sight.
uniform mat4 to_world;  // from clip coordinates
out vec4 near_point, far_point;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  near_point = to_world * vec4(corner.x, -corner.y, -1.0, 1.0);
  far_point = to_world * vec4(corner.x, -corner.y, 1.0, 1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
