/*{
  "INPUTS": [
    { "NAME": "mode", "TYPE": "long", "DEFAULT": 0.5 }
  ]
}*/
void main() { gl_FragColor = vec4(mode); }
