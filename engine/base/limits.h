// The limits that keep a hostile or mistaken file from filling the memory, the stack or the time of this process: one
// table of names and defaults. A limit belongs to the process, like its stack size: it is set before anything is read
// (`--limit NAME=VALUE` of the weft command) and never changes after that. docs/limits.md has a row for each, with the
// message and the test that holds it. Does not hold limits of a format (16 levels, 8 attachments) or of a device.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::base {

// X(name, default, what is counted)
// clang-format off
#define WEFT_LIMITS(X)                                                                          \
  X(include_files,       1000,          "files that one graph includes, each use counted")      \
  X(include_depth,       64,            "files that include each other in a row")               \
  X(extends_depth,       64,            "overlays that extend each other in a row")             \
  X(json_bytes,          32ull << 20,   "bytes of one JSON or .cube file")                      \
  X(json_values,         1500000,       "values of all JSON files of one graph, each use counted") \
  X(name_bytes,          255,           "bytes of one name or key")                             \
  X(texture_bytes,       4ull << 30,    "bytes of all textures and buffers of one plan")        \
  X(diagnostics,         100,           "messages that are printed")                            \
  X(shader_bytes,        1ull << 20,    "bytes of one shader with what it includes")            \
  X(shader_tokens,       200000,        "tokens of one shader after its macros")                \
  X(shader_depth,        500,           "brackets, operators or blocks around one another")     \
  X(shader_seconds,      5,             "seconds of processor time to try unusual shaders")       \
  X(shader_memory,       1ull << 30,    "bytes that a program takes to compile")                \
  X(program_cache_bytes, 256ull << 20,  "bytes of the folder of program binaries")              \
  X(model_bytes,         512ull << 20,  "bytes of all files of one model, and of what is packed in them") \
  X(model_text_bytes,    24ull << 20,   "bytes of one OBJ or text FBX file")                    \
  X(model_vertices,      8ull << 20,    "vertices of one model, and a third of its corners")    \
  X(model_texels,        64ull << 20,   "texels of all textures of one model")                  \
  X(frames,              1000000,       "frames of one command")
// clang-format on

enum class Limit : std::uint8_t {
#define WEFT_LIMIT_ENUM(name, value, what) name,
  WEFT_LIMITS(WEFT_LIMIT_ENUM)
#undef WEFT_LIMIT_ENUM
};

struct LimitInfo {
  Limit limit;
  std::string_view name;
  std::uint64_t initial;  // what it is unless set
  std::string_view counts;
};
// In the order of the table.
const std::vector<LimitInfo>& allLimits();

std::uint64_t limitOf(Limit limit);
std::string_view nameOf(Limit limit);

// The greatest value that a limit may have. Limits on depth end where the stack of the process would.
std::uint64_t mostOf(Limit limit);

// Sets one limit by name; from 1 to mostOf(). The value is a whole number, or one with the suffix K, M or G (of 1024).
// Returns what is wrong, as a sentence for the person who wrote it, or nothing.
std::optional<std::string> setLimit(std::string_view name, std::string_view value);

// "raise it with --limit include_files=2000": the fix of a message about a limit. Names twice the present value, at most
// mostOf(), and never less than `needed` where that is known.
std::string hintToRaise(Limit limit, std::uint64_t needed = 0);

// A bound as it is now: times what `--limit N` said, 1 unless set before anything is read.
std::uint64_t raised(std::uint64_t bound);
// Up to kMostRaise.
void raiseLimits(std::uint64_t times);
constexpr std::uint64_t kMostRaise = 64;
// "raise the limits with --limit 2, if that is meant": at least so that `needed` is allowed. "" when that cannot be.
std::string hintToRaise(std::uint64_t bound, std::uint64_t needed = 0);

}  // namespace weft::base
