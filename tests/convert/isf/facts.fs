/*{
  "DESCRIPTION": "What players declare beside an image: its size, its part of a texture, and places in it",
  "ISFVSN": "2.0",
  "INPUTS": [ { "NAME": "inputImage", "TYPE": "image" } ],
  "PASSES": [ { "TARGET": "small", "WIDTH": "$WIDTH / 2", "HEIGHT": "$HEIGHT / 4" }, {} ]
}*/

void main() {
  if (PASSINDEX == 0) {
    // As many pixels of the image as this pass has.
    gl_FragColor = texture2D(inputImage, _inputImage_texCoord);
  } else {
    vec2 pixel = _inputImage_normTexCoord * _inputImage_imgSize;
    vec4 turned = VVSAMPLER_2DBYPIXEL(inputImage, _inputImage_imgRect, _inputImage_imgSize, _inputImage_flip, pixel.yx);
    vec4 tiled = texture2D(small, fract(gl_FragCoord.xy / _small_imgSize));
    gl_FragColor = pixel.x < 40.0 ? turned : tiled;
  }
}
