
#ifdef @PRESENT@
uniform sampler2D @NAME@_raw;
#define @NAME@_size vec2(textureSize(@NAME@_raw, 0))
#define @NAME@_pt (1.0 / @NAME@_size)
#define @NAME@_mul 1.0
#define @NAME@_rot mat2(1.0)
#define @NAME@_off vec2(0.0)
#define @NAME@_map(id) mpvPlace(vec2(id))
#define @NAME@_pos mpv_place
#define @NAME@_tex(pos) texture(@NAME@_raw, pos)
#define @NAME@_texOff(off) texture(@NAME@_raw, @NAME@_pos + @NAME@_pt * vec2(off))
#define @NAME@_gather(pos, c) textureGather(@NAME@_raw, pos, c)
#endif
