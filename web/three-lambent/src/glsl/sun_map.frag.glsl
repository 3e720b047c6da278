// Depth alone: what is drawn is not written.

out vec4 color;

void main() { color = vec4(0.0); }
