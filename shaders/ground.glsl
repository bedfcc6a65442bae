// The ground: level, of one colour, pale towards the background far out, with the shell's shadow.
uniform sampler2D cover;  // (cover, cover * height) seen from the light; its levels are the blur
uniform mat4 light_matrix;
uniform vec3 ground_colour, background;
uniform float ground_z;
uniform vec2 middle;         // of the view
uniform vec2 fade;           // distances from it where the ground begins and ends to pale
uniform float open;          // light on level ground in the open
uniform float key_part;      // of it that a full shadow takes
uniform float sky_part;      // of it that a roof over the whole sky takes
uniform float height_range;  // mm
uniform float texel;         // of the map's finest level, mm
uniform vec2 penumbra;       // least width in mm, and width / height of what casts it
uniform bool shadow_on;

// Light on the ground at p.
float ground_light(vec2 p) {
  vec2 at = (light_matrix * vec4(p, ground_z, 1.0)).xy * 0.5 + 0.5;
  if (at != clamp(at, 0.0, 1.0)) return open;
  // a wide look first: nothing there, nothing to blur
  float widest = penumbra.x + penumbra.y * height_range;
  vec2 wide = textureLod(cover, at, log2(2.0 * widest / texel)).rg;
  if (wide.x == 0.0) return open;
  float width = penumbra.x + penumbra.y * height_range * wide.y / wide.x;
  return open - key_part * textureLod(cover, at, max(log2(0.6 * width / texel), 0.0)).r -
         sky_part * wide.x;
}

// Colour of the ground at a point in homogeneous coordinates, or of what lies behind the ground.
vec3 ground_seen(vec3 point) {
  if (point.z <= 0.0) return background;
  vec2 p = point.xy / point.z;
  float paling = smoothstep(fade.x, fade.y, distance(p, middle));
  if (paling == 1.0) return background;
  float light = shadow_on ? ground_light(p) : open;
  return mix(ground_colour * light, background, paling);
}
