// Rods, rings and joints: a matt base with the sheen of drawn metal. Premultiplied.
vec4 metal(vec3 world, vec3 n, vec4 surface) {
  vec3 v = towards_eye(world);
  float facing_light = max(dot(n, light_direction), 0.0);
  float key_light = facing_light > 0.0 ? key * lit(world) : 0.0;
  float gloss = max(dot(n, normalize(v + light_direction)), 0.0);
  gloss *= gloss;  // to the power of 32 in all
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  float edge = 1.0 - max(dot(n, v), 0.0);
  edge *= edge;
  float around = ambient(n);
  // grey metal shines white, a strong colour in itself: what colours mean stays readable
  vec3 base = surface.rgb;
  float hue = max(base.r, max(base.g, base.b)) - min(base.r, min(base.g, base.b));
  vec3 shine = mix(vec3(0.5), base, 0.5 + 0.5 * hue) * gloss * key_light +
               0.12 * edge * edge * around;
  vec3 colour = base * (facing_light * key_light + around) + sheen * shine;
  return vec4(mix(colour, background, haze_at(world)), 1.0) * surface.a;
}
