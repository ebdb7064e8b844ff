// Every diagnostic code of Weft and its one-line title. One table for all rooms; docs/errors.md has one section per
// code, and tests/bad_graphs (or the room's tests) one failing input per code. A ctest holds the three together.
//
// Ranges: W001-W019 JSON and files, W020-W039 expressions and references, W040-W099 graph (expansion, validation),
// W100-W149 shaders and GL, W150-W179 assets and scenes, W180-W199 command line, runtime and outputs, W200-W219 limits.
// Numbers are never reused; W010 (overlays are not supported yet) is retired. Does not hold the message texts: those
// stand where the mistake is found.
#pragma once

#include <cstdint>

namespace weft::base {

// clang-format off
#define WEFT_CODES(X)                                                     \
  X(1,   "file cannot be read")                                           \
  X(2,   "not a JSON document")                                           \
  X(3,   "wrong type of value")                                           \
  X(4,   "unknown key")                                                   \
  X(5,   "missing key")                                                   \
  X(6,   "duplicate key")                                                 \
  X(7,   "nested too deeply")                                             \
  X(8,   "file includes itself")                                          \
  X(9,   "duplicate name")                                                \
  X(11,  "unknown word")                                                  \
  X(12,  "not a name")                                                    \
  X(13,  "value out of its range")                                        \
  X(14,  "keys that exclude each other")                                  \
  X(15,  "file extends itself")                                           \
  X(16,  "pass without a place")                                          \
  X(17,  "nothing there to change")                                       \
  X(18,  "kinds that do not merge")                                       \
  X(19,  "overlay out of place")                                          \
  /* expressions and references */                                        \
  X(20,  "expression cannot be parsed")                                   \
  X(21,  "reference cannot be parsed")                                    \
  X(22,  "unknown name in an expression")                                 \
  X(23,  "operands that do not fit")                                      \
  X(24,  "no finite result")                                              \
  X(25,  "not one of the choices")                                        \
  X(26,  "wrong function call")                                           \
  /* graph */                                                             \
  X(40,  "unknown resource")                                              \
  X(41,  "unknown pass type")                                             \
  X(42,  "unknown format")                                                \
  X(43,  "unknown import")                                                \
  X(44,  "unknown parameter")                                             \
  X(45,  "unknown pass")                                                  \
  X(46,  "ambiguous name")                                                \
  X(47,  "value does not fit its parameter")                              \
  X(48,  "number out of its range")                                       \
  X(49,  "name used twice")                                               \
  X(50,  "definition depends on itself")                                  \
  X(51,  "value of the wrong type")                                       \
  X(52,  "sub-resource that is not there")                                \
  X(53,  "selector that does not fit")                                    \
  X(54,  "history that is not kept")                                      \
  X(55,  "resource that cannot be written")                               \
  X(56,  "kind that does not fit")                                        \
  X(57,  "format that does not fit")                                      \
  X(58,  "attachments that differ")                                       \
  X(59,  "read before write")                                             \
  X(60,  "disabled pass leaves a read without a version")                 \
  X(61,  "passes wait for each other")                                    \
  X(62,  "read of what nothing writes")                                   \
  X(63,  "present of what nothing writes")                                \
  X(64,  "one sub-resource read and written at once")                     \
  X(65,  "one sub-resource written twice")                                \
  X(66,  "slots that do not fit the pass type")                           \
  X(67,  "key that the pass type does not take")                          \
  X(68,  "key that the pass type needs")                                  \
  X(69,  "unknown draw list")                                             \
  X(70,  "unknown geometry")                                              \
  X(71,  "not a view")                                                    \
  X(72,  "import argument that does not fit")                             \
  X(73,  "import that has nothing")                                       \
  X(74,  "input with nothing behind it")                                  \
  X(75,  "bind that does not fit")                                        \
  X(76,  "result that would add up from frame to frame")                  \
  X(77,  "slices that do not fit")                                        \
  X(78,  "time where there is none")                                      \
  X(79,  "state that does not fit")                                       \
  X(80,  "word where the shader needs a number")                          \
  X(81,  "too many passes")                                               \
  X(82,  "texture that contradicts itself")                               \
  X(84,  "not a pass but a parameter")                                    \
  X(85,  "condition leaves a slot empty")                                 \
  X(86,  "output that cannot be read back")                               \
  X(90,  "culled: output overwritten")                                    \
  X(91,  "culled: output never read")                                     \
  X(92,  "nothing is presented")                                          \
  X(93,  "not a workload file")                                           \
  X(94,  "unknown texture in a workload")                                 \
  X(95,  "unknown format in a workload")                                  \
  X(96,  "duplicate name in a flat graph")                                \
  X(97,  "read before write in a flat graph")                             \
  X(98,  "sub-resource touched twice by one pass")                        \
  X(99,  "use outside its resource")                                      \
  /* shaders and GL */                                                    \
  X(100, "shader file cannot be read")                                    \
  X(101, "included file not found")                                       \
  X(102, "shaders include each other in a cycle")                         \
  X(103, "malformed #include")                                            \
  X(104, "shader does not compile")                                       \
  X(105, "program does not link")                                         \
  X(106, "#version in a shader file")                                     \
  X(110, "no OpenGL context could be opened")                             \
  X(115, "framebuffer is incomplete")                                     \
  X(116, "texture cannot be created")                                     \
  X(117, "buffer cannot be created")                                      \
  X(118, "texture view cannot be created")                                \
  X(120, "message from the OpenGL driver")                                \
  /* assets and scenes */                                                 \
  X(150, "image cannot be read")                                          \
  X(151, "unknown kind of image file")                                    \
  X(152, "image is empty or too large")                                   \
  X(153, "texels were replaced")                                          \
  X(154, "not a .cube table")                                             \
  X(155, "material value out of range")                                   \
  X(156, "duplicate material name")                                       \
  X(160, "scene value out of range")                                      \
  X(161, "unknown material")                                              \
  X(162, "unknown draw list")                                             \
  /* command line, runtime, outputs */                                    \
  X(180, "output cannot be written")                                        \
  X(181, "slot is not in the shader")                                     \
  X(182, "parameter is not in the shader")                              \
  X(183, "slot and shader type do not fit")                               \
  X(184, "parameter and shader type do not fit")                          \
  X(185, "unknown member of the View block")                              \
  X(186, "storage block is no instance table")                            \
  X(187, "shader uses what its pass does not name")                       \
  X(188, "graph presents nothing")                                        \
  X(195, "file changed since it was read")                                \
  X(196, "change that cannot be written back")                          \
  /* limits and what may be opened */                                    \
  X(200, "path outside the confined folders")                            \
  X(201, "limit exceeded")                                               \
  X(202, "textures larger than the memory limit")                        \
  X(203, "shader larger than the driver survives")                       \
  X(204, "shader that the driver did not survive")                       \
  X(205, "files are polled")                                             \
  X(206, "work groups beyond the limit of the device")                   \
  X(207, "picture of values that are no colours")                        \
  X(208, "further messages are left out")
// clang-format on

// A diagnostic code; the numeric value is what follows the W in "W040".
enum class Code : std::uint16_t {
#define WEFT_CODE_ENUM(number, title) W##number = number,
  WEFT_CODES(WEFT_CODE_ENUM)
#undef WEFT_CODE_ENUM
};

// The title of a code as it stands in the table above.
constexpr const char* titleOf(Code code) {
  switch (code) {
#define WEFT_CODE_CASE(number, title) \
  case Code::W##number:               \
    return title;
    WEFT_CODES(WEFT_CODE_CASE)
#undef WEFT_CODE_CASE
  }
  return "";
}

}  // namespace weft::base
