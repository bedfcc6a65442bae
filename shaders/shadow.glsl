// Shadow of rods on the shell itself.
uniform sampler2DShadow shadow_depth;
uniform mat4 light_matrix;
uniform vec3 shadow_offset;  // towards the light, past the surface's own rod
uniform float shadow_blur;   // radius in the map, 0..1; 0: one tap
uniform bool shadow_on;

// 1 where the key light reaches, 0 in shadow.
float lit(vec3 world) {
  if (!shadow_on) return 1.0;
  vec3 p = (light_matrix * vec4(world + shadow_offset, 1.0)).xyz * 0.5 + 0.5;
  if (shadow_blur == 0.0) return texture(shadow_depth, p);
  float a = texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(0.924, 0.383), p.z)) +
            texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(-0.383, 0.924), p.z)) +
            texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(-0.924, -0.383), p.z)) +
            texture(shadow_depth, vec3(p.xy + shadow_blur * vec2(0.383, -0.924), p.z));
  return 0.25 * a;
}
