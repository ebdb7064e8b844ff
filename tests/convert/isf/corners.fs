/*{
  "DESCRIPTION": "A vertex shader of its own",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "inputImage", "TYPE": "image" },
    { "NAME": "amount", "TYPE": "float", "DEFAULT": 6.0, "MIN": 0.0, "MAX": 20.0 }
  ]
}*/

varying vec2 left_of;
varying vec2 right_of;

void main() {
  vec4 a = IMG_NORM_PIXEL(inputImage, left_of);
  vec4 b = IMG_NORM_PIXEL(inputImage, right_of);
  gl_FragColor = vec4(a.r, 0.5 * (a.g + b.g), b.b, 1.0);
}
