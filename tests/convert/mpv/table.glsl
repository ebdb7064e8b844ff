//!TEXTURE TILES
//!SIZE 3 2
//!FORMAT rgba8
//!FILTER NEAREST
//!BORDER REPEAT
ff0000ff00ff00ff0000ffff808080ffffff00ffff00ffff

//!TEXTURE RAMP
//!SIZE 4 1
//!FORMAT r32f
//!FILTER LINEAR
000000000000803e0000003f0000803f

//!HOOK MAIN
//!BIND HOOKED
//!BIND TILES
//!BIND RAMP
//!DESC textures that stand in the file

vec4 hook() {
  vec4 color = HOOKED_tex(HOOKED_pos);
  vec4 tile = texture(TILES, HOOKED_pos * vec2(2.0, 3.0));
  float ramp = texture(RAMP, vec2(color.r, 0.5)).r;
  return vec4(mix(color.rgb, tile.rgb, 0.5) * (0.5 + 0.5 * ramp), 1.0);
}
