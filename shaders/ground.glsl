// The ground: level and of one colour that fades to the background far from the middle.
uniform vec3 ground_colour;
uniform vec4 background;  // not premultiplied; the output is
uniform vec2 middle;      // of the view, mm
uniform vec2 fade;        // distances from it at which the fading begins and ends, mm
uniform float open;       // light on level ground in the open
out vec4 fragment;

// Writes the colour of the ground's point p under this light.
void show(vec2 p, float light) {
  float paling = smoothstep(fade.x, fade.y, distance(p, middle));
  vec3 seen = mix(ground_colour * light, background.rgb, paling);
  fragment = vec4(seen, 1.0) * background.a;
  // a picture with a clear background has the shadow alone; in the open the light is 1
  if (background.a == 0.0) fragment.a = clamp(1.0 - light, 0.0, 1.0) * (1.0 - paling);
}
