// write   result   column x: the x-th number of the parameters
layout(std140) uniform Parameters {
  vec3 eye, looks, sun;
  vec2 lens;
  float lamp;
};
out float result;

void main() {
  int i = int(gl_FragCoord.x);
  result = i < 3 ? eye[i] : i < 6 ? looks[i - 3] : i < 9 ? sun[i - 6] : i < 11 ? lens[i - 9] : lamp;
}
