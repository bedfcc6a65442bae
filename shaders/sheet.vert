// Cells: thin sheets, lit from both sides and mostly by their own colour, so that the colour bar
// beside them stays true. A patch is fine enough to be lit at its vertices.
layout(location = 0) in vec3 position;
layout(location = 1) in vec4 normal;
layout(location = 2) in vec4 colour;
uniform mat4 view_projection;
uniform float ground_z;
out vec3 shade;     // place on the shadow map
out vec4 dark;      // premultiplied colour in shadow
out vec3 key_part;  // what the key light adds

void main() {
  shade = on_map(position);
  vec3 n = dot(normal.xyz, towards_eye(position)) < 0.0 ? -normal.xyz : normal.xyz;
  float through = dot(n, light_direction);
  const float own = 0.6;
  float pale = haze_at(position);
  float strength = (1.0 - own) * key * max(through, -0.6 * through) * (1.0 - pale);
  vec3 still = colour.rgb * (own * (sky + key * light_direction.z) + (1.0 - own) * ambient(n.z));
  dark = vec4(mix(still, background, pale), 1.0) * colour.a;
  key_part = colour.rgb * strength * colour.a;
  gl_Position = view_projection * vec4(position, 1.0);
  gl_ClipDistance[0] = position.z - ground_z;
}
