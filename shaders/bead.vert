// Joints and marks: cylinders and balls, drawn on rectangles (cards) that face the eye.
layout(location = 0) in vec3 position;   // of the card's middle
layout(location = 1) in vec4 direction;  // axis; radius, its sign: left or right
layout(location = 2) in vec4 colour;     // 3 alpha: bit 0 an upper corner, bit 1 a ball
uniform mat4 view_projection;
const float height = 5.0 / 3.0;  // half a cylinder's height over its radius [Baek 2018]
out vec3 surface;                // colour
out vec4 shade;                  // position on the shadow map; shine_hue()
out vec4 half_way;               // unit vector half way between eye and light; haze_at()
out vec3 right, up, axis;        // of the card; of the cylinder
out vec2 on_card;                // position on the card, in samples
// radius in samples; distance of a cylinder's ends from its middle as seen, in samples, or -1 of a
// ball; cosine between axis and line of sight
out vec3 shape;

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
  on_card = vec2(sign(direction.w), (code & 1) == 1 ? 1.0 : -1.0) * (vec2(radius, high) + 1.0);
  surface = colour.rgb;
  shade = vec4(on_map(position), shine_hue(colour.rgb));
  half_way = vec4(normalize(sight + light_direction), haze_at(position));
  gl_Position = view_projection * vec4(position + unit * (on_card.x * right + on_card.y * up), 1.0);
}
