// Letters, areas and the view of the shell, in the colours of the screen.
uniform sampler2D picture;
in vec2 at;
in vec4 ink;
out vec4 colour;

void main() { colour = ink * texture(picture, at); }
