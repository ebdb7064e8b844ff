/*{
  "INPUTS": [
    { "NAME": "tint", "TYPE": "color", "DEFAULT": [1.0, 0.5] }
  ]
}*/
void main() { gl_FragColor = tint; }
