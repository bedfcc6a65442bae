// Rods as strips. A normal of the round rod is a combination of two unit vectors at right angles to
// its axis: `across` the strip and `facing` the eye.
layout(location = 0) in vec3 position;   // on the axis
layout(location = 1) in vec4 direction;  // tangent; radius, with the side's sign
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
out vec4 surface;  // colour
out vec4 shade;    // position on the shadow map; shine_hue()
// cosines of across and facing with the direction to the light; their vertical components
out vec4 light_and_up;
// cosines of across and facing with the direction half way between eye and light; cosine of facing
// with the direction to the eye; haze_at()
out vec4 gloss_and_eye;
out vec2 on_strip;  // position across the strip; radius of the rod; in samples

void main() {
  float unit = unit_at(position);
  float radius = max(radius_of(direction.w), 0.55 * unit);
  float reach = radius + unit;  // the strip is a sample wider, for samples that are partly covered
  vec3 sight = towards_eye(position), half_way = normalize(sight + light_direction);
  vec3 across = across_of(direction.xyz, sight);
  vec3 facing = normalize(cross(across, direction.xyz));
  surface = colour;
  shade = vec4(on_map(position), shine_hue(colour.rgb));
  light_and_up = vec4(dot(across, light_direction), dot(facing, light_direction), across.z, facing.z);
  gloss_and_eye = vec4(dot(across, half_way), dot(facing, half_way), dot(facing, sight),
                       haze_at(position));
  on_strip = vec2(sign(direction.w) * reach, radius) / unit;
  gl_Position = view_projection * vec4(position + sign(direction.w) * reach * across, 1.0);
}
