// Joints and marks: spheroids about their axis, on cards that face the eye.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // axis, and radius with the sign of the card's side
layout(location = 2) in vec4 colour;     // alpha in thirds: bit 0 the other side, bit 1 a ball
uniform mat4 view_projection;
out vec3 surface;
out vec4 shade;     // place on the shadow map, and the shine's hue
out vec4 half_way;  // to the light, and the haze
out vec3 right, up, axis;
out vec2 place;   // on the card, over the outline's half axes
out vec2 half_axes;  // in samples
out vec2 shape;   // 1 / height^2 - 1 / radius^2 over 1 / radius^2, and half axis up over radius

void main() {
  int code = int(3.0 * colour.a + 0.5);
  float flatness = code >= 2 ? 1.0 : 0.62;
  vec3 sight = towards_eye(position);
  float unit = unit_at(position), radius = max(radius_of(direction.w), 0.55 * unit);
  axis = normalize(direction.xyz);
  right = cross(axis, sight);
  float size = length(right);
  right = size > 1e-4 ? right / size : normalize(cross(sight, vec3(0.577, 0.577, 0.578)));
  up = cross(sight, right);
  // the outline of a spheroid is an ellipse
  float along = dot(axis, sight);
  float high = radius * sqrt(along * along + flatness * flatness * (1.0 - along * along));
  half_axes = vec2(radius, high) / unit;
  vec2 corner = vec2(sign(direction.w), (code & 1) == 1 ? 1.0 : -1.0);
  place = corner * (half_axes + 1.0) / half_axes;
  shape = vec2(1.0 / (flatness * flatness) - 1.0, high / radius);
  surface = colour.rgb;
  shade = vec4(on_map(position), shine_hue(colour.rgb));
  half_way = vec4(normalize(sight + light_direction), haze_at(position));
  vec3 at = position + place.x * radius * right + place.y * high * up;
  gl_Position = view_projection * vec4(at, 1.0);
}
