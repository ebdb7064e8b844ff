// read    picture, marks, list, copied
// write   result   the picture; how often the texel is marked; the last item of the list and of its copy
uniform sampler2D picture;
uniform usampler2D marks;
layout(std430) readonly buffer list { uint item[]; };
layout(std430) readonly buffer copied { uint copied_item[]; };
out vec4 result;

void main() {
  ivec2 p = ivec2(gl_FragCoord.xy);
  result = vec4(texelFetch(picture, p, 0).r, texelFetch(marks, p, 0).r, item[63], copied_item[63]);
}
