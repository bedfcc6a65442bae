// Light on a surface, in linear light. The terms are those of render/gl/lighting.h.
uniform vec3 light_direction;
uniform float key, sky, bounce;
uniform vec4 eye;  // w = 1: the camera's position; w = 0: the direction towards it
uniform vec3 background;
uniform vec2 haze;           // distance along the view at which haze begins; 1 / its depth
uniform vec3 forward;        // direction of the view
uniform float far_fade;      // haze_at() of the farthest points
uniform mat4 light_matrix;   // world to shadow map
uniform vec3 shadow_offset;  // towards the light, so that a rod does not shade itself

vec3 towards_eye(vec3 world) { return normalize(eye.xyz - eye.w * world); }

uniform float sample_size;  // mm; in perspective at distance 1

// The size of a sample at a point, mm.
float unit_at(vec3 at) {
  return sample_size * (eye.w == 1.0 ? dot(at - eye.xyz, forward) : 1.0);
}

// Irradiance without the key light; `up` is the vertical component of the surface's normal.
float ambient(float up) { return sky * (0.5 + 0.5 * up) + bounce * (0.5 - 0.5 * up); }

// The fraction by which a point behind the target fades to the background, so that near and far
// rods are distinct.
float haze_at(vec3 world) {
  float depth = clamp((dot(world, forward) - haze.x) * haze.y, 0.0, 1.0);
  return far_fade * depth * (2.0 - depth);
}

// The position of a point on the shadow map.
vec3 on_map(vec3 world) {
  return (light_matrix * vec4(world + shadow_offset, 1.0)).xyz * 0.5 + 0.5;
}
