// Rods; the inputs are described in ribbon.vert.
in vec4 surface;
in vec4 shade, light_and_up, gloss_and_eye;
in vec2 on_strip;
out vec4 fragment;

void main() {
  // the fraction of a sample, a box of width 1, that the rod covers
  float off = abs(on_strip.x), radius = on_strip.y;
  float cover = clamp(radius - off + 0.5, 0.0, 1.0) - clamp(-radius - off + 0.5, 0.0, 1.0);
  float t = clamp(on_strip.x / radius, -1.0, 1.0);
  vec2 normal = vec2(t, sqrt(1.0 - t * t));  // its components across and towards the eye
  fragment = metal(Metal(surface, shade.w, gloss_and_eye.w, shade.xyz),
                   dot(normal, light_and_up.xy), dot(normal, gloss_and_eye.xy),
                   normal.y * gloss_and_eye.z, dot(normal, light_and_up.zw)) *
             cover;
}
