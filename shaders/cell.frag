// Cells: thin sheets, lit from both sides and mostly by their own colour, so that the colour bar
// beside them stays true.
in vec3 world;
in vec3 surface_normal;
in vec4 surface_colour;
out vec4 fragment;

void main() {
  vec3 n = normalize(surface_normal);
  if (dot(n, towards_eye(world)) < 0.0) n = -n;
  float through = dot(n, light_direction);
  float facing = max(through, -0.6 * through);
  float light = mix(1.0, facing * key * lit(world) + ambient(n), 0.55);
  fragment = vec4(hazed(surface_colour.rgb * light, world), 1.0) * surface_colour.a;
}
