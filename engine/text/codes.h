// Every diagnostic code of Weft: what is printed (search for W053), its name in C++, its one-line title. One table for all rooms; docs/errors.md has one section per
// code, and tests/bad_graphs (or the room's tests) one failing input per code. A ctest holds the three together.
//
// Ranges: W001-W019 JSON and files, W020-W039 expressions and references, W040-W099 graph (expansion, validation),
// W100-W149 shaders and GL, W150-W179 assets and scenes, W180-W199 command line, runtime and outputs, W200-W219 limits, W220-W239 pipelines of other
// programs, W240-W259 graph again.
// Numbers are never reused; W010 (overlays are not supported yet), W027 (like a pass that is not there), W087 (reserved kinds), W088 (reads of what timed passes made) and W093-W099 (workloads) are retired. Does not hold the message texts: those
// stand where the mistake is found.
#pragma once

#include <cstdint>

namespace weft::text {

// clang-format off
#define WEFT_CODES(X)                                                                               \
  X(W001, unreadableFile,            "file cannot be read")                                         \
  X(W002, notJson,                   "not a JSON document")                                         \
  X(W003, wrongType,                 "wrong type of value")                                         \
  X(W004, unknownKey,                "unknown key")                                                 \
  X(W005, missingKey,                "missing key")                                                 \
  X(W006, duplicateKey,              "duplicate key")                                               \
  X(W007, nestedTooDeeply,           "nested too deeply")                                           \
  X(W008, includesItself,            "file includes itself")                                        \
  X(W009, duplicateName,             "duplicate name")                                              \
  X(W011, unknownWord,               "unknown word")                                                \
  X(W012, notAName,                  "not a name")                                                  \
  X(W013, outOfRange,                "value out of its range")                                      \
  X(W014, keysExclude,               "keys that exclude each other")                                \
  X(W015, extendsItself,             "file extends itself")                                         \
  X(W016, passWithoutPlace,          "pass without a place")                                        \
  X(W017, nothingToChange,           "nothing there to change")                                     \
  X(W018, kindsDoNotMerge,           "kinds that do not merge")                                     \
  X(W019, overlayOutOfPlace,         "overlay out of place")                                        \
  /* expressions and references */                                                                  \
  X(W020, badExpression,             "expression cannot be parsed")                                 \
  X(W021, badReference,              "reference cannot be parsed")                                  \
  X(W022, unknownVariable,           "unknown name in an expression")                               \
  X(W023, operandsDoNotFit,          "operands that do not fit")                                    \
  X(W024, noFiniteResult,            "no finite result")                                            \
  X(W025, notAChoice,                "not one of the choices")                                      \
  X(W026, badFunctionCall,           "wrong function call")                                         \
  X(W028, unknownSet,                "unknown set")                                                 \
  /* graph */                                                                                       \
  X(W040, unknownResource,           "unknown resource")                                            \
  X(W041, unknownPassType,           "unknown pass type")                                           \
  X(W042, unknownFormat,             "unknown format")                                              \
  X(W043, unknownImport,             "unknown import")                                              \
  X(W044, unknownParameter,          "unknown parameter")                                           \
  X(W045, unknownPass,               "unknown pass")                                                \
  X(W046, ambiguousName,             "ambiguous name")                                              \
  X(W047, badParameterValue,         "value does not fit its parameter")                            \
  X(W048, numberOutOfRange,          "number out of its range")                                     \
  X(W049, nameUsedTwice,             "name used twice")                                             \
  X(W050, dependsOnItself,           "definition depends on itself")                                \
  X(W051, wrongValueType,            "value of the wrong type")                                     \
  X(W052, missingSubresource,        "sub-resource that is not there")                              \
  X(W053, badSelector,               "selector that does not fit")                                  \
  X(W054, noHistory,                 "history that is not kept")                                    \
  X(W055, notWritable,               "resource that cannot be written")                             \
  X(W056, badKind,                   "kind that does not fit")                                      \
  X(W057, badFormat,                 "format that does not fit")                                    \
  X(W058, attachmentsDiffer,         "attachments that differ")                                     \
  X(W059, readBeforeWrite,           "read before write")                                           \
  X(W060, disabledWriter,            "disabled pass leaves a read without a version")               \
  X(W061, passCycle,                 "passes wait for each other")                                  \
  X(W062, nobodyWrites,              "read of what nothing writes")                                 \
  X(W063, presentsUnwritten,         "present of what nothing writes")                              \
  X(W064, readAndWritten,            "one sub-resource read and written at once")                   \
  X(W065, writtenTwice,              "one sub-resource written twice")                              \
  X(W066, badSlots,                  "slots that do not fit the pass type")                         \
  X(W067, keyNotTaken,               "key that the pass type does not take")                        \
  X(W068, keyNeeded,                 "key that the pass type needs")                                \
  X(W069, unknownDrawList,           "unknown draw list")                                           \
  X(W070, unknownGeometry,           "unknown geometry")                                            \
  X(W071, notAView,                  "not a view")                                                  \
  X(W072, badImportArgument,         "import argument that does not fit")                           \
  X(W073, emptyImport,               "import that has nothing")                                     \
  X(W074, unboundInput,              "input with nothing behind it")                                \
  X(W075, badBind,                   "bind that does not fit")                                      \
  X(W076, addsUp,                    "result that would add up from frame to frame")                \
  X(W077, badSlices,                 "slices that do not fit")                                      \
  X(W078, badTime,                   "time where there is none")                                    \
  X(W079, badState,                  "state that does not fit")                                     \
  X(W080, wordForNumber,             "word where the shader needs a number")                        \
  X(W081, tooManyPasses,             "too many passes")                                             \
  X(W082, contradictoryTexture,      "texture that contradicts itself")                             \
  X(W083, cadenceMisfit,             "\"update\" that does not fit what is read")                     \
  X(W084, parameterNotPass,          "not a pass but a parameter")                                  \
  X(W085, conditionLeavesSlotEmpty,  "condition leaves a slot empty")                               \
  X(W086, badOutput,                 "output that cannot be read back")                             \
  X(W089, unusedDeclaration,         "declared and never used")                                     \
  X(W090, culledOverwritten,         "culled: output overwritten")                                  \
  X(W091, culledUnread,              "culled: output never read")                                   \
  X(W092, nothingPresented,          "nothing is presented")                                        \
  /* shaders and GL */                                                                              \
  X(W100, unreadableShader,          "shader file cannot be read")                                  \
  X(W101, missingShaderInclude,      "included file not found")                                     \
  X(W102, shaderIncludeCycle,        "shaders include each other in a cycle")                       \
  X(W103, malformedInclude,          "malformed #include")                                          \
  X(W104, shaderDoesNotCompile,      "shader does not compile")                                     \
  X(W105, programDoesNotLink,        "program does not link")                                       \
  X(W106, versionInShader,           "#version in a shader file")                                   \
  X(W110, noContext,                 "no OpenGL context could be opened")                           \
  X(W115, incompleteFramebuffer,     "framebuffer is incomplete")                                   \
  X(W116, textureNotCreated,         "texture cannot be created")                                   \
  X(W117, bufferNotCreated,          "buffer cannot be created")                                    \
  X(W118, viewNotCreated,            "texture view cannot be created")                              \
  X(W120, driverMessage,             "message from the OpenGL driver")                              \
  /* assets and scenes */                                                                           \
  X(W150, unreadableImage,           "image cannot be read")                                        \
  X(W151, unknownImageKind,          "unknown kind of image file")                                  \
  X(W152, badImageSize,              "image is empty or too large")                                 \
  X(W153, texelsReplaced,            "texels were replaced")                                        \
  X(W154, notACubeTable,             "not a .cube table")                                           \
  X(W155, badMaterialValue,          "material value out of range")                                 \
  X(W156, duplicateMaterial,         "duplicate material name")                                     \
  X(W157, displayReferred,           "colors of a screen as light")                                \
  X(W160, badSceneValue,             "scene value out of range")                                    \
  X(W161, unknownMaterial,           "unknown material")                                            \
  X(W162, unknownSceneList,          "unknown draw list")                                           \
  X(W164, unreadableModel,           "model cannot be read")                                        \
  X(W165, badModelValue,             "value in a model that cannot be")                             \
  X(W166, outsideModelFolder,        "file outside the model's folder")                             \
  X(W167, missingModelTexture,       "texture of a model is missing")                               \
  X(W168, modelPartLeftOut,          "part of a model was left out")                                \
  X(W169, unknownAnimation,          "unknown animation")                                           \
  /* command line, runtime, outputs */                                                              \
  X(W180, outputNotWritten,          "output cannot be written")                                    \
  X(W181, slotNotInShader,           "slot is not in the shader")                                   \
  X(W182, parameterNotInShader,      "parameter is not in the shader")                              \
  X(W183, slotTypeMismatch,          "slot and shader type do not fit")                             \
  X(W184, parameterTypeMismatch,     "parameter and shader type do not fit")                        \
  X(W185, unknownViewMember,         "unknown member of the View block")                            \
  X(W186, notAnInstanceTable,        "storage block does not fit its table")                          \
  X(W187, undeclaredShaderInput,     "shader uses what its pass does not name")                     \
  X(W188, presentsNothing,           "graph presents nothing")                                      \
  X(W195, fileChanged,               "file changed since it was read")                              \
  X(W196, cannotWriteBack,           "change that cannot be written back")                          \
  X(W197, laidOutDifferently,        "file is laid out differently")                                \
  /* limits and what may be opened */                                                               \
  X(W200, outsideConfinement,        "path outside the confined folders")                           \
  X(W201, limitExceeded,             "limit exceeded")                                              \
  X(W202, texturesTooLarge,          "textures larger than the memory limit")                       \
  X(W203, shaderTooLarge,            "shader larger than the driver survives")                      \
  X(W204, driverDied,                "shader that the driver did not survive")                      \
  X(W205, filesNotWatched,           "files are not watched")                                       \
  X(W206, tooManyWorkGroups,         "work groups beyond the limit of the device")                  \
  X(W207, pictureNotFinite,          "picture of values that are no colors")                       \
  X(W208, messagesLeftOut,           "further messages are left out")                               \
  /* pipelines of other programs */                                                                \
  X(W220, notIsf,                    "not an ISF file")                                             \
  X(W221, isfNotMapped,              "ISF that Weft cannot map")                                    \
  X(W222, sizeNotMapped,             "size that Weft cannot express")                               \
  X(W223, unknownPipeline,           "unknown kind of pipeline")                                    \
  X(W224, glslNotMapped,             "GLSL that cannot be translated")                              \
  X(W225, badMpvHeader,              "broken header of an mpv shader")                              \
  X(W226, mpvNotMapped,              "mpv shader that Weft cannot map")
// clang-format on

// 53 of "W053".
constexpr std::uint16_t numberOf(const char* code) {
  std::uint16_t number = 0;
  for (const char* digit = code + 1; *digit != 0; ++digit)
    number = static_cast<std::uint16_t>(10 * number + (*digit - '0'));
  return number;
}

// A diagnostic code; the numeric value is what follows the W in "W040".
enum class Code : std::uint16_t {
#define WEFT_CODE_ENUM(number, name, title) name = numberOf(#number),
  WEFT_CODES(WEFT_CODE_ENUM)
#undef WEFT_CODE_ENUM
};

// The title of a code as it stands in the table above.
constexpr const char* titleOf(Code code) {
  switch (code) {
#define WEFT_CODE_CASE(number, name, title) \
  case Code::name:                          \
    return title;
    WEFT_CODES(WEFT_CODE_CASE)
#undef WEFT_CODE_CASE
  }
  return "";
}

}  // namespace weft::text
