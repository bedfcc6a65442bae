// Ribbons and sheets as the light sees them.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // of a ribbon: tangent; radius, with the side's sign
layout(location = 2) in vec4 colour;
uniform bool ribbons;        // true: ribbons; false: sheets
uniform vec3 light;          // direction towards the light
uniform mat4 light_matrix;   // world to shadow map
uniform float ground_z;      // mm
uniform float height_scale;  // 1 / height of the shell above the ground
out float height;            // above the ground, 0 to 1
out float cover;

void main() {
  height = clamp((position.z - ground_z) * height_scale, 0.0, 1.0);
  // parts below the ground are in an opening of it and cast no shadow
  cover = position.z < ground_z ? 0.0 : colour.a;
  vec3 at = position;
  if (ribbons) at += sign(direction.w) * radius_of(direction.w) * across_of(direction.xyz, light);
  gl_Position = light_matrix * vec4(at, 1.0);
}
