/*{
  "DESCRIPTION": "A buffer whose size is an input",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "inputImage", "TYPE": "image" },
    { "NAME": "cells", "TYPE": "float", "DEFAULT": 12.0, "MIN": 1.0, "MAX": 64.0 }
  ],
  "PASSES": [
    { "TARGET": "small", "WIDTH": "$cells", "HEIGHT": "max($cells * 2.0 / 3.0, 1)" },
    { }
  ]
}*/

void main() {
  if (PASSINDEX == 0)
    gl_FragColor = IMG_THIS_NORM_PIXEL(inputImage);
  else
    gl_FragColor = IMG_THIS_NORM_PIXEL(small);
}
