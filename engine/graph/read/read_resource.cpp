// Resources: textures, buffers, imports, inputs, alternatives. Declared in read_context.h.
#include <fmt/format.h>

#include <algorithm>

#include "engine/graph/language/names.h"
#include "engine/graph/read/read_context.h"
#include "engine/graph/read/ref_parse.h"
#include "engine/text/files/file.h"

namespace weft::graph {

namespace {

using text::Code;
using Type = JsonValue::Type;

// A string that is a path, and no expression: of an argument that holds a path, unless it begins with '$', and "photo.png" under
// another key. Whoever knows the arguments says what is wrong with that.
bool isPath(std::string_view key, std::string_view text) {
  constexpr std::string_view kEndings[] = {".png", ".jpg", ".jpeg", ".exr", ".hdr", ".cube",
                                           ".tga", ".bmp", ".gltf", ".glb", ".obj", ".json"};
  if (key == "file" || key.ends_with("_file")) return !text.starts_with('$');
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
    if (value_.is(Type::string) || value_.is(Type::array)) return readAlternatives();
    if (!value_.is(Type::object)) {
      context_.wrongType(value_, fmt::format("the resource '{}'", out_.name),
                         "an object, a reference, or a list of references");
      return std::nullopt;
    }
    std::vector<std::string_view> kinds;
    for (const char* kind : {"texture", "buffer", "import", "input"})
      if (value_.find(kind)) kinds.push_back(kind);
    if (kinds.size() != 1) {
      context_
          .error(kinds.empty() ? Code::missingKey : Code::keysExclude, value_,
                 fmt::format("the resource '{}' {}", out_.name,
                             kinds.empty() ? "does not say what it is" : "is of two kinds at once"))
          .hint = "say one of \"texture\", \"buffer\", \"import\" and \"input\"";
      return std::nullopt;
    }
    if (kinds[0] == "import") return readImport();
    if (kinds[0] == "input") return readInput();
    return kinds[0] == "texture" ? readTexture() : readBuffer();
  }

 private:
  std::optional<ResourceDesc> readAlternatives() {
    out_.kind = ResourceDesc::Kind::alternatives;
    if (value_.is(Type::array) && value_.items.empty())
      context_.wrongType(value_, fmt::format("the resource '{}'", out_.name), "at least one reference");
    for (const JsonValue* item : context_.strings(&value_, fmt::format("the resource '{}'", out_.name)))
      if (std::optional<RefDesc> ref = context_.refOf(*item, "an alternative"))
        out_.alternatives.push_back(*std::move(ref));
    return out_.alternatives.empty() ? std::nullopt : std::optional(std::move(out_));
  }

  std::optional<ResourceDesc> readImport() {
    out_.kind = ResourceDesc::Kind::import;
    out_.import.type = context_.text(value_, "import");
    for (const JsonMember& member : value_.members) {
      if (member.key == "import") continue;
      const bool named = context_.checkName(member.key, member.place, {"an argument"});
      const JsonValue& value = member.value;
      Expr expr = value.is(Type::string) && isPath(member.key, value.text)
                      ? Expr::constant(Value::text(text::besideFile(value.textPlace(), value.text)),
                                       value.textPlace())
                      : context_.expr(value_, member.key);
      if (named && expr.present())
        out_.import.arguments.push_back({member.key, member.place, std::move(expr)});
    }
    return out_.import.type.empty() ? std::nullopt : std::optional(std::move(out_));
  }

  std::optional<ResourceDesc> readInput() {
    out_.kind = ResourceDesc::Kind::input;
    const std::optional<std::string> word = context_.word(value_, "input", kInputWords);
    if (!word) return std::nullopt;
    out_.input = *word;
    out_.optional = context_.flag(value_, "optional");
    readHistory();
    return std::move(out_);
  }

  std::optional<ResourceDesc> readTexture() {
    out_.kind = ResourceDesc::Kind::texture;
    const JsonValue& texture = *value_.find("texture");
    if (!context_.expect(
            texture, Type::string, "\"texture\"",
            texture.is(Type::object) ? "write the format here, and the other keys beside it" : ""))
      return std::nullopt;
    out_.format = texture.text;
    out_.formatPlace = texture.place;
    out_.size = context_.expr(value_, "size");
    readMips();
    out_.layers = context_.expr(value_, "layers");
    out_.array = context_.expr(value_, "array");
    out_.samples = context_.expr(value_, "samples");
    if (const JsonValue* view = value_.find("view")) {
      out_.view = context_.word(value_, "view", kViewWords).value_or("");
      if (out_.view == "2d") out_.view.clear();
      out_.viewPlace = view->place;
    }
    out_.clear = context_.expr(value_, "clear");
    readHistory();
    return out_.format.empty() || !out_.size.present() ? std::nullopt : std::optional(std::move(out_));
  }

  void readMips() {
    const JsonValue* mips = value_.find("mips");
    constexpr std::string_view kAll[] = {"all", "auto", "max", "complete", "true"};  // of other engines
    const bool meant =
        mips && ((mips->is(Type::boolean) && mips->flag) ||
                 (mips->is(Type::string) && std::ranges::find(kAll, mips->text) != std::end(kAll)));
    out_.fullMips = meant || (mips && mips->is(Type::string) && mips->text == "full");
    if (!out_.fullMips) out_.mips = context_.expr(value_, "mips");
    if (!meant) return;
    auto& d = context_.error(Code::wrongValueType, *mips,
                             fmt::format("the number of mips of '{}' is no number", out_.name));
    d.expected = "a number, or \"full\"";
    d.found = describe(*mips);
    d.hint = "write \"full\" for all levels";
  }

  std::optional<ResourceDesc> readBuffer() {
    out_.kind = ResourceDesc::Kind::buffer;
    out_.bytes = context_.expr(value_, "buffer");
    out_.clear = context_.expr(value_, "clear");
    readHistory();
    return out_.bytes.present() ? std::optional(std::move(out_)) : std::nullopt;
  }

  void readHistory() {
    out_.history = context_.expr(value_, "history");
    readFirst(value_.find("first"));
    for (const JsonValue* item : context_.strings(value_.find("reset"), "\"reset\"")) {
      if (!looksLikeRef(item->text)) {
        if (Expr expr = context_.exprOf(*item, "\"reset\""); expr.present())
          out_.resetValues.push_back(std::move(expr));
      } else if (std::optional<RefDesc> ref = context_.refOf(*item, "\"reset\"")) {
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
    if (!first || !first->is(Type::string) || !looksLikeRef(first->text)) {
      out_.first = context_.expr(value_, "first");
      return;
    }
    std::optional<RefDesc> ref = context_.refOf(*first, "\"first\"");
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
  const bool named = context.checkName(member.key, member.place, {"a resource"});
  std::optional<ResourceDesc> resource = ResourceReader(context, member).run();
  context.resource.clear();
  return named ? resource : std::nullopt;
}

}  // namespace weft::graph
