// write   table      squares, as floats: the first half of it
layout(local_size_x = 8) in;
layout(std430) writeonly buffer table { float squares[16]; };

void main() {
  squares[gl_LocalInvocationIndex] = float(gl_LocalInvocationIndex * gl_LocalInvocationIndex);
}
