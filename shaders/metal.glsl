// Rods, rings and joints: a matt base with the sheen of drawn metal. Colours are premultiplied.
uniform float sheen;  // 0: flat ink
uniform float unlit;  // 1: in its own colour, as a colour bar has it; 0: lit

// Quantities of a surface that are computed per vertex.
struct Metal {
  vec4 surface;          // colour
  float hue;             // shine_hue()
  float pale;            // haze_at()
  vec3 shadow_position;  // position on the shadow map
};

// The colour of a point. Cosines of its normal with the directions to the light, half way between
// light and eye, and to the eye; `up` is the normal's vertical component.
vec4 metal(Metal metal, float to_light, float half_way, float to_eye, float up) {
  float facing_light = max(to_light, 0.0);
  float key_light = facing_light > 0.0 ? key * lit(metal.shadow_position) : 0.0;
  float gloss = max(half_way, 0.0);
  gloss *= gloss;  // five squares: the power of 32
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
