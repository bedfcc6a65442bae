// The ground: level, of one colour, pale towards the background far out.
uniform vec3 ground_colour;
uniform vec4 background;  // premultiplied is what is written
uniform vec2 middle;      // of the view
uniform vec2 fade;        // distances from it where the ground begins and ends to pale
uniform float open;       // light on level ground in the open
out vec4 fragment;

// What is seen at the ground's point p with this light on it.
void show(vec2 p, float light) {
  float paling = smoothstep(fade.x, fade.y, distance(p, middle));
  vec3 seen = mix(ground_colour * light, background.rgb, paling);
  fragment = vec4(seen, 1.0) * background.a;
  // of a clear picture the shadow alone; in the open the light is 1
  if (background.a == 0.0) fragment.a = clamp(1.0 - light, 0.0, 1.0) * (1.0 - paling);
}
