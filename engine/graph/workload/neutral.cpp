#include "engine/graph/workload/neutral.h"

#include <algorithm>
#include <cctype>
#include <memory>

#include "engine/base/nearest.h"
#include "engine/graph/subresource.h"
#include "engine/graph/workload/json_cursor.h"
#include "engine/graph/workload/name_table.h"

namespace weft::graph {

namespace {

using base::Code;

constexpr double kLargest = 65536;

// "RG16F" as "rg16f"; the few spellings of a file are remembered.
class Formats {
 public:
  Format find(std::string_view name) {
    for (const auto& [spelling, format] : known_)
      if (spelling == name) return format;
    std::string lower(name);
    for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const Format format = findFormat(lower).value_or(Format::none);
    if (format != Format::none) known_.emplace_back(name, format);
    return format;
  }

 private:
  std::vector<std::pair<std::string, Format>> known_;
};

class Reader {
 public:
  Reader(std::string_view text, const std::string& path, const NeutralOptions& options,
         base::Diagnostics& diagnostics)
      : text_(text),
        file_(std::make_shared<const std::string>(path)),
        options_(options),
        diagnostics_(diagnostics),
        json_(text),
        textureNames_(graph_.resourceNames) {}

  std::optional<FlatGraph> read() {
    const std::size_t before = diagnostics_.errorCount();
    // More than the text can hold; what is not used costs address space only.
    graph_.resources.reserve(text_.size() / 52 + 1);
    graph_.resourceNames.reserve(text_.size() / 52 + 1);
    graph_.passes.reserve(text_.size() / 40 + 1);
    graph_.passNames.reserve(text_.size() / 40 + 1);
    graph_.uses.reserve(text_.size() / 16 + 1);
    std::size_t passesAt = 0;
    bool texturesRead = false;
    json_.object([&](std::string_view key, std::size_t position) {
      if (key == "textures") {
        json_.array([&] { readTexture(); });
        texturesRead = true;
      } else if (key == "passes" && texturesRead) {
        json_.array([&] { readPass(); });
      } else if (key == "passes") {  // before the textures: read when they are known
        json_.peek();
        passesAt = json_.position();
        json_.skipValue();
      } else {
        report(Code::notAWorkload, position, "unknown key '" + std::string(key) + "' in a workload").hint =
            "known: textures, passes";
        json_.skipValue();
      }
    });
    json_.finish();
    if (passesAt != 0 && !json_.failed()) {
      json_.moveTo(passesAt);
      counted_ = 0, line_ = 1, lineStart_ = 0;
      json_.array([&] { readPass(); });
    }
    if (json_.failed()) report(Code::notAWorkload, json_.position(), "not a workload: " + json_.error());
    if (diagnostics_.errorCount() > before) return std::nullopt;
    graph_.present.resource = kNone;
    return std::move(graph_);
  }

 private:
  base::Diagnostic& report(Code code, std::size_t position, std::string message) {
    if (position < counted_) counted_ = 0, line_ = 1, lineStart_ = 0;
    for (; counted_ < std::min(position, text_.size()); ++counted_)
      if (text_[counted_] == '\n') ++line_, lineStart_ = counted_ + 1;
    return diagnostics_.error(code, {file_, line_, static_cast<std::uint32_t>(position - lineStart_ + 1)},
                              std::move(message));
  }

  std::uint32_t size(std::string_view key) {
    json_.peek();
    const std::size_t position = json_.position();
    const double value = json_.number();
    if (json_.failed()) return 1;
    if (value >= 1 && value <= kLargest && value == static_cast<std::uint32_t>(value))
      return static_cast<std::uint32_t>(value);
    auto& diagnostic =
        report(Code::notAWorkload, position, "a texture's " + std::string(key) + " is out of range");
    diagnostic.expected = "a whole number from 1 to 65536";
    return 1;
  }

  void readTexture() {
    FlatResource r;
    std::size_t formatAt = 0, nameAt = json_.position();
    bool named = false, sized = false;
    std::string& name = graph_.resourceNames.emplace_back();
    std::string format;
    json_.object([&](std::string_view key, std::size_t keyAt) {
      if (key == "name") {
        name = json_.string(nameAt);
        named = true;
      } else if (key == "width") {
        r.width = size("width");
        sized = true;
      } else if (key == "height") {
        r.height = size("height");
      } else if (key == "format") {
        const std::string_view spelled = json_.string(formatAt);
        r.format = formats_.find(spelled);
        if (r.format == Format::none) format = spelled;
      } else {
        report(Code::notAWorkload, keyAt, "unknown key '" + std::string(key) + "' in a texture").hint =
            "known: name, width, height, format";
        json_.skipValue();
      }
    });
    if (json_.failed()) return;
    if (!named || !sized) report(Code::notAWorkload, nameAt, "a texture without name or width");
    if (r.format == Format::none)
      report(Code::unknownWorkloadFormat, formatAt == 0 ? nameAt : formatAt,
             "texture '" + name + "' has unknown format '" + format + "'")
          .hint = base::nearestHint(format, formatNames());
    r.bytes = std::uint64_t{r.width} * r.height * infoOf(r.format).bytes;
    graph_.resources.push_back(r);
    if (!textureNames_.add(static_cast<std::uint32_t>(graph_.resources.size() - 1)))
      report(Code::duplicateFlatName, nameAt, "two textures are named '" + name + "'").resource = name;
  }

  void readUses(Access access, bool compute) {
    json_.array([&] {
      std::size_t position = 0;
      const std::string_view name = json_.string(position);
      if (json_.failed()) return;
      const std::uint32_t r = textureNames_.find(name);
      if (r == kNone) {
        auto& diagnostic =
            report(Code::unknownWorkloadTexture, position, "unknown texture '" + std::string(name) + "'");
        diagnostic.pass = graph_.passNames.back();
        if (graph_.resourceNames.size() <= 2000)
          diagnostic.hint = base::nearestHint(name, graph_.resourceNames);
        return;
      }
      const FormatInfo& format = infoOf(graph_.resources[r].format);
      FlatUse use;
      use.resource = r;
      use.access = access;
      use.keep = access == Access::write;
      use.planes = format.kind == TexelKind::depth_stencil ? 3 : 1;
      const bool depth = format.kind == TexelKind::depth || format.kind == TexelKind::depth_stencil;
      use.kind = compute && format.imageStorable ? Kind::image
                 : access == Access::read        ? Kind::sampled
                 : depth                         ? Kind::depth
                                                 : Kind::color;
      graph_.uses.push_back(use);
    });
  }

  void readPass() {
    FlatPass pass;
    pass.firstUse = static_cast<std::uint32_t>(graph_.uses.size());
    const bool compute = options_.everySecondCompute && graph_.passes.size() % 2 == 1;
    std::size_t nameAt = json_.position();
    graph_.passNames.emplace_back();
    json_.object([&](std::string_view key, std::size_t keyAt) {
      if (key == "name") {
        graph_.passNames.back() = json_.string(nameAt);
      } else if (key == "reads") {
        readUses(Access::read, compute);
      } else if (key == "writes") {
        readUses(Access::write, compute);
      } else if (key == "side_effect") {
        pass.sideEffect = json_.boolean();
      } else {
        report(Code::notAWorkload, keyAt, "unknown key '" + std::string(key) + "' in a pass").hint =
            "known: name, reads, writes, side_effect";
        json_.skipValue();
      }
    });
    if (!json_.failed() && graph_.passNames.back().empty())
      report(Code::notAWorkload, nameAt, "a pass without a name");
    pass.useCount = static_cast<std::uint32_t>(graph_.uses.size()) - pass.firstUse;
    graph_.passes.push_back(pass);
  }

  std::string_view text_;
  std::shared_ptr<const std::string> file_;
  const NeutralOptions options_;
  base::Diagnostics& diagnostics_;
  JsonCursor json_;
  FlatGraph graph_;
  NameTable textureNames_;
  Formats formats_;
  std::size_t counted_ = 0, lineStart_ = 0;
  std::uint32_t line_ = 1;
};

}  // namespace

std::optional<FlatGraph> readNeutral(std::string_view text, const std::string& path,
                                     const NeutralOptions& options, base::Diagnostics& diagnostics) {
  return Reader(text, path, options, diagnostics).read();
}

}  // namespace weft::graph
