// Resources: textures, buffers, imports, inputs, alternatives. Declared in read_context.h.
#include <fmt/format.h>

#include <algorithm>

#include "engine/base/files/file.h"
#include "engine/base/nearest.h"
#include "engine/graph/language/names.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/ref_parse.h"

namespace weft::graph {

namespace {

using base::Code;

// Import arguments that hold a path; a string there is no expression unless it begins with '$'.
bool isPathArgument(std::string_view key) {
  return key == "file" || (key.size() > 5 && key.substr(key.size() - 5) == "_file");
}

// "photo.png" under another key is meant as a path, and no expression. Whoever knows the arguments says so.
bool looksLikePath(std::string_view text) {
  constexpr std::string_view kEndings[] = {".png", ".jpg", ".jpeg", ".exr", ".hdr", ".cube",
                                           ".tga", ".bmp", ".gltf", ".glb", ".obj", ".json"};
  return text.find('$') == std::string_view::npos &&
         std::ranges::any_of(kEndings, [&](std::string_view ending) { return text.ends_with(ending); });
}

class ResourceReader {
 public:
  ResourceReader(ReadContext& context, const JsonMember& member) : context_(context), value_(member.value) {
    out_.name = member.key;
    out_.place = member.place;
  }

  std::optional<ResourceDesc> run() {
    if (value_.is(JsonValue::Type::string) || value_.is(JsonValue::Type::array)) return readAlternatives();
    if (!value_.is(JsonValue::Type::object)) {
      auto& d = context_.error(Code::wrongType, value_,
                               fmt::format("the resource '{}' has the wrong type", out_.name));
      d.expected = "an object, a reference, or a list of references";
      d.found = describe(value_);
      return std::nullopt;
    }
    const JsonValue* texture = value_.find("texture");
    const JsonValue* buffer = value_.find("buffer");
    const JsonValue* import = value_.find("import");
    const JsonValue* input = value_.find("input");
    if (import) return readImport(*import);
    if (int(texture != nullptr) + int(buffer != nullptr) + int(input != nullptr) > 1) {
      auto& d = context_.error(Code::keysExclude, value_,
                               fmt::format("the resource '{}' is of two kinds at once", out_.name));
      d.hint = "keep one of \"texture\", \"buffer\", \"import\" and \"input\"";
      return std::nullopt;
    }
    if (texture && texture->is(JsonValue::Type::string) && looksLikePath(texture->text))
      return reportPicture(*texture);
    if (texture && texture->is(JsonValue::Type::object)) return reportObject(*texture, "texture");
    if (texture) return readTexture(*texture);
    if (buffer && buffer->is(JsonValue::Type::object)) return reportObject(*buffer, "buffer");
    if (buffer) return readBuffer(*buffer);
    if (input) return readInput(*input);
    return reportKind();
  }

 private:
  std::optional<ResourceDesc> reportPicture(const JsonValue& texture) {
    context_
        .error(Code::unknownFormat, texture,
               fmt::format("texture '{}' has a file in the place of a format", out_.name))
        .hint = fmt::format("a picture is an import: \"{}\": {{ \"import\": \"image\", \"file\": \"{}\" }}",
                            out_.name, texture.text);
    return std::nullopt;
  }

  // The keys of other engines that say inside what stands beside here.
  std::optional<ResourceDesc> reportObject(const JsonValue& inside, std::string_view key) {
    auto& d = context_.error(Code::wrongType, inside, fmt::format("\"{}\" has the wrong type", key));
    d.expected =
        key == "texture" ? "a format in a string" : "a number of bytes, or an expression in a string";
    d.found = "an object";
    for (const JsonMember& member : inside.members)
      if (key == "texture" && member.value.is(JsonValue::Type::string) && member.key == "format")
        d.hint = fmt::format("write \"texture\": \"{}\", and the other keys beside it", member.value.text);
      else if (key == "buffer" && member.value.is(JsonValue::Type::number))
        d.hint = fmt::format("write \"buffer\": {}, and the other keys beside it", member.value.number);
    return std::nullopt;
  }

  // Code::wrongValueType for words and switches that other engines take in the place of "full".
  bool isMeantAsFull(const JsonValue& mips) {
    const bool on = mips.is(JsonValue::Type::boolean) && mips.flag;
    const bool word = mips.is(JsonValue::Type::string) &&
                      (mips.text == "all" || mips.text == "auto" || mips.text == "max" ||
                       mips.text == "complete" || mips.text == "true");
    if (!on && !word) return false;
    auto& d = context_.error(Code::wrongValueType, mips,
                             fmt::format("the number of mips of '{}' is no number", out_.name));
    d.expected = "a number, or \"full\"";
    d.found = on ? "true" : mips.text;
    d.hint = "write \"full\" for all levels";
    return true;
  }

  std::optional<ResourceDesc> reportKind() {
    const std::vector<std::string> kinds = {"texture", "buffer", "import", "input"};
    for (const JsonMember& member : value_.members) {
      const std::string nearest = base::nearestName(member.key, kinds);
      if (nearest.empty()) continue;
      context_
          .errorAt(Code::unknownKey, member.place,
                   fmt::format("unknown key \"{}\" in the resource '{}'", member.key, out_.name))
          .hint = fmt::format("did you mean \"{}\"?", nearest);
      return std::nullopt;
    }
    context_
        .error(Code::missingKey, value_, fmt::format("the resource '{}' does not say what it is", out_.name))
        .hint = "add \"texture\", \"buffer\", \"import\" or \"input\"";
    return std::nullopt;
  }

  std::optional<ResourceDesc> readAlternatives() {
    out_.kind = ResourceDesc::Kind::alternatives;
    if (value_.is(JsonValue::Type::array) && value_.items.empty()) {
      context_.error(Code::wrongType, value_, fmt::format("the alternatives of '{}' are empty", out_.name))
          .expected = "at least one reference";
      return std::nullopt;
    }
    for (const JsonValue* item : context_.strings(&value_, fmt::format("the resource '{}'", out_.name)))
      if (std::optional<RefDesc> ref = context_.ref(item, "an alternative"))
        out_.alternatives.push_back(*std::move(ref));
    return out_.alternatives.empty() ? std::nullopt : std::optional(std::move(out_));
  }

  std::optional<ResourceDesc> readImport(const JsonValue& import) {
    out_.kind = ResourceDesc::Kind::import;
    for (const char* other : {"texture", "buffer", "input"})
      if (value_.find(other)) {
        context_
            .error(Code::keysExclude, value_,
                   fmt::format("the resource '{}' is of two kinds at once", out_.name))
            .hint = "keep one of \"texture\", \"buffer\", \"import\" and \"input\"";
        return std::nullopt;
      }
    out_.import.type = context_.text(&import, "\"import\"");
    for (const JsonMember& member : value_.members) {
      if (member.key == "import") continue;
      const bool named = context_.checkName(member.key, member.place, "an argument");
      const JsonValue& value = member.value;
      const bool path = value.is(JsonValue::Type::string) && value.text.substr(0, 1) != "$" &&
                        (isPathArgument(member.key) || looksLikePath(value.text));
      Expr expr = path ? Expr::constant(Value::text(base::besideFile(value.textPlace(), value.text)),
                                        value.textPlace())
                       : context_.expr(&value, fmt::format("\"{}\"", member.key));
      if (named && expr.present())
        out_.import.arguments.push_back({member.key, member.place, std::move(expr)});
    }
    return out_.import.type.empty() ? std::nullopt : std::optional(std::move(out_));
  }

  std::optional<ResourceDesc> readInput(const JsonValue& input) {
    out_.kind = ResourceDesc::Kind::input;
    context_.checkKeys(value_, kInputKeys, fmt::format("the input '{}'", out_.name));
    const std::optional<std::string> word = context_.word(&input, kInputWords, "\"input\"");
    if (!word) return std::nullopt;
    out_.input = *word;
    out_.optional = context_.flag(value_.find("optional"), "\"optional\"");
    readHistory();
    return std::move(out_);
  }

  std::optional<ResourceDesc> readTexture(const JsonValue& texture) {
    out_.kind = ResourceDesc::Kind::texture;
    context_.checkKeys(value_, kTextureKeys, fmt::format("the texture '{}'", out_.name),
                       base::Foreign::texture_key);
    out_.format = context_.text(&texture, "\"texture\"");
    out_.formatPlace = texture.place;
    out_.size = context_.expr(value_.find("size"), "\"size\"");
    const JsonValue* mips = value_.find("mips");
    if (mips && ((mips->is(JsonValue::Type::string) && mips->text == "full") || isMeantAsFull(*mips)))
      out_.fullMips = true;
    else
      out_.mips = context_.expr(mips, "\"mips\"");
    out_.layers = context_.expr(value_.find("layers"), "\"layers\"");
    out_.array = context_.expr(value_.find("array"), "\"array\"");
    out_.samples = context_.expr(value_.find("samples"), "\"samples\"");
    if (const JsonValue* view = value_.find("view")) {
      out_.view = context_.word(view, kViewWords, "\"view\"").value_or("");
      if (out_.view == "2d") out_.view.clear();
      out_.viewPlace = view->place;
    }
    readVersions();
    return out_.format.empty() || !out_.size.present() ? std::nullopt : std::optional(std::move(out_));
  }

  std::optional<ResourceDesc> readBuffer(const JsonValue& buffer) {
    out_.kind = ResourceDesc::Kind::buffer;
    context_.checkKeys(value_, kBufferKeys, fmt::format("the buffer '{}'", out_.name));
    out_.bytes = context_.expr(&buffer, "\"buffer\"");
    readVersions();
    return out_.bytes.present() ? std::optional(std::move(out_)) : std::nullopt;
  }

  // Version zero and history, alike for textures and buffers.
  void readVersions() {
    out_.clear = context_.expr(value_.find("clear"), "\"clear\"");
    readHistory();
  }

  void readHistory() {
    out_.history = context_.expr(value_.find("history"), "\"history\"");
    readFirst(value_.find("first"));
    for (const JsonValue* item : context_.strings(value_.find("reset"), "\"reset\"")) {
      if (!looksLikeRef(item->text)) {
        if (Expr expr = context_.expr(item, "\"reset\""); expr.present())
          out_.resetValues.push_back(std::move(expr));
      } else if (std::optional<RefDesc> ref = context_.ref(item, "\"reset\"")) {
        out_.resetRefs.push_back(*std::move(ref));
      }
    }
    for (const char* key : {"first", "reset"})
      if (const JsonValue* value = value_.find(key); value && !value_.find("history")) {
        context_
            .error(Code::keysExclude, *value,
                   fmt::format("\"{}\" of '{}', which keeps no history", key, out_.name))
            .hint = "add \"history\": 1, or remove the key";
        out_.history =
            Expr::constant(Value::number(1), value->place);  // what reads it has no mistake of its own
      }
  }

  // A value, or what to read in its place.
  void readFirst(const JsonValue* first) {
    if (!first || !first->is(JsonValue::Type::string) || !looksLikeRef(first->text)) {
      out_.first = context_.expr(first, "\"first\"");
      return;
    }
    std::optional<RefDesc> ref = context_.ref(first, "\"first\"");
    if (!ref) return;
    const bool words = ref->kind || ref->sampler != Sampler{};
    if (!words && ref->history == 0) {
      out_.firstRef = *std::move(ref);
      return;
    }
    auto& d = context_.error(Code::badReference, *first,
                             fmt::format("\"first\" of '{}' says {}", out_.name,
                                         words ? "how it is read" : "of which frame it is"));
    d.found = fmt::format("\"{}\"", ref->text);
    d.hint = words ? "leave out the words after 'as': it is read as the slot that reads the history says"
                   : "leave out '@-n': it is read as it is when a frame has no history";
  }

  ReadContext& context_;
  const JsonValue& value_;
  ResourceDesc out_;
};

}  // namespace

std::optional<ResourceDesc> readResource(ReadContext& context, const JsonMember& member) {
  context.resource = member.key;
  const bool named = context.checkName(member.key, member.place, "a resource");
  std::optional<ResourceDesc> resource = ResourceReader(context, member).run();
  context.resource.clear();
  return named ? resource : std::nullopt;
}

}  // namespace weft::graph
