in vec3 world;
in vec4 surface;
in vec3 across, facing;
in vec2 place;
out vec4 fragment;

void main() {
  // how much of a sample the rod covers, as a box one sample wide sees it
  float off = abs(place.x), radius = place.y;
  float cover = clamp(radius - off + 0.5, 0.0, 1.0) - clamp(-radius - off + 0.5, 0.0, 1.0);
  float t = clamp(place.x / radius, -1.0, 1.0);
  vec3 n = normalize(t * across + sqrt(1.0 - t * t) * facing);
  fragment = metal(world, n, surface) * cover;
}
