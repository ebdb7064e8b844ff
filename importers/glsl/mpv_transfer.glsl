
// What libplacebo gives for the transfer function of the picture: that of sRGB, IEC 61966-2-1.
vec4 linearize(vec4 c) { return vec4(mix(c.rgb / 12.92, pow((max(c.rgb, 0.0) + 0.055) / 1.055, vec3(2.4)), greaterThan(c.rgb, vec3(0.04045))), c.a); }
vec4 delinearize(vec4 c) { return vec4(mix(c.rgb * 12.92, 1.055 * pow(max(c.rgb, 0.0), vec3(1.0 / 2.4)) - 0.055, greaterThan(c.rgb, vec3(0.0031308))), c.a); }
