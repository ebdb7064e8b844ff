/*{ "INPUTS": [{ "NAME": "size", "TYPE": "float" }] }*/
uniform float gain, size;
void main() {
  gl_FragColor = vec4(gain);
}
