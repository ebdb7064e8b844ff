uniform sampler2D @IMAGE@;
#define _@NAME@_imgSize IMG_SIZE(@IMAGE@)
#define _@NAME@_imgRect vec4(0.0, 0.0, 1.0, 1.0)
#define _@NAME@_flip false
#define _@NAME@_normTexCoord isf_FragNormCoord
#define _@NAME@_texCoord (isf_FragNormCoord * RENDERSIZE / IMG_SIZE(@IMAGE@))
