// HLSL's function.
uniform sampler2D source;
out vec4 result;

void main() { result = saturate(texelFetch(source, ivec2(gl_FragCoord.xy), 0)); }
