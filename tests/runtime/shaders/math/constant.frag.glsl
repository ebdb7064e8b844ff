// write   result   `amount` everywhere
// params  amount
layout(std140) uniform Parameters { float amount; };
out vec4 result;

void main() { result = vec4(amount); }
