// The ground and, above its horizon, the background.
in vec3 ground_point;
#ifdef GATHERED
uniform sampler2D gathered;  // mean light of many passes at every pixel

float light_there() { return texelFetch(gathered, ivec2(gl_FragCoord.xy), 0).r; }
#else
float light_there() { return open; }
#endif

void main() {
  if (ground_point.z <= 0.0)
    fragment = vec4(background.rgb, 1.0) * background.a;
  else
    show(ground_point.xy / ground_point.z, light_there());
}
