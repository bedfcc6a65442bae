layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
uniform float ground_z;
out vec3 world;
out vec3 surface_normal;
out vec4 surface_colour;

void main() {
  world = position;
  surface_normal = normal;
  surface_colour = colour;
  gl_Position = view_projection * vec4(position, 1.0);
  gl_ClipDistance[0] = position.z - ground_z;
}
