// Light on the ground over that in the open, in the plane of the shadow map. The higher the part
// that casts a shadow, the softer the shadow's edge.
uniform sampler2D cover;   // (cover, cover * height) as the light sees it; its levels are blurred
uniform float side;        // size of a fragment over that of the map
uniform float key_part;    // fraction of the light that a full shadow removes
uniform float sky_part;    // fraction of the light that a closed roof removes
uniform float wide_level;  // level whose blur is that of the widest penumbra
uniform float least;       // width of the narrowest penumbra, in texels of the finest level
uniform float growth;      // difference of the widest and the narrowest penumbra, in these texels
out vec4 fragment;

void main() {
  vec2 at = gl_FragCoord.xy * side;
  // the coarse level gives the mean height of the parts that cast the shadow
  vec2 wide = textureLod(cover, at, wide_level).rg;
  float width = least + growth * wide.y / max(wide.x, 1e-6);
  float blurred = textureLod(cover, at, max(log2(0.6 * width), 0.0)).r;
  // no shadow where the coarse level has no cover
  fragment = vec4(1.0 - key_part * min(blurred, 1e6 * wide.x) - sky_part * wide.x);
}
