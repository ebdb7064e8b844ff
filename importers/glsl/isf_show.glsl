// Shows the last target as the picture. Slots: source
uniform sampler2D source;
in vec2 uv;
out vec4 result;
void main() { result = texture(source, uv); }
