// Weight of the surface's own colour in its shine, against white: 0.5 for grey, 1 for a saturated
// colour, so that colours with a meaning can be read.
float shine_hue(vec3 base) {
  float hue = max(base.r, max(base.g, base.b)) - min(base.r, min(base.g, base.b));
  return 0.5 + 0.5 * hue;
}
