layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // of a ribbon: tangent, and radius with the side's sign
layout(location = 2) in vec4 colour;
uniform bool ribbons;
uniform vec3 light;
uniform mat4 light_matrix;
uniform float ground_z;
uniform float height_scale;
out float height;
out float cover;

void main() {
  height = clamp((position.z - ground_z) * height_scale, 0.0, 1.0);
  // what dips below the ground lies in its openings
  cover = position.z < ground_z ? 0.0 : colour.a;
  vec3 at = position;
  if (ribbons) at += sign(direction.w) * radius_of(direction.w) * across_of(direction.xyz, light);
  gl_Position = light_matrix * vec4(at, 1.0);
}
