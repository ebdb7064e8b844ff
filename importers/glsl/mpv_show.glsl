// Turns the picture back, scales it to the screen and undoes what the passes shifted. Slots: source
uniform sampler2D source;
layout(std140) uniform Parameters { vec2 shift; };
in vec2 uv;
out vec4 result;
void main() { result = texture(source, vec2(uv.x, 1.0 - uv.y) + shift); }
