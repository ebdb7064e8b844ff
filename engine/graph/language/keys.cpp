#include "engine/graph/language/keys.h"

namespace weft::graph {

namespace {

constexpr KeySpec kGraph[] = {
    {"$schema", R"({"type":"string"})", "where editors find this schema; ignored"},
    {"name", R"({"type":"string"})", "name of the graph; the file's name when absent"},
    {"description", R"({"type":"string"})", "a line about the graph or preset, for people"},
    {"extends", R"({"anyOf":[{"type":"string"},{"type":"array","items":{"type":"string"},"minItems":1}]})",
     "path of the graph this file changes, from this file's folder; or a list: that, then overlays to lay "
     "over it"},
    {"set",
     R"({"type":"object","additionalProperties":{"anyOf":[{"type":["number","boolean","string"]},{"type":"array","items":{"type":"number"},"minItems":2,"maxItems":4}]}})",
     "values of parameters, by any unique suffix of a name"},
    {"parameters",
     R"({"type":"object","additionalProperties":{"anyOf":[{"$ref":"#/$defs/parameter"},{"$ref":"#/$defs/change"}]}})",
     "what a person may change: $name in expressions"},
    {"let",
     R"({"type":"object","additionalProperties":{"anyOf":[{"$ref":"#/$defs/value"},{"type":"null"}]}})",
     "named expressions: $name in others"},
    {"resources",
     R"({"type":"object","additionalProperties":{"anyOf":[{"$ref":"#/$defs/resource"},{"$ref":"#/$defs/change"}]}})",
     "textures, buffers, imports, inputs and alternatives, by name"},
    {"passes",
     R"({"type":"array","items":{"anyOf":[{"$ref":"#/$defs/pass"},{"$ref":"#/$defs/like"},{"$ref":"#/$defs/include"},{"$ref":"#/$defs/passChange"}]}})",
     "passes and includes, in declared order", true},
    {"present", "@reference", "the picture"},
    {"outputs", R"({"type":"object","additionalProperties":{"$ref":"#/$defs/reference"}})",
     "what is read back, by name"},
};

constexpr KeySpec kParameter[] = {
    {"type", "@parameterType", "from the default when absent", false, kParameterTypes},
    {"default",
     R"({"anyOf":[{"type":["number","boolean","string"]},{"type":"array","items":{"type":"number"},"minItems":2,"maxItems":4}]})",
     "initial value; a number without a point is an int", true},
    {"min", R"({"type":"number"})", "smallest value, of every component"},
    {"max", R"({"type":"number"})", "greatest value, of every component"},
    {"step", R"({"type":"number","exclusiveMinimum":0})", "step of the slider"},
    {"label", R"({"type":"string"})", "name in the viewer"},
    {"doc", R"({"type":"string"})", "a sentence for people"},
    {"choices",
     R"({"type":"array","items":{"type":"string","pattern":"^[A-Za-z_][A-Za-z0-9_]*$"},"minItems":1})",
     "the words it may be"},
    {"define", R"({"type":"boolean"})", "selects a shader variant instead of being a uniform"},
};

constexpr KeySpec kTexture[] = {
    {"texture", "@format", "texel format", true},
    {"size", "@value", "texels: a number (square), a list of two, or of three (3D)", true},
    {"mips", R"({"anyOf":[{"const":"full"},{"$ref":"#/$defs/value"}]})",
     "levels, clamped to the size; 1 when absent; \"full\" down to one texel"},
    {"layers", "@value", "layers of an array texture; cubes of a cube array"},
    {"array", "@value", "that many textures under one name, selected by [k]"},
    {"samples", "@value", "samples per texel of a multisample texture"},
    {"view", "@view", "how it is laid out; from layers and size when absent", false, kViewWords},
    {"clear", "@value", "version zero: what it holds before the first pass"},
    {"history", "@value", "how many previous publications are kept, for name@-n"},
    {"first", "@value",
     "what @-n holds before n publications: a value, or a texture that is read until then; needs history"},
    {"reset", "@resets", "what makes the history start again; needs history"},
};

constexpr KeySpec kBuffer[] = {
    {"buffer", "@value", "bytes", true},
    {"clear", "@value", "version zero: what every word holds before the first pass"},
    {"history", "@value", "how many previous publications are kept, for name@-n"},
    {"first", "@value",
     "what @-n holds before n publications: a value, or a buffer that is read until then; needs history"},
    {"reset", "@resets", "what makes the history start again; needs history"},
};

constexpr KeySpec kImport[] = {
    {"import", R"({"type":"string"})", "type of import; other keys are its arguments", true},
};

constexpr KeySpec kInput[] = {
    {"input", R"({"enum":["texture","buffer"]})", "bound by the file that includes this one", true,
     kInputWords},
    {"optional", R"({"type":"boolean"})",
     "may be left without a resource, and then has nothing: end references with ?"},
    {"history", "@value", "how many previous publications this file reads, as name@-n"},
    {"first", "@value",
     "what @-n holds before n publications, unless the bound resource says; needs history"},
    {"reset", "@resets", "what else makes the history start again; needs history"},
};

constexpr KeySpec kPass[] = {
    {"name", "@name", "name of this instance", true},
    {"type", R"({"type":"string"})", "kind of pass: fullscreen, compute, draw, blit, mipmap", true},
    {"like", R"({"type":"string"})",
     "a pass above in this file whose keys this one takes over, with its own laid over them"},
    {"shader", R"({"anyOf":[{"type":"string"},{"$ref":"#/$defs/shaders"}]})",
     "path from shaders/; for draw passes a folder and stem, or two paths; two paths for fullscreen, too"},
    {"enabled", "@value", "false removes the pass; true when absent"},
    {"repeat",
     R"({"anyOf":[{"$ref":"#/$defs/ranges"},{"type":"array","items":{"$ref":"#/$defs/ranges"},"minItems":1}]})",
     "one instance per index: {\"i\": [first, last, step]}"},
    {"read", "@slots", "slots that see the latest version before this pass"},
    {"write", "@slots", "slots that make the next version and cover all of it"},
    {"modify", "@slots", "slots that change what is there: blending, depth test"},
    {"parameters",
     R"({"type":"object","additionalProperties":{"anyOf":[{"$ref":"#/$defs/value"},{"$ref":"#/$defs/parameter"}]}})",
     "uniforms: a value, or a parameter declared on the spot"},
    {"defines", R"({"type":"object","additionalProperties":{"$ref":"#/$defs/value"}})",
     "preprocessor names of the shader"},
    {"state", "@state", "fixed-function state"},
    {"update", R"({"enum":["always","on_change","once"]})", "when it runs; always when absent", false,
     kUpdateWords},
    {"group", R"({"type":"string"})", "passes of one group publish together"},
    {"slices", "@value", "frames that one run takes (time-sliced); 0 rides with its predecessor"},
    {"threads", "@value", "compute invocations, rounded up to the local size"},
    {"instances", "@value",
     "instances of a draw without a list; with age() as many as it says in each frame"},
    {"list", R"({"type":"string"})", "draw list"},
    {"geometry", R"({"type":"string"})", "quad, octagon, mesh, triangle, icosphere(n)"},
    {"view", "@reference", "camera, light or cube face; @camera when absent"},
    {"feedback", R"({"type":"boolean"})", "a modify slot also reads its own texel"},
    {"side_effect", R"({"type":"boolean"})", "never culled"},
};

constexpr KeySpec kInclude[] = {
    {"include", R"({"type":"string"})", "path of a graph, from this file's folder", true},
    {"as", "@name", "prefix of its names; the file's name when absent"},
    {"bind", "@slots", "its inputs; those absent take the resource of the same name"},
    {"group", R"({"type":"string"})", "group of its passes that are not always and name none"},
    {"enabled", "@value", "false removes all its passes; true when absent"},
};

constexpr KeySpec kShader[] = {
    {"vertex", R"({"type":"string"})", "path of the vertex shader", true},
    {"fragment", R"({"type":"string"})", "path of the fragment shader", true},
};

constexpr KeySpec kState[] = {
    {"blend", R"({"anyOf":[{"type":"string"},{"type":"object","additionalProperties":{"type":"string"}}]})",
     "none, add, alpha, premultiplied, multiply, min, max; for all colour slots or by slot", false,
     kBlendWords},
    {"depth_test", R"({"type":"string"})",
     "never, less, equal, less_equal, greater, not_equal, greater_equal, always", false, kCompareNames},
    {"depth_write", "@value", "true when absent"},
    {"cull", R"({"type":"string"})", "none, front, back", false, kCullWords},
    {"polygon", R"({"type":"string"})", "fill, line", false, kPolygonWords},
    {"offset", "@value", "[factor, units] of the depth offset"},
};

constexpr KeySpec kPlace[] = {
    {"before", R"({"type":"string"})", "the pass, or the prefix of the include, that comes next"},
    {"after", R"({"type":"string"})", "the pass, or the prefix of the include, that comes first"},
    {"remove", R"({"type":"boolean"})", "takes the pass or include of this name out"},
};

}  // namespace

const std::span<const KeySpec> kGraphKeys = kGraph;
const std::span<const KeySpec> kParameterKeys = kParameter;
const std::span<const KeySpec> kTextureKeys = kTexture;
const std::span<const KeySpec> kBufferKeys = kBuffer;
const std::span<const KeySpec> kImportKeys = kImport;
const std::span<const KeySpec> kInputKeys = kInput;
const std::span<const KeySpec> kPassKeys = kPass;
const std::span<const KeySpec> kIncludeKeys = kInclude;
const std::span<const KeySpec> kShaderKeys = kShader;
const std::span<const KeySpec> kStateKeys = kState;
const std::span<const KeySpec> kPlaceKeys = kPlace;

}  // namespace weft::graph
