// The mean of a pixel's PER_SIDE x PER_SIDE samples, in linear light.
uniform sampler2D samples;
uniform vec2 texel_of_samples;  // size of a texel in texture coordinates
uniform vec2 corner;            // pixel of the target that the first samples belong to
out vec4 fragment;

void main() {
  ivec2 first = ivec2(gl_FragCoord.xy - corner) * PER_SIDE;
#if PER_SIDE == 2
  fragment = textureLod(samples, (vec2(first) + 1.0) * texel_of_samples, 0.0);
#else
  vec4 sum = vec4(0.0);
  for (int y = 0; y < PER_SIDE; ++y)
    for (int x = 0; x < PER_SIDE; ++x) sum += texelFetch(samples, first + ivec2(x, y), 0);
  fragment = sum / float(PER_SIDE * PER_SIDE);
#endif
}
