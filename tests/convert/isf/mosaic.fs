/*{
  "DESCRIPTION": "Tiles around a point: pixels, places and sizes of an image",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "inputImage", "TYPE": "image" },
    { "NAME": "centre", "TYPE": "point2D", "DEFAULT": [32.0, 20.0], "MIN": [0, 0], "MAX": [96, 64] },
    { "NAME": "tile", "TYPE": "float", "DEFAULT": 7.0, "MIN": 1.0, "MAX": 32.0 }
  ]
}*/

void main() {
  vec2 pixel = gl_FragCoord.xy;
  vec2 tiled = (floor((pixel - centre) / tile) + 0.5) * tile + centre;
  vec2 size = IMG_SIZE(inputImage);
  vec2 place = tiled / size;
  vec4 coarse = IMG_NORM_PIXEL(inputImage, place);
  vec4 fine = IMG_PIXEL(inputImage, pixel);
  gl_FragColor = distance(pixel, centre) < 20.0 ? fine : coarse;
}
