// The mean of a pixel's samples in linear light, over the ground. The ground is smooth, so once a
// pixel serves for all samples. PER_SIDE: samples along a pixel's side.
in vec3 ground_point;
uniform sampler2D samples;
uniform vec2 texel_of_samples;
uniform float background_alpha;
uniform int rows;  // of the target, which holds the top row first
uniform bool ground_on;
out vec4 fragment;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 first = ivec2(pixel.x, rows - 1 - pixel.y) * PER_SIDE;
#if PER_SIDE == 2
  vec4 sum = textureLod(samples, (vec2(first) + 1.0) * texel_of_samples, 0.0);
#else
  vec4 sum = vec4(0.0);
  for (int y = 0; y < PER_SIDE; ++y)
    for (int x = 0; x < PER_SIDE; ++x) sum += texelFetch(samples, first + ivec2(x, y), 0);
  sum *= 1.0 / float(PER_SIDE * PER_SIDE);
#endif
  vec3 behind = background;
  if (ground_on && sum.a < 0.999) behind = ground_seen(ground_point);
  float open_part = (1.0 - min(sum.a, 1.0)) * background_alpha;
  fragment = vec4(sum.rgb + open_part * behind, sum.a + open_part);
}
