// Declared in edit.h.
#include <algorithm>
#include <span>

#include "engine/text/chars.h"
#include "engine/text/json/dom.h"
#include "engine/text/json/edit.h"

namespace weft::text {

namespace {

constexpr int kColumns = 120;
constexpr int kStep = 2;
// Names of one table are padded to the longest, unless that is so much longer than the shortest.
constexpr int kMaxPadding = 12;
// The member of the document whose numbers and words share lines.
constexpr std::string_view kPacked = "\"set\": ";
// The member of a stanza whose items stand below the other keys.
constexpr std::string_view kGroup = "\"passes\": ";

using Comment = LayoutComment;
using Item = LayoutItem;
using Node = LayoutNode;

bool endsLine(const Item& item) {
  return std::ranges::any_of(item.trailing, &Comment::endsLine);
}

struct Document {
  std::vector<Comment> before, after;
  bool blankBefore = false;  // in front of the value
  Node root;
};

// Characters, not bytes.
int widthOf(std::string_view text) {
  return static_cast<int>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

// Gives each comment to the value that it is about.
class Arranger {
 public:
  explicit Arranger(std::string_view text) : text_(text), tree_(parseJsonTree(text)) {}

  Document run() {
    Document out;
    out.before = comments(&out.blankBefore);
    out.root = node(tree_.root);
    out.after = comments();
    return out;
  }

 private:
  char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }
  bool atComment() const { return tree_.behindComment(at_) != at_; }

  // Line ends that were passed.
  int skipSpace() {
    int lines = 0;
    for (; isSpace(now()); ++at_) lines += now() == '\n';
    return lines;
  }

  Comment comment() {
    const std::size_t begin = at_;
    at_ = tree_.behindComment(at_);
    std::string_view found = text_.substr(begin, at_ - begin);
    while (isSpace(found.back())) found.remove_suffix(1);
    return {found, false};
  }

  // All up to the next token. `blank`: whether a blank line stands behind the last.
  std::vector<Comment> comments(bool* blank = nullptr) {
    std::vector<Comment> found;
    int lines = skipSpace();
    while (atComment()) {
      found.push_back(comment());
      found.back().blankBefore = lines > 1;
      lines = skipSpace();
    }
    if (blank) *blank = lines > 1;
    return found;
  }

  Node node(const JsonValue& value) {
    Node out;
    if (value.is(JsonValue::Type::object) || value.is(JsonValue::Type::array)) {
      out.kind = value.is(JsonValue::Type::object) ? Node::Kind::object : Node::Kind::array;
      at_ = value.begin + 1;
      items(value, out);
    } else {
      out.line = text_.substr(value.begin, value.end - value.begin);
    }
    at_ = value.end;
    return out;
  }

  void items(const JsonValue& value, Node& out) {
    bool blank = false;
    std::vector<Comment> leading = comments(&blank);
    const auto add = [&](const JsonMember* member, const JsonValue& child) {
      Item& item = out.items.emplace_back();
      item.leading = std::move(leading);
      item.blankBefore = blank;
      if (member) {
        item.key = std::string(text_.substr(member->begin, member->end - member->begin)) + ": ";
        for (at_ = member->end; at_ < child.begin; ++at_)  // around the colon
          for (const Comment& each : comments()) item.leading.push_back(each);
      }
      item.value = node(child);
      leading = behind(item, blank);
    };
    for (const JsonMember& member : value.members) add(&member, member.value);
    for (const JsonValue& each : value.items) add(nullptr, each);
    out.dangling = std::move(leading);
    if (out.items.empty()) return;
    Item& first = out.items.front();  // nothing is in front of it
    if (first.leading.empty())
      first.blankBefore = false;
    else
      first.leading.front().blankBefore = false;
  }

  // Comments on the item's last line are its own; those behind it are the next one's, which are returned.
  std::vector<Comment> behind(Item& item, bool& blank) {
    std::vector<Comment> next;
    bool comma = false;
    int lines = skipSpace();
    while (true) {
      if (now() == ',' && !comma) {
        comma = true;
        ++at_;
        // What stands in front of the comma on lines of its own comes in front of the next item.
        lines = (next.empty() ? 0 : lines) + skipSpace();
      } else if (atComment()) {
        const bool ended = !item.trailing.empty() && item.trailing.back().endsLine();
        Comment found = comment();
        const bool own = next.empty() && lines == 0 && !ended && (!comma || found.toLineEnd());
        const int after = skipSpace();
        found.blankBefore = !own && lines > 1;
        (own ? item.trailing : next).push_back(found);
        lines = after;
      } else {
        break;
      }
    }
    blank = lines > 1;
    return next;
  }

  const std::string_view text_;
  const JsonTree tree_;
  std::size_t at_ = 0;
};

// Finds the line of each item and container; "" of one that cannot be on one line.
void measure(Node& node) {
  const bool object = node.kind == Node::Kind::object;
  bool fits = node.dangling.empty();
  std::string line;
  for (Item& item : node.items) {
    measure(item.value);
    item.line.clear();
    if (!item.value.line.empty() && std::ranges::none_of(item.leading, &Comment::endsLine) &&
        !endsLine(item)) {
      for (const Comment& each : item.leading) (item.line += each.text) += ' ';
      item.line += item.key + item.value.line;
      for (const Comment& each : item.trailing) (item.line += ' ') += each.text;
    }
    fits = fits && !item.line.empty();
    if (fits) line += (line.empty() ? "" : ", ") + item.line;
  }
  if (!node.isContainer()) return;
  node.line = !fits                ? ""
              : node.items.empty() ? object ? "{}" : "[]"
              : object             ? "{ " + line + " }"
                                   : "[" + line + "]";
}

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

// The first of these in an object of several lines begins a line.
bool starts(const Item& item) {
  return item.key == "\"read\": " || item.key == "\"write\": " || item.key == "\"modify\": ";
}

class Writer {
 public:
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
    std::string_view key;  // of the member, as that of an item
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
    if (!node.isContainer() ||
        (!broken && !node.line.empty() && column() + widthOf(node.line) + place.tail <= kColumns))
      out_ += node.line;
    else if (place.depth <= 1 || node.items.empty())
      block(node, place);
    else
      hanging(node, place,
              !place.key.empty() && (place.key == kGroup || node.kind == Node::Kind::object) &&
                  holdsObjects(node));
  }

  // Each entry on a line of its own; the closing bracket too.
  void block(const Node& node, const Place& place) {
    const bool object = node.kind == Node::Kind::object, packs = !object || place.key == kPacked;
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
        for (const Comment& each : item.leading) ownLine(each, indent);
        if (item.blankBefore) newLine();
        out_.append(static_cast<std::size_t>(indent), ' ');
      }
      if (place.depth == 1 && !(object && packs) && (i == 0 || startsBlank(item)))
        pad = paddingOf(std::span(node.items).subspan(i));
      out_ += item.key;
      if (!item.key.empty()) out_.append(static_cast<std::size_t>(std::max(pad - widthOf(item.key), 0)), ' ');
      value(item.value, {.depth = place.depth + 1, .indent = indent, .tail = last ? 0 : 1, .key = item.key});
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
      return !each.line.empty() && !holdsContainers(each.value) && each.value.kind != Node::Kind::object;
    };
    if (!isPlain(before) || !isPlain(item) || endsLine(before) || !item.leading.empty() || startsBlank(item))
      return false;
    const std::size_t end = out_.size() - 1;  // the line end, where a blank would be
    return widthOf(std::string_view(out_).substr(out_.rfind('\n', end - 1) + 1)) + widthOf(item.line) +
               (last ? 0 : 1) <=
           kColumns;
  }

  // The width of the longest key in the rows up to the next blank line, where some values are objects or lists.
  static int paddingOf(std::span<const Item> items) {
    int longest = 0, shortest = kColumns;
    bool table = false;
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0 && startsBlank(items[i])) break;
      table = table || items[i].value.isContainer();
      longest = std::max(longest, widthOf(items[i].key));
      shortest = std::min(shortest, widthOf(items[i].key));
    }
    return table && longest - shortest <= kMaxPadding ? longest : 0;
  }

  // The first entry behind the bracket, the others below it, as many to a line as there is room for. Objects of `rows` have lines
  // of their own below the key, and the closing bracket behind the last.
  void hanging(const Node& node, const Place& place, bool rows) {
    const bool object = node.kind == Node::Kind::object;
    const bool isGroup = std::ranges::find(node.items, kGroup, &Item::key) != node.items.end();
    const int bracket = rows ? place.indent : column(), indent = bracket + (object ? kStep : rows ? 0 : 1);
    out_ += !object ? "[" : rows ? "{" : "{ ";
    if (rows) newLine(indent);
    fill(node, {.depth = place.depth, .indent = indent, .tail = place.tail + (object ? 2 : 1), .key = {}},
         rows                                      ? Fill::rows
         : place.key.empty() && object && !isGroup ? Fill::stanza
                                                   : Fill::packed);
    if (!node.dangling.empty() || (!node.items.empty() && endsLine(node.items.back()))) {
      newLine();
      for (const Comment& each : node.dangling) ownLine(each, indent);
      out_.append(static_cast<std::size_t>(bracket), ' ');
    } else if (object) {
      out_ += ' ';
    }
    out_ += object ? '}' : ']';
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
      const bool fits = !item.line.empty() &&
                        !isGrouped(item.value, {.depth = place.depth + 1, .indent = 0, .tail = 0, .key = {}});
      bool fresh = i == 0;
      if (i > 0) {
        const bool blank = grouped && startsBlank(item);
        const bool ownLines = std::ranges::any_of(item.leading, &Comment::endsLine);
        const bool start = !started && starts(item);
        const bool row = object && (how == Fill::rows || (head && !started));
        fresh = alone || blank || ownLines || row || start ||
                (item.key != kGroup && (!fits || column() + 1 + widthOf(item.line) + tail > kColumns));
        if (blank) newLine();
        if (fresh)
          newLine(place.indent);
        else
          out_ += ' ';
      }
      head = head && !object;
      started = started || starts(item);
      for (const Comment& each : item.leading) {
        out_ += each.text;
        if (each.endsLine())
          newLine(place.indent);
        else
          out_ += ' ';
      }
      const int before = static_cast<int>(out_.size());
      out_ += item.key;
      value(item.value, {.depth = place.depth + 1, .indent = place.indent, .tail = tail, .key = item.key});
      const bool lines = std::string_view(out_).substr(static_cast<std::size_t>(before)).find('\n') !=
                         std::string_view::npos;
      trailing(item, last);
      alone = lines || endsLine(item) || (object && how == Fill::rows);
    }
  }

  // What would swallow the comma stands behind it.
  void trailing(const Item& item, bool last) {
    for (const Comment& each : item.trailing)
      if (!each.toLineEnd()) (out_ += ' ') += each.text;
    if (!last) out_ += ',';
    for (const Comment& each : item.trailing)
      if (each.toLineEnd()) (out_ += ' ') += each.text;
  }

  std::string out_;
};

}  // namespace

LayoutItem* LayoutNode::find(std::string_view key) {
  const auto found = kind == Kind::object ? std::ranges::find(items, key, &LayoutItem::name) : items.end();
  return found == items.end() ? nullptr : &*found;
}

std::string layoutJson(std::string_view text, const std::function<void(LayoutNode& root)>& change) {
  const bool marked = text.starts_with(kByteOrderMark);
  if (marked) text.remove_prefix(kByteOrderMark.size());
  const std::size_t end = text.find('\n');
  const bool carriage = end != std::string_view::npos && end > 0 && text[end - 1] == '\r';
  std::string plain(text);
  std::erase(plain, '\r');
  Document document = Arranger(plain).run();
  if (change) change(document.root);
  measure(document.root);
  const std::string laid = Writer().write(document);
  std::string out(marked ? kByteOrderMark : "");
  for (const char c : laid) {
    if (c == '\n' && carriage) out += '\r';
    out += c;
  }
  return out;
}

}  // namespace weft::text
