// The ground: level, of one colour, pale towards the background far out, with the shell's shadow.
uniform sampler2D cover;  // (cover, cover * height) seen from the light; its levels are the blur
uniform mat4 light_matrix;
uniform vec3 ground_colour, background;
uniform float ground_z;
uniform vec2 middle;        // of the shell
uniform vec2 fade;          // distances from it where the ground begins and ends to pale
uniform float open;         // light on level ground in the open
uniform float key_part;     // of the light on level ground that the shadow takes
uniform float sky_part;     // of the light that a roof over the whole sky takes
uniform float height_range; // mm
uniform float map_size;     // mm across
uniform float map_texels;
uniform vec2 penumbra;      // least width in mm, and width / height of what casts it
uniform bool shadow_on;

// Mean cover about a point of the map over a disc of the given width in mm.
float blurred(vec2 at, float width) {
  float texels = width / map_size * map_texels;
  float level = max(log2(0.45 * texels), 0.0);
  float r = 0.33 * width / map_size;
  float sum = 2.0 * textureLod(cover, at, level).r;
  for (int k = 0; k < 7; ++k) {
    float angle = 0.8975979 * float(k) + 0.3;
    sum += textureLod(cover, at + r * vec2(cos(angle), sin(angle)), level).r;
  }
  return sum / 9.0;
}

// Light on the ground at p.
float ground_light(vec3 p) {
  vec2 at = (light_matrix * vec4(p, 1.0)).xy * 0.5 + 0.5;
  if (at != clamp(at, 0.0, 1.0)) return open;
  float light = open;
  if (sky_part > 0.0)
    light -= sky_part * textureLod(cover, at, log2(0.06 * map_texels)).r;
  // a wide look first: nothing there, nothing to blur
  float wide = penumbra.x + penumbra.y * height_range;
  vec2 near = textureLod(cover, at, log2(max(wide / map_size * map_texels, 1.0))).rg;
  if (near.x < 0.002) return light;
  float height = near.y / near.x * height_range;
  return light - key_part * blurred(at, penumbra.x + penumbra.y * height);
}

// Colour of the ground, or of what lies behind it, on the line from a to b.
vec3 ground_seen(vec3 a, vec3 b) {
  float fall = a.z - b.z;
  float t = (a.z - ground_z) / fall;
  if (fall <= 0.0) return background;
  vec3 p = a + t * (b - a);
  float paling = smoothstep(fade.x, fade.y, distance(p.xy, middle));
  if (paling == 1.0) return background;
  float light = shadow_on ? ground_light(p) : open;
  return mix(ground_colour * light, background, paling);
}
