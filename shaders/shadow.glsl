// Shadow of rods on the shell itself. TAPS: 0 without, 1 sharp, 4 with a soft edge; a branch would
// cost what both its sides do.
#if TAPS > 0
uniform sampler2DShadow shadow_depth;
uniform float shadow_blur;  // radius in the map, 0..1
#endif

// 1 where the key light reaches a position on the map, 0 in shadow.
float lit(vec3 p) {
#if TAPS == 0
  return 1.0;
#elif TAPS == 1
  return texture(shadow_depth, p);
#else
  float a = texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(0.924, 0.383), p.z)) +
            texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(-0.383, 0.924), p.z)) +
            texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(-0.924, -0.383), p.z)) +
            texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(0.383, -0.924), p.z));
  return 0.25 * a;
#endif
}
