// A sound shader for the graphs of W181 to W187 that use it wrongly.
uniform sampler2D source;
out vec4 result;

void main() { result = texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
