out vec4 result;
float dim(float x);
float fade(float x) { return x < 0.1 ? x : dim(x) * 0.5; }
float dim(float x) { return fade(x - 0.1); }
void main() { result = vec4(fade(1.0)); }
