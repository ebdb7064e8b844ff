// Reads what the test reads, so that it is made. read shares, around, place, facing; write result
uniform sampler2D shares;
uniform sampler2D around;
uniform sampler2D place;
uniform sampler2D facing;
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = texelFetch(shares, at, 0) + texelFetch(around, at, 0) + texelFetch(place, at, 0) + texelFetch(facing, at, 0);
}
