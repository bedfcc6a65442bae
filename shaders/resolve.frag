// The mean of a pixel's samples in linear light, over the ground. The ground is smooth, so once a
// pixel serves for all samples. PER_SIDE: samples along a pixel's side.
in vec3 ground_point;
uniform sampler2D samples;
uniform int rows;  // of the target, which holds the top row first
uniform bool ground_on;
out vec4 fragment;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 first = ivec2(pixel.x, rows - 1 - pixel.y) * PER_SIDE;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < PER_SIDE; ++y)
    for (int x = 0; x < PER_SIDE; ++x) sum += texelFetch(samples, first + ivec2(x, y), 0);
  sum *= 1.0 / float(PER_SIDE * PER_SIDE);
  vec3 behind = background;
  if (ground_on && sum.a < 0.999) behind = ground_seen(ground_point);
  fragment = vec4(sum.rgb + (1.0 - min(sum.a, 1.0)) * behind, 1.0);
}
