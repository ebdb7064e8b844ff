/*{
  "PASSES": [
    { "TARGET": "small", "WIDTH": "floor-($WIDTH)" },
    { }
  ]
}*/
void main() { gl_FragColor = IMG_THIS_PIXEL(small); }
