//!HOOK MAIN
//!BIND HOOKED
//!COMPUTE 16 8 8 8
//!DESC two texels for each thread

void hook() {
  for (int i = 0; i < 2; ++i) {
    ivec2 at = ivec2(gl_WorkGroupID.xy) * ivec2(16, 8) + ivec2(gl_LocalInvocationID.xy) * ivec2(2, 1) + ivec2(i, 0);
    vec4 color = HOOKED_tex(HOOKED_map(at));
    bool edge = gl_LocalInvocationID.x == 0u && i == 0;
    imageStore(out_image, at, vec4(edge ? vec3(1.0) - color.rgb : color.rgb, 1.0));
  }
}
