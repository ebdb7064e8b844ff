// read    u8, u16, u32, i32, i128   what these held
// write   new_u8 … new_i128         other numbers made of it
uniform usampler2D u8, u16, u32;
uniform isampler2D i32, i128;
out uvec4 new_u8, new_u16, new_u32;
out ivec4 new_i32, new_i128;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  uvec4 step = uvec4(1664525u, 22695477u, 1103515245u, 134775813u) * uint(at.x + 7 * at.y + 1);
  new_u8 = (texelFetch(u8, at, 0) * 5u + step) & 255u;
  new_u16 = (texelFetch(u16, at, 0) * 5u + step) & 65535u;
  new_u32 = texelFetch(u32, at, 0) * 5u + step;
  new_i32 = texelFetch(i32, at, 0) * 5 - ivec4(step);
  new_i128 = texelFetch(i128, at, 0) * 5 - ivec4(step);
}
