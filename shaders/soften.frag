// Light on the ground over that in the open, in the plane of the shadow map: the farther the ground
// from what casts the shadow, the softer its edge.
uniform sampler2D cover;  // (cover, cover * height) seen from the light; its levels are the blur
uniform float side;          // of a fragment, on the map
uniform float key_part;      // what a full shadow takes
uniform float sky_part;      // what a roof over the whole sky takes
uniform float wide_level;    // of the widest penumbra
uniform float least;         // width of the narrowest, in texels of the finest level
uniform float growth;        // of the width from there to the widest
out vec4 fragment;

void main() {
  vec2 at = gl_FragCoord.xy * side;
  // a wide look first: how high above the ground is what casts the shadow
  vec2 wide = textureLod(cover, at, wide_level).rg;
  float width = least + growth * wide.y / max(wide.x, 1e-6);
  float blurred = textureLod(cover, at, max(log2(0.6 * width), 0.0)).r;
  // what the wide look does not see is not there
  fragment = vec4(1.0 - key_part * min(blurred, 1e6 * wide.x) - sky_part * wide.x);
}
