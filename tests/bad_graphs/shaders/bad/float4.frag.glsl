// HLSL's word for a vector.
uniform sampler2D source;
out vec4 result;

void main() {
  float4 color = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
  result = color;
}
