// A name that other programs give the time.
out vec4 result;

void main() { result = vec4(fract(u_time)); }
