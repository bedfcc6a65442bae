// The part of the ground that the shadow map contains.
uniform mat4 view_projection;
uniform mat4 on_ground;  // its first two columns and the third: edges and corner of the map there
uniform float ground_z;
out vec2 at;  // on the map
out vec2 point;

void main() {
  at = vec2(gl_VertexID & 1, gl_VertexID >> 1);
  point = (on_ground * vec4(at, 1.0, 0.0)).xy;
  gl_Position = view_projection * vec4(point, ground_z, 1.0);
  // no plane in depth cuts the ground
  gl_Position.z = 0.0;
}
