// Joints and marks: cylinders about their axis and balls, on cards that face the eye.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // axis, and radius with the sign of the card's side
layout(location = 2) in vec4 colour;     // alpha in thirds: bit 0 the other side, bit 1 a ball
uniform mat4 view_projection;
const float height = 5.0 / 3.0;  // of half a joint's cylinder over its radius [Baek 2018]
out vec3 surface;
out vec4 shade;     // place on the shadow map, and the shine's hue
out vec4 half_way;  // to the light, and the haze
out vec3 right, up, axis;
out vec2 place;  // on the card, in samples
out vec3 shape;  // radius; of a cylinder how far its ends' middles lie off, else below 0; axis and sight

void main() {
  int code = int(3.0 * colour.a + 0.5);
  vec3 sight = towards_eye(position);
  float unit = unit_at(position), radius = max(radius_of(direction.w), 0.55 * unit) / unit;
  axis = normalize(direction.xyz);
  right = cross(axis, sight);
  float size = length(right);
  right = size > 1e-4 ? right / size : normalize(cross(sight, vec3(0.577, 0.577, 0.578)));
  up = cross(sight, right);
  float along = dot(axis, sight);
  shape = vec3(radius, code >= 2 ? -1.0 : height * radius * sqrt(max(0.0, 1.0 - along * along)), along);
  float high = code >= 2 ? radius : shape.y + radius * abs(along);
  place = vec2(sign(direction.w), (code & 1) == 1 ? 1.0 : -1.0) * (vec2(radius, high) + 1.0);
  surface = colour.rgb;
  shade = vec4(on_map(position), shine_hue(colour.rgb));
  half_way = vec4(normalize(sight + light_direction), haze_at(position));
  gl_Position = view_projection * vec4(position + unit * (place.x * right + place.y * up), 1.0);
}
