// One triangle over the target, with the point of the ground that each pixel shows.
uniform mat4 to_ground;  // upper left 3 x 3: maps clip coordinates (x, y, 1) to (X, Y, 1) / depth
out vec3 ground_point;

void main() {
  vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
  ground_point = mat3(to_ground) * vec3(corner, 1.0);
  gl_Position = vec4(corner, 0.0, 1.0);
}
