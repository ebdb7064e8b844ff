// Reads what the test reads, so that it is made. read light, place, facing, from; write result
uniform sampler2D light;
uniform sampler2D place;
uniform sampler2D facing;
uniform sampler2D from;
out vec4 result;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
  result = texelFetch(light, at, 0) + texelFetch(place, at, 0) + texelFetch(facing, at, 0) + texelFetch(from, at, 0);
}
