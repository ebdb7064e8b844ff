/*
{
  "DESCRIPTION": "Names and calls of older GLSL",
  "ISFVSN": "2.0",
  "INPUTS": [
    { "NAME": "inputImage", "TYPE": "image" },
    { "NAME": "buffer", "TYPE": "float", "DEFAULT": 0.25, "MIN": 0.0, "MAX": 1.0 },
    { "NAME": "face", "TYPE": "float", "DEFAULT": 0.5, "MIN": 0.0, "MAX": 1.0 }
  ]
}
*/
#ifdef GL_ES
precision mediump float;
#endif

vec2 uv;
float time;

vec4 sample(vec2 at) {
  return texture2D(inputImage, at);
}

void main() {
  uv = isf_FragNormCoord;
  time = 0.5;
  vec4 result = sample(uv);
  vec4 shared = sample(fract(uv * 2.0));
  result = mix(result, shared, buffer);
  gl_FragData[0] = vec4(result.rgb * time * 2.0 * face, 1.0);
}
