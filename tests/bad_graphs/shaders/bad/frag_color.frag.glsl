// The output of old versions of GLSL.
uniform sampler2D source;
out vec4 result;

void main() {
  result = vec4(0.0);
  gl_FragColor = texelFetch(source, ivec2(gl_FragCoord.xy), 0);
}
