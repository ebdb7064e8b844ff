// Four pictures, each in a quarter.
// read   front, left, right, top
// write  result
uniform sampler2D front, left, right, top;
out vec4 result;

void main() {
  ivec2 size = textureSize(front, 0), at = ivec2(gl_FragCoord.xy);
  ivec2 in_part = at % size;
  if (at.y < size.y)
    result = at.x < size.x ? texelFetch(front, in_part, 0) : texelFetch(left, in_part, 0);
  else
    result = at.x < size.x ? texelFetch(right, in_part, 0) : texelFetch(top, in_part, 0);
}
