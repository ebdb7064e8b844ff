layout(std140) uniform Parameters { float gain; };
in vec2 uv;
out vec4 radiance;

void main() { radiance = vec4(uv * gain, 0.0, 1.0); }
