in vec3 world;
in vec3 surface_normal;
in vec4 surface_colour;
out vec4 fragment;

void main() { fragment = metal(world, normalize(surface_normal), surface_colour); }
