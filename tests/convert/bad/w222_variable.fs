/*{
  "PASSES": [
    { "TARGET": "small", "WIDTH": "$WIDTH / $cells" },
    { }
  ]
}*/
void main() { gl_FragColor = IMG_THIS_PIXEL(small); }
