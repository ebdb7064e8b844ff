/*{
  "INPUTS": [
    { "NAME": "out", "TYPE": "float" }
  ]
}*/
void main() { gl_FragColor = vec4(1.0); }
