/*{ }*/
uniform float gain;
void main() {
  gl_FragColor = vec4(gain);
}
