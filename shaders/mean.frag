// A share of what was drawn so far.
uniform sampler2D sum;
uniform float share;
out vec4 fragment;

void main() { fragment = share * texelFetch(sum, ivec2(gl_FragCoord.xy), 0); }
