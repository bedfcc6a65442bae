// The ground in the open, or what lies behind it.
in vec3 ground_point;

void main() {
  if (ground_point.z <= 0.0)
    fragment = vec4(background.rgb, 1.0) * background.a;
  else
    show(ground_point.xy / ground_point.z, open);
}
