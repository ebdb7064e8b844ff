// What ISF gives every shader, for @NAME@. The slots are the images, the parameters the inputs of the file.
layout(std140) uniform View {
  vec2 viewport;
  uint frame;
  float time;
  float delta_time;
};
@PARAMETERS@
vec2 RENDERSIZE = viewport;
float TIME = time;
float TIMEDELTA = delta_time;
int FRAMEINDEX = int(frame);

// For whole exponents: GLSL leaves pow() of a negative number open, and most devices multiply.
float isf_pow(float x, float exponent) { return (mod(exponent, 2.0) == 1.0 ? sign(x) : 1.0) * pow(abs(x), exponent); }

// Pictures have their first row at the bottom.
vec4 IMG_NORM_PIXEL(sampler2D image, vec2 place) { return texture(image, place); }
vec4 IMG_PIXEL(sampler2D image, vec2 pixel) { return texture(image, pixel / vec2(textureSize(image, 0))); }
vec4 IMG_THIS_PIXEL(sampler2D image) { return texture(image, isf_FragNormCoord); }
vec4 IMG_THIS_NORM_PIXEL(sampler2D image) { return texture(image, isf_FragNormCoord); }
vec2 IMG_SIZE(sampler2D image) { return vec2(textureSize(image, 0)); }
vec4 VVSAMPLER_2DBYPIXEL(sampler2D image, vec4 rect, vec2 size, bool flip, vec2 pixel) {
  vec2 place = pixel / size * rect.zw;
  return texture(image, rect.xy + (flip ? vec2(place.x, rect.w - place.y) : place));
}
vec4 VVSAMPLER_2DBYNORM(sampler2D image, vec4 rect, vec2 size, bool flip, vec2 place) {
  return VVSAMPLER_2DBYPIXEL(image, rect, size, flip, place * size);
}

@SLOTS@
