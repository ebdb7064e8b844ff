/*{
  "PASSES": [
    { "TARGET": "small", "WIDTH": "sqrt($WIDTH)" },
    { }
  ]
}*/
void main() { gl_FragColor = IMG_THIS_PIXEL(small); }
