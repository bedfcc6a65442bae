// The part of the ground that the shadow map contains.
uniform mat4 view_projection;
uniform mat4 on_ground;  // maps (u, v, 1, 0), u and v the coordinates on the map, to the ground
uniform float ground_z;
out vec2 at;     // coordinates on the map, 0 to 1
out vec2 point;  // of the ground, mm

void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  point = (on_ground * vec4(at, 1.0, 0.0)).xy;
  gl_Position = view_projection * vec4(point, ground_z, 1.0);
  // the near and far planes must not cut the ground
  gl_Position.z = 0.0;
}
