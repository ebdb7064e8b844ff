#include "engine/assets/models/assimp/model_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstring>
#include <map>
#include <unordered_map>
#include <vector>

#include "engine/text/chars.h"

namespace weft::assets {

namespace {

constexpr std::size_t kDeepest = 64;

template <class T>
T load(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

// A circle among edges from child to parent. Kahn, 1962: what is left when everything without a parent was taken away lies on
// circles or below them.
bool hasCircle(const std::vector<std::pair<std::int64_t, std::int64_t>>& edges) {
  struct Node {
    std::size_t parents = 0;
    std::vector<std::int64_t> children;
  };
  std::unordered_map<std::int64_t, Node> nodes;
  for (const auto& [child, parent] : edges) {
    ++nodes[child].parents;
    nodes[parent].children.push_back(child);
  }
  std::vector<std::int64_t> taken;
  for (const auto& [id, node] : nodes)
    if (node.parents == 0) taken.push_back(id);
  for (std::size_t i = 0; i < taken.size(); ++i)
    for (const std::int64_t child : nodes[taken[i]].children)
      if (--nodes[child].parents == 0) taken.push_back(child);
  return taken.size() != nodes.size();
}

ModelProblem circleProblem() {
  return {"a node of it is its own ancestor", "connections that form trees", "a circle of them"};
}

}  // namespace

bool isBinaryFbx(std::string_view bytes) {
  return bytes.starts_with("Kaydara FBX Binary");
}

namespace {

// The binary form as Blender's developers wrote it down: records of end, number of properties, their bytes, name; then
// properties, then records within.
class FbxWalk {
 public:
  FbxWalk(std::string_view bytes, std::uint64_t& unpacked) : bytes_(bytes), unpacked_(unpacked) {}

  ModelProblem check() {
    if (bytes_.size() < 27)
      return {"the file ends early", "27 bytes at least", fmt::format("{} bytes", bytes_.size())};
    const bool wide = load<std::uint32_t>(bytes_, 23) >= 7500;
    word_ = wide ? 8 : 4;
    std::vector<std::size_t> ends{bytes_.size()};  // of the records that are open
    std::size_t at = 27;
    while (true) {
      while (ends.size() > 1 && at >= ends.back()) {
        if (at > ends.back()) return strays(at);
        ends.pop_back();
      }
      if (at + 3 * word_ + 1 > ends.back()) {
        if (ends.size() == 1) break;
        return strays(at);
      }
      const std::uint64_t end = word(at), properties = word(at + word_), length = word(at + 2 * word_);
      const std::size_t nameBytes = static_cast<unsigned char>(bytes_[at + 3 * word_]);
      const std::size_t start = at + 3 * word_ + 1 + nameBytes;
      if (end == 0) {  // ends a list
        if (ends.size() == 1) break;
        at += 3 * word_ + 1;
        if (at != ends.back()) return strays(at);
        continue;
      }
      if (end <= at || end > ends.back() || start > end || length > end - start) return strays(at);
      const std::string_view name = bytes_.substr(start - nameBytes, nameBytes);
      if (!checkProperties(start, start + length, properties, name)) return strays(at);
      at = start + length;
      ends.push_back(end);
      if (ends.size() > kDeepest)
        return {"its records nest too deeply", fmt::format("at most {} levels", kDeepest), "more", 0};
    }
    return hasCircle(edges_) ? circleProblem() : ModelProblem{};
  }

 private:
  std::uint64_t word(std::size_t at) const {
    return word_ == 8 ? load<std::uint64_t>(bytes_, at) : load<std::uint32_t>(bytes_, at);
  }
  static ModelProblem strays(std::size_t at) {
    return {"a record of it reaches beyond what it stands in", "records inside each other",
            fmt::format("one at byte {}", at), 0};
  }

  bool checkProperties(std::size_t at, std::size_t end, std::uint64_t count, std::string_view name) {
    std::vector<std::int64_t> ids;
    for (std::uint64_t i = 0; i < count; ++i) {
      if (at >= end) return false;
      const char kind = bytes_[at++];
      // Bytes of a value, of a text after its length, and of each element of a packed array.
      static const std::map<char, std::size_t> kPlain = {{'C', 1}, {'B', 1}, {'Y', 2}, {'I', 4},
                                                         {'F', 4}, {'D', 8}, {'L', 8}},
                                               kPacked = {{'b', 1}, {'c', 1}, {'f', 4},
                                                          {'i', 4}, {'d', 8}, {'l', 8}};
      std::size_t size = 0, packed = 0;
      if (const auto plain = kPlain.find(kind); plain != kPlain.end()) {
        size = plain->second;
      } else if (kind == 'S' || kind == 'R') {
        if (end - at < 4) return false;
        size = std::size_t{4} + load<std::uint32_t>(bytes_, at);
      } else if (const auto array = kPacked.find(kind); array != kPacked.end()) {
        packed = array->second;
      } else {
        return false;
      }
      if (packed != 0) {
        if (end - at < 12) return false;
        const std::uint64_t elements = load<std::uint32_t>(bytes_, at);
        const std::uint32_t encoding = load<std::uint32_t>(bytes_, at + 4);
        size = std::size_t{12} + load<std::uint32_t>(bytes_, at + 8);
        // zlib packs 1032 to 1 at most; an array that says more is none.
        if (encoding > 1 || elements * packed > (encoding == 0 ? size - 12 : (size - 12) * 1040))
          return false;
        unpacked_ += elements * packed;
      }
      if (size > end - at) return false;
      if (kind == 'L' && name == "C") ids.push_back(load<std::int64_t>(bytes_, at));
      at += size;
    }
    if (ids.size() == 2) edges_.emplace_back(ids[0], ids[1]);
    return at == end;
  }

  std::string_view bytes_;
  std::uint64_t& unpacked_;
  std::size_t word_ = 4;
  std::vector<std::pair<std::int64_t, std::int64_t>> edges_;
};

// C: "OO",child,parent
ModelProblem checkTextFbx(std::string_view bytes) {
  std::vector<std::pair<std::int64_t, std::int64_t>> edges;
  std::size_t depth = 0;
  std::uint32_t number = 0;
  while (!bytes.empty()) {
    std::string_view line = text::takeLine(bytes);
    ++number;
    bool quoted = false;
    for (const char c : line) {
      if (c == ';' && !quoted) break;
      if (c == '"') quoted = !quoted;
      if (quoted) continue;
      if (c == '{' && ++depth > kDeepest)
        return {"its records nest too deeply", fmt::format("at most {} levels", kDeepest), "more", number};
      if (c == '}' && depth > 0) --depth;
    }
    if (text::takeWord(line) != "C:") continue;
    const std::size_t first = line.find(','),
                      second = first == std::string_view::npos ? first : line.find(',', first + 1);
    if (second == std::string_view::npos) continue;
    std::int64_t child = 0, parent = 0;
    const auto read = [&](std::size_t from, std::int64_t& out) {
      while (from < line.size() && line[from] == ' ') ++from;
      std::from_chars(line.data() + from, line.data() + line.size(), out);
    };
    read(first + 1, child);
    read(second + 1, parent);
    edges.emplace_back(child, parent);
  }
  return hasCircle(edges) ? circleProblem() : ModelProblem{};
}

}  // namespace

ModelProblem checkFbx(std::string_view bytes, std::uint64_t& unpacked) {
  return isBinaryFbx(bytes) ? FbxWalk(bytes, unpacked).check() : checkTextFbx(bytes);
}

}  // namespace weft::assets
