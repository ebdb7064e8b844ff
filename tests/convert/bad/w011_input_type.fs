/*{
  "INPUTS": [
    { "NAME": "level", "TYPE": "flaot" }
  ]
}*/
void main() { gl_FragColor = vec4(level); }
