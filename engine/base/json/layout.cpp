#include "engine/base/json/layout.h"

#include <algorithm>
#include <span>

#include "engine/base/json/layout_tree.h"

namespace weft::base {

namespace {

using namespace layout;

constexpr int kColumns = 120;
constexpr int kStep = 2;
// Names of one table are padded to the longest, unless that is so much longer than the shortest.
constexpr int kMostPadding = 12;

bool startsBlank(const Item& item) {
  return item.leading.empty() ? item.blankBefore : item.leading.front().blankBefore;
}

bool holdsObjects(const Node& node) {
  return std::ranges::any_of(node.items, [](const Item& item) {
    return item.value.kind == Node::Kind::object && !item.value.items.empty();
  });
}

bool holdsContainers(const Node& node) {
  return std::ranges::any_of(node.items, [](const Item& item) { return item.value.isContainer(); });
}

bool endsLine(const Item& item) {
  return std::ranges::any_of(item.trailing, &Comment::endsLine);
}

bool isOneOf(const std::vector<std::string_view>& names, std::string_view key) {
  return key.size() > 2 && std::ranges::find(names, key.substr(1, key.size() - 2)) != names.end();
}

class Writer {
 public:
  explicit Writer(const LayoutRules& rules) : rules_(rules) {}

  std::string write(const Document& document) {
    for (const Comment& each : document.before) ownLine(each, 0);
    if (document.blankBefore && !document.before.empty()) out_ += '\n';
    value(document.root, {.depth = 0, .indent = 0, .tail = 0, .key = {}});
    newLine();
    for (const Comment& each : document.after) ownLine(each, 0);
    return std::move(out_);
  }

 private:
  // Where a value stands.
  struct Place {
    int depth;             // 0: the document
    int indent;            // column of what is around it
    int tail;              // characters that follow on its last line
    std::string_view key;  // of the member, with its quotes
  };

  // ---- text ----

  int column() const { return widthOf(std::string_view(out_).substr(out_.rfind('\n') + 1)); }

  void newLine() {
    while (!out_.empty() && out_.back() == ' ') out_.pop_back();
    out_ += '\n';
  }

  void newLine(int indent) {
    newLine();
    out_.append(static_cast<std::size_t>(indent), ' ');
  }

  // At the start of a line.
  void ownLine(const Comment& comment, int indent) {
    if (comment.blankBefore && !out_.empty()) newLine();
    out_.append(static_cast<std::size_t>(indent), ' ');
    out_ += comment.text;
    newLine();
  }

  // ---- one line ----

  void flat(const Node& node) {
    if (!node.isContainer()) {
      out_ += node.text;
      return;
    }
    const bool object = node.kind == Node::Kind::object, empty = node.items.empty();
    out_ += object ? '{' : '[';
    if (object && !empty) out_ += ' ';
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      if (i > 0) out_ += ", ";
      flat(node.items[i]);
    }
    if (object && !empty) out_ += ' ';
    out_ += object ? '}' : ']';
  }

  void key(const Item& item) {
    if (!item.key.empty()) (out_ += item.key) += ": ";
  }

  void flat(const Item& item) {
    for (const Comment& each : item.leading) (out_ += each.text) += ' ';
    key(item);
    flat(item.value);
    for (const Comment& each : item.trailing) (out_ += ' ') += each.text;
  }

  // ---- several lines ----

  // A section of the document that holds several entries with keys of their own has a line for each.
  static bool isTable(const Node& node, const Place& place) {
    if (place.depth == 0) return !node.items.empty();
    return place.depth == 1 && node.items.size() > 1 && holdsObjects(node);
  }

  // Blank lines between entries that are more than a few numbers or words.
  static bool isGrouped(const Node& node, const Place& place) {
    if (place.depth > 1 && !holdsContainers(node)) return false;
    return std::any_of(node.items.begin() + (node.items.empty() ? 0 : 1), node.items.end(), startsBlank);
  }

  void value(const Node& node, const Place& place) {
    const bool broken = isTable(node, place) || isGrouped(node, place);
    if (!broken && node.width < kBroken && column() + node.width + place.tail <= kColumns) return flat(node);
    if (!node.isContainer())
      flat(node);
    else if (place.depth <= 1 || node.items.empty())
      block(node, place);
    else if (node.kind == Node::Kind::object && !place.key.empty() && holdsObjects(node))
      openBlock(node, place);
    else
      hanging(node, place);
  }

  // Each entry on a line of its own; the closing bracket too.
  void block(const Node& node, const Place& place) {
    const bool object = node.kind == Node::Kind::object, packs = !object || isOneOf(rules_.packed, place.key);
    const int indent = place.indent + kStep;
    out_ += object ? '{' : '[';
    newLine();
    int pad = 0;
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Item& item = node.items[i];
      const bool last = i + 1 == node.items.size();
      if (i > 0 && packs && mayFollow(node.items[i - 1], item, last)) {
        out_.back() = ' ';  // was the line end
      } else {
        if (startsBlank(item) && i > 0) newLine();
        leadingLines(item, indent, last);
        out_.append(static_cast<std::size_t>(indent), ' ');
      }
      if (place.depth == 1 && !(object && packs) && (i == 0 || startsBlank(item)))
        pad = paddingOf(std::span(node.items).subspan(i));
      entry(item, {.depth = place.depth + 1, .indent = indent, .tail = last ? 0 : 1, .key = item.key}, pad);
      if (movesUp(item, indent, last))
        comma(last);
      else
        trailing(item, last);
      newLine();
    }
    for (const Comment& each : node.dangling) ownLine(each, indent);
    out_.append(static_cast<std::size_t>(place.indent), ' ');
    out_ += object ? '}' : ']';
  }

  // Whether the item goes on the line that was just ended, which holds one like it.
  bool mayFollow(const Item& before, const Item& item, bool last) const {
    const auto isPlain = [](const Item& each) {
      return each.width <= kColumns && !holdsContainers(each.value) && each.value.kind != Node::Kind::object;
    };
    if (!isPlain(before) || !isPlain(item) || endsLine(before) || !item.leading.empty() || startsBlank(item))
      return false;
    const std::size_t end = out_.size() - 1;
    return widthOf(std::string_view(out_).substr(out_.rfind('\n', end - 1) + 1)) - 1 + 1 + item.width +
               (last ? 0 : 1) <=
           kColumns;
  }

  // A comment for which the line of its entry is too short stands in front of it.
  static bool movesUp(const Item& item, int indent, bool last) {
    if (item.trailing.size() != 1 || !item.trailing.back().toLineEnd() || item.value.commented) return false;
    const int entry =
        indent + (item.key.empty() ? 0 : widthOf(item.key) + 2) + item.value.width + (last ? 0 : 1);
    return entry <= kColumns && entry + 1 + widthOf(item.trailing.back().text) > kColumns;
  }

  void leadingLines(const Item& item, int indent, bool last) {
    for (std::size_t i = 0; i < item.leading.size(); ++i) {
      Comment each = item.leading[i];
      if (i == 0) each.blankBefore = false;
      ownLine(each, indent);
    }
    if (item.blankBefore && !item.leading.empty()) newLine();
    if (movesUp(item, indent, last)) ownLine({item.trailing.back().text, false}, indent);
  }

  // The key, padded to a column of the table, and the value.
  void entry(const Item& item, const Place& place, int pad) {
    key(item);
    if (pad > 0 && !item.key.empty())
      out_.append(static_cast<std::size_t>(std::max(pad - widthOf(item.key), 0)), ' ');
    value(item.value, place);
  }

  // The width of the longest key in the rows up to the next blank line, where some values are objects or
  // lists.
  static int paddingOf(std::span<const Item> items) {
    int longest = 0, shortest = kColumns;
    bool table = false;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0 && startsBlank(items[i])) break;
      table = table || items[i].value.isContainer();
      longest = std::max(longest, widthOf(items[i].key));
      shortest = std::min(shortest, widthOf(items[i].key));
    }
    return table && longest - shortest <= kMostPadding ? longest : 0;
  }

  // The first entry behind the bracket, the others below it, as many to a line as there is room for.
  void hanging(const Node& node, const Place& place) {
    const bool object = node.kind == Node::Kind::object;
    const int bracket = column(), indent = bracket + (object ? kStep : 1);
    out_ += object ? "{ " : "[";
    fill(node, {.depth = place.depth, .indent = indent, .tail = place.tail + (object ? 2 : 1), .key = {}},
         place.key.empty() && object ? Fill::stanza : Fill::packed);
    if (!node.dangling.empty() || (!node.items.empty() && endsLine(node.items.back()))) {
      newLine();
      for (const Comment& each : node.dangling) ownLine(each, indent);
      out_.append(static_cast<std::size_t>(bracket), ' ');
    } else if (object) {
      out_ += ' ';
    }
    out_ += object ? '}' : ']';
  }

  // Objects of their own lines below the key; the closing bracket behind the last.
  void openBlock(const Node& node, const Place& place) {
    const int indent = place.indent + kStep;
    out_ += '{';
    newLine(indent);
    fill(node, {.depth = place.depth, .indent = indent, .tail = place.tail + 2, .key = {}}, Fill::rows);
    if (!node.dangling.empty() || endsLine(node.items.back())) {
      newLine();
      for (const Comment& each : node.dangling) ownLine(each, indent);
      out_.append(static_cast<std::size_t>(place.indent), ' ');
    } else {
      out_ += ' ';
    }
    out_ += '}';
  }

  // packed: as many entries to a line as there is room for. stanza: likewise, but with a line end in front of
  // the first object. rows: each object in lines of its own.
  enum class Fill : unsigned char { packed, stanza, rows };

  // Entries in lines that begin at `place.indent`; the first where the text is.
  void fill(const Node& node, const Place& place, Fill how) {
    bool head = how == Fill::stanza, started = how == Fill::rows;
    bool alone = false;  // nothing follows what stands in this line
    const bool grouped = isGrouped(node, place);
    for (std::size_t i = 0; i < node.items.size(); ++i) {
      const Item& item = node.items[i];
      const bool last = i + 1 == node.items.size(), object = item.value.kind == Node::Kind::object;
      const int tail = last ? place.tail : 1;
      const bool fits = item.width < kBroken &&
                        !isGrouped(item.value, {.depth = place.depth + 1, .indent = 0, .tail = 0, .key = {}});
      bool fresh = i == 0;
      if (i > 0) {
        const bool blank = grouped && startsBlank(item);
        const bool ownLines = std::ranges::any_of(item.leading, &Comment::endsLine);
        const bool start = !started && isOneOf(rules_.starts, item.key);
        const bool row = object && (how == Fill::rows || head);
        fresh = alone || blank || ownLines || row || start || !fits ||
                column() + 1 + item.width + tail > kColumns;
        if (blank) newLine();
        if (fresh)
          newLine(place.indent);
        else
          out_ += ' ';
      }
      head = head && !object;
      started = started || isOneOf(rules_.starts, item.key);
      for (const Comment& each : item.leading) {
        out_ += each.text;
        if (each.endsLine())
          newLine(place.indent);
        else
          out_ += ' ';
      }
      const int before = static_cast<int>(out_.size());
      key(item);
      value(item.value, {.depth = place.depth + 1, .indent = place.indent, .tail = tail, .key = item.key});
      const bool lines = std::string_view(out_).substr(static_cast<std::size_t>(before)).find('\n') !=
                         std::string_view::npos;
      trailing(item, last);
      alone = lines || endsLine(item) || (object && how == Fill::rows);
    }
  }

  void comma(bool last) {
    if (!last) out_ += ',';
  }

  // What would swallow the comma stands behind it.
  void trailing(const Item& item, bool last) {
    for (const Comment& each : item.trailing)
      if (!each.toLineEnd()) (out_ += ' ') += each.text;
    comma(last);
    for (const Comment& each : item.trailing)
      if (each.toLineEnd()) (out_ += ' ') += each.text;
  }

  const LayoutRules& rules_;
  std::string out_;
};

}  // namespace

std::string layoutJson(std::string_view text, const LayoutRules& rules) {
  constexpr std::string_view kMark = "\xEF\xBB\xBF";
  const bool marked = text.starts_with(kMark);
  if (marked) text.remove_prefix(kMark.size());
  const std::size_t end = text.find('\n');
  const bool carriage = end != std::string_view::npos && end > 0 && text[end - 1] == '\r';
  std::string plain(text);
  std::erase(plain, '\r');
  const std::string laid = Writer(rules).write(parse(plain));
  std::string out(marked ? kMark : "");
  for (const char c : laid) {
    if (c == '\n' && carriage) out += '\r';
    out += c;
  }
  return out;
}

}  // namespace weft::base
