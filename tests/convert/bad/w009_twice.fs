/*{
  "INPUTS": [
    { "NAME": "level", "TYPE": "float" },
    { "NAME": "level", "TYPE": "bool" }
  ]
}*/
void main() { gl_FragColor = vec4(1.0); }
