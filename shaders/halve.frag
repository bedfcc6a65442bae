// A texture at half the size by the binomial filter 1 3 3 1 along both axes: four taps, each
// between texels.
uniform sampler2D finer;
uniform float finer_texel;  // 1 / number of texels along its side
out vec4 fragment;

void main() {
  vec2 at = 2.0 * gl_FragCoord.xy * finer_texel;
  float off = 0.75 * finer_texel;
  fragment = 0.25 * (texture(finer, at + vec2(off, off)) + texture(finer, at + vec2(-off, off)) +
                     texture(finer, at + vec2(off, -off)) + texture(finer, at + vec2(-off, -off)));
}
