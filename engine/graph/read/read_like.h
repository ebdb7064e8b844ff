// `"like": "other"` in a pass: gives it all keys of a pass above it in the same file, with its own laid over them as
// an overlay would. A parameter that the other pass declares is shared by both. Does not: read passes.
#pragma once

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/graph/read/read_context.h"

namespace weft::graph {

// The passes of one file.
class LikePasses {
 public:
  // `stanzas` and the context outlive it.
  LikePasses(ReadContext& context, const std::vector<JsonValue>& stanzas)
      : context_(context), stanzas_(stanzas) {}

  // The stanza of this index as if it were written out: itself without "like", null after a report. Indices
  // ascend.
  const JsonValue* at(std::size_t index);
  // Values of all stanzas that were written out so far.
  std::uint64_t values() const { return values_; }

 private:
  const JsonValue* find(const JsonValue& stanza, const JsonValue& like, std::size_t index);

  ReadContext& context_;
  const std::vector<JsonValue>& stanzas_;
  std::deque<JsonValue> made_;
  std::unordered_map<std::string_view, const JsonValue*> above_;  // passes, written out, by name
  std::size_t known_ = 0;                                         // stanzas that were looked at for `above_`
  std::uint64_t values_ = 0;
};

}  // namespace weft::graph
