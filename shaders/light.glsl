// Light on a surface, in linear light. See render/gl/lighting.h for the terms.
uniform vec3 light_direction;
uniform float key, sky, bounce;
uniform vec4 eye;  // w = 1: the camera's position; w = 0: the direction towards it
uniform vec3 background;
uniform vec2 haze;  // distance along the view where it begins, and 1 / its depth
uniform vec3 forward;
uniform float far_fade;
uniform mat4 light_matrix;
uniform vec3 shadow_offset;  // towards the light, past the surface's own rod

vec3 towards_eye(vec3 world) { return normalize(eye.xyz - eye.w * world); }

uniform float sample_size;  // mm, at distance 1 in perspective, else anywhere

// The size of a sample at a point, mm.
float unit_at(vec3 at) {
  return sample_size * (eye.w == 1.0 ? dot(at - eye.xyz, forward) : 1.0);
}

// Irradiance without the key light on a surface whose normal rises so much.
float ambient(float up) { return sky * (0.5 + 0.5 * up) + bounce * (0.5 - 0.5 * up); }

// What lies behind the target pales a little, so that near and far rods stay distinct: by this part.
float haze_at(vec3 world) {
  float depth = clamp((dot(world, forward) - haze.x) * haze.y, 0.0, 1.0);
  return far_fade * depth * (2.0 - depth);
}

// The position of a point on the shadow map.
vec3 on_map(vec3 world) {
  return (light_matrix * vec4(world + shadow_offset, 1.0)).xyz * 0.5 + 0.5;
}
