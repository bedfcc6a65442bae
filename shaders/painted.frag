in vec3 world;
in vec4 dark;
in vec3 key_part;
in vec3 facing;
in vec2 place;
out vec4 fragment;

void main() {
  if (place.y == 0.0) {
    fragment = dark + vec4(key_part * lit(world), 0.0);
    return;
  }
  // how much of a sample the rod covers, as a box one sample wide sees it
  float off = abs(place.x), radius = place.y;
  float cover = clamp(radius - off + 0.5, 0.0, 1.0) - clamp(-radius - off + 0.5, 0.0, 1.0);
  if (cover <= 0.0) discard;
  float t = clamp(place.x / radius, -1.0, 1.0);
  vec3 n = normalize(t * key_part + sqrt(1.0 - t * t) * facing);
  fragment = metal(world, n, dark) * cover;
}
