// The mean of a pixel's samples in linear light, over the ground. The ground is smooth, so once a
// pixel serves for all samples.
in vec3 ground_point;
uniform sampler2D samples;
uniform int per_side;
uniform int rows;  // of the target, which holds the top row first
uniform bool ground_on;
out vec4 fragment;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 first = ivec2(pixel.x, rows - 1 - pixel.y) * per_side;
  vec4 sum = vec4(0.0);
  for (int y = 0; y < per_side; ++y)
    for (int x = 0; x < per_side; ++x) sum += texelFetch(samples, first + ivec2(x, y), 0);
  sum /= float(per_side * per_side);
  vec3 behind = background;
  if (ground_on && sum.a < 0.999) behind = ground_seen(ground_point);
  fragment = vec4(sum.rgb + (1.0 - min(sum.a, 1.0)) * behind, 1.0);
}
