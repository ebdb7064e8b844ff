// The picture with its first row at the top, as mpv counts rows. Slots: source?
#ifdef HAS_SOURCE
uniform sampler2D source;
#endif
in vec2 uv;
out vec4 result;
void main() {
#ifdef HAS_SOURCE
  result = texture(source, vec2(uv.x, 1.0 - uv.y));
#else
  result = vec4(0.0, 0.0, 0.0, 1.0);
#endif
}
