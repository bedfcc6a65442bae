// What is painted from far to near: cells, thin sheets that are lit from both sides and mostly by
// their own colour, so that the colour bar beside them stays true; and rods as ribbons.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 direction;  // normal and 0; or tangent, and radius with the side's sign
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
uniform float ground_z;
uniform float sample_size;  // mm, at distance 1 in perspective, else anywhere
out vec3 world;
out vec4 dark;          // of a cell: premultiplied colour in shadow; of a ribbon: its colour
out vec3 key_part;      // of a cell: what the key light adds; of a ribbon: across it
out vec3 facing;        // of a ribbon: towards the eye, at right angles to its axis
out vec2 place;         // of a ribbon: across it in samples, and its radius in samples; else 0

void sheet() {
  vec3 n = dot(direction.xyz, towards_eye(position)) < 0.0 ? -direction.xyz : direction.xyz;
  float through = dot(n, light_direction);
  const float own = 0.6;
  float pale = haze_at(position);
  float strength = (1.0 - own) * key * max(through, -0.6 * through) * (1.0 - pale);
  vec3 still = colour.rgb * (own * (sky + key * light_direction.z) + (1.0 - own) * ambient(n));
  dark = vec4(mix(still, background, pale), 1.0) * colour.a;
  key_part = colour.rgb * strength * colour.a;
  facing = vec3(0.0);
  place = vec2(0.0);
  gl_Position = view_projection * vec4(position, 1.0);
}

void ribbon() {
  vec3 sight = towards_eye(position);
  float unit = sample_size * (eye.w == 1.0 ? dot(position - eye.xyz, forward) : 1.0);
  float radius = max(radius_of(direction.w), 0.55 * unit);
  float reach = radius + unit;  // a sample more, for the part that the edge covers
  vec3 across = across_of(direction.xyz, sight);
  dark = colour;
  key_part = across;
  facing = normalize(cross(across, direction.xyz));
  place = vec2(sign(direction.w) * reach, radius) / unit;
  gl_Position = view_projection * vec4(position + sign(direction.w) * reach * across, 1.0);
}

void main() {
  world = position;
  if (direction.w == 0.0)
    sheet();
  else
    ribbon();
  gl_ClipDistance[0] = position.z - ground_z;
}
