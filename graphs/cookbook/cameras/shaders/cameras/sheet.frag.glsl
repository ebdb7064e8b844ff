// Four pictures beside each other, with a line between them.
// read    top_left, top_right, bottom_left, bottom_right   encoded pictures
// write   result                                           encoded picture
uniform sampler2D top_left, top_right, bottom_left, bottom_right;
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy), size = textureSize(top_left, 0), p = at % size;
  bool right = at.x >= size.x, top = at.y >= size.y;
  result = top ? (right ? texelFetch(top_right, p, 0) : texelFetch(top_left, p, 0))
               : (right ? texelFetch(bottom_right, p, 0) : texelFetch(bottom_left, p, 0));
  if (at.x == size.x || at.y == size.y) result = vec4(0.0, 0.0, 0.0, 1.0);
}
