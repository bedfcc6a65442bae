layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // tangent, and radius with the side's sign
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
uniform float ground_z;
out vec3 world;
out vec4 surface;
out vec3 across, facing;  // at right angles to the axis: across the ribbon, and towards the eye
out vec2 place;           // across the ribbon, and its radius, in samples

void main() {
  float unit = unit_at(position);
  float radius = max(radius_of(direction.w), 0.55 * unit);
  float reach = radius + unit;  // a sample more, for the part that the edge covers
  across = across_of(direction.xyz, towards_eye(position));
  facing = normalize(cross(across, direction.xyz));
  surface = colour;
  world = position;
  place = vec2(sign(direction.w) * reach, radius) / unit;
  gl_Position = view_projection * vec4(position + sign(direction.w) * reach * across, 1.0);
  gl_ClipDistance[0] = position.z - ground_z;
}
