uniform sampler2D source;
vec4 texel() { return texelFetch(source, ivec2(gl_FragCoord.xy), 0); }
