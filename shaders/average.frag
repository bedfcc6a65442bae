// The mean of a pixel's samples, in linear light.
uniform sampler2D samples;
uniform vec2 texel_of_samples;
uniform vec2 corner;  // of the samples, in the target
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
