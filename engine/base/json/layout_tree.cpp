#include "engine/base/json/layout_tree.h"

#include <algorithm>

namespace weft::base::layout {

namespace {

class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text) {}

  Document document() {
    Document out;
    out.before = comments(out.blankBefore);
    out.root = node();
    bool ignored = false;
    out.after = comments(ignored);
    return out;
  }

 private:
  bool atEnd() const { return at_ >= text_.size(); }
  char peek() const { return atEnd() ? '\0' : text_[at_]; }
  bool atComment() const { return peek() == '/'; }

  // Line ends that were passed.
  int skipSpace() {
    int lines = 0;
    for (; !atEnd() && (peek() == ' ' || peek() == '\t' || peek() == '\n' || peek() == '\r'); ++at_)
      lines += peek() == '\n';
    return lines;
  }

  Comment comment() {
    const std::size_t begin = at_;
    const bool line = text_[at_ + 1] == '/';
    at_ = line ? text_.find('\n', at_) : text_.find("*/", at_ + 2) + 2;
    if (line && at_ == std::string_view::npos) at_ = text_.size();
    std::string_view found = text_.substr(begin, at_ - begin);
    while (!found.empty() && (found.back() == ' ' || found.back() == '\t' || found.back() == '\r'))
      found.remove_suffix(1);
    return {found, false};
  }

  // All up to the next token. `blank`: a blank line stands behind the last.
  std::vector<Comment> comments(bool& blank) {
    std::vector<Comment> found;
    int lines = skipSpace();
    while (atComment()) {
      found.push_back(comment());
      found.back().blankBefore = lines > 1;
      lines = skipSpace();
    }
    blank = lines > 1;
    return found;
  }

  std::string_view string() {
    const std::size_t begin = at_++;
    for (; peek() != '"'; ++at_)
      if (peek() == '\\') ++at_;
    return text_.substr(begin, ++at_ - begin);
  }

  Node node() {
    Node out;
    if (peek() == '{' || peek() == '[') {
      out.kind = peek() == '{' ? Node::Kind::object : Node::Kind::array;
      ++at_;
      items(out);
      ++at_;
    } else if (peek() == '"') {
      out.text = string();
    } else {
      const std::size_t begin = at_;
      while (!atEnd() && std::string_view(" \t\r\n,:]}/").find(peek()) == std::string_view::npos) ++at_;
      out.text = text_.substr(begin, at_ - begin);
    }
    measure(out);
    return out;
  }

  void items(Node& out) {
    bool blank = false;
    std::vector<Comment> leading = comments(blank);
    while (peek() != '}' && peek() != ']') {
      Item& item = out.items.emplace_back();
      item.leading = std::move(leading);
      item.blankBefore = blank;
      bool ignored = false;
      const auto belongToKey = [&] {
        for (const Comment& each : comments(ignored)) item.leading.push_back(each);
      };
      if (out.kind == Node::Kind::object) {
        item.key = string();
        belongToKey();
        ++at_;  // the colon
        belongToKey();
      }
      item.value = node();
      leading = behind(item, blank);
    }
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
      if (peek() == ',' && !comma) {
        comma = true;
        ++at_;
        // What stands in front of the comma on lines of its own comes in front of the next item.
        if (next.empty())
          lines = skipSpace();
        else
          lines += skipSpace();
      } else if (atComment()) {
        Comment found = comment();
        const bool ended = !item.trailing.empty() && item.trailing.back().endsLine();
        const bool own = next.empty() && lines == 0 && !ended && (!comma || restIsComments());
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

  // Up to the end of the line.
  bool restIsComments() const {
    for (std::size_t at = at_; at < text_.size();) {
      if (text_[at] == '\n' || text_.compare(at, 2, "//") == 0) return true;
      if (text_[at] != '/' && text_[at] != ' ' && text_[at] != '\t' && text_[at] != '\r') return false;
      at = text_[at] == '/' ? text_.find("*/", at + 2) + 2 : at + 1;
    }
    return true;
  }

  static int add(int a, int b) { return std::min(a + b, kBroken); }

  static int widthOn(const std::vector<Comment>& comments) {
    int width = 0;
    for (const Comment& each : comments)
      width = add(width, each.endsLine() ? kBroken : widthOf(each.text) + 1);
    return width;
  }

  static void measure(Node& node) {
    if (!node.isContainer()) {
      node.width = widthOf(node.text);
      return;
    }
    const bool object = node.kind == Node::Kind::object;
    node.width = node.items.empty() ? 2 : object ? 4 : 2;
    if (!node.dangling.empty()) node.width = kBroken;
    node.commented = !node.dangling.empty() || std::ranges::any_of(node.items, [](const Item& item) {
      return !item.leading.empty() || !item.trailing.empty() || item.value.commented;
    });
    for (Item& item : node.items) {
      const int before = add(widthOn(item.leading), item.key.empty() ? 0 : widthOf(item.key) + 2);
      item.width = add(add(before, item.value.width), widthOn(item.trailing));
      node.width = add(node.width, item.width);
    }
    if (node.items.size() > 1) node.width = add(node.width, 2 * (static_cast<int>(node.items.size()) - 1));
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

int widthOf(std::string_view text) {
  return static_cast<int>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
}

Document parse(std::string_view text) {
  return Parser(text).document();
}

}  // namespace weft::base::layout
