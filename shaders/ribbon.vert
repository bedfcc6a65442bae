layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // tangent, and radius with the side's sign
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
out vec4 surface;
out vec4 shade;  // place on the shadow map, and the shine's hue
// cosines of what is at right angles to the axis, across the ribbon and towards the eye
out vec4 light_and_up;  // with the light, and with what is up
out vec4 gloss_and_eye;  // with what is half way to the light; facing's with the eye; the haze
out vec2 place;  // across the ribbon, and its radius, in samples

void main() {
  float unit = unit_at(position);
  float radius = max(radius_of(direction.w), 0.55 * unit);
  float reach = radius + unit;  // a sample more, for the part that the edge covers
  vec3 sight = towards_eye(position), half_way = normalize(sight + light_direction);
  vec3 across = across_of(direction.xyz, sight);
  vec3 facing = normalize(cross(across, direction.xyz));
  surface = colour;
  shade = vec4(on_map(position), shine_hue(colour.rgb));
  light_and_up = vec4(dot(across, light_direction), dot(facing, light_direction), across.z, facing.z);
  gloss_and_eye = vec4(dot(across, half_way), dot(facing, half_way), dot(facing, sight),
                       haze_at(position));
  place = vec2(sign(direction.w) * reach, radius) / unit;
  gl_Position = view_projection * vec4(position + sign(direction.w) * reach * across, 1.0);
}
