/*{
  "DESCRIPTION": "The last pass has a target of a quarter of the size: it is what is shown",
  "ISFVSN": "2.0",
  "INPUTS": [ { "NAME": "inputImage", "TYPE": "image" } ],
  "PASSES": [ { "TARGET": "quarter", "WIDTH": "$WIDTH / 4", "HEIGHT": "$HEIGHT / 4" } ]
}*/

void main() {
  gl_FragColor = IMG_THIS_NORM_PIXEL(inputImage);
}
