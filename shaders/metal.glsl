// Rods, rings and joints: a matt base with the sheen of drawn metal. Premultiplied.
uniform float sheen;  // 0: flat ink
uniform float unlit;  // 1: in its own colour, which a bar explains; 0: lit

// What a point's neighbours share, and so is found once a vertex.
struct Metal {
  vec4 surface;
  float hue;   // of the shine's own colour
  float pale;  // by haze
  vec3 place;  // on the shadow map
};

// The cosines are those of the normal with the light, with what is half way to the eye, and with
// the eye; `up` is how much it rises.
vec4 metal(Metal metal, float to_light, float half_way, float to_eye, float up) {
  float facing_light = max(to_light, 0.0);
  float key_light = facing_light > 0.0 ? key * lit(metal.place) : 0.0;
  float gloss = max(half_way, 0.0);
  gloss *= gloss;  // to the power of 32 in all
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  float edge = 1.0 - max(to_eye, 0.0);
  edge *= edge;
  float around = ambient(up);
  vec3 base = metal.surface.rgb;
  vec3 shine = mix(vec3(0.5), base, metal.hue) * gloss * key_light + 0.12 * edge * edge * around;
  vec3 colour = base * (facing_light * key_light + around) + sheen * shine;
  colour = mix(mix(colour, background, metal.pale), base, unlit);
  return vec4(colour, 1.0) * metal.surface.a;
}
