/*{
  "INPUTS": [
    { "NAME": "sound", "TYPE": "audioFFT" }
  ]
}*/
void main() { gl_FragColor = IMG_THIS_PIXEL(sound); }
