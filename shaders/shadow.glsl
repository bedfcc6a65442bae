// Shadow of rods on the shell itself. TAPS is 0 without shadow, 1 with sharp and 4 with soft edges.
// It is a macro because a branch in the shader would cost as much as both its sides.
#if TAPS > 0
uniform sampler2DShadow shadow_depth;
uniform float shadow_blur;  // radius of the soft edge over the map's side
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
