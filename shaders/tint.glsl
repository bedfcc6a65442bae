// Grey metal shines white, a strong colour in itself: what colours mean stays readable.
float shine_hue(vec3 base) {
  float hue = max(base.r, max(base.g, base.b)) - min(base.r, min(base.g, base.b));
  return 0.5 + 0.5 * hue;
}
