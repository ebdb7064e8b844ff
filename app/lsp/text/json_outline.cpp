#include "app/lsp/text/json_outline.h"

#include <algorithm>
#include <utility>

#include "engine/base/chars.h"

namespace weft::app::lsp {

namespace {

constexpr int kMostNesting = 200;

}  // namespace

const Node* Node::find(std::string_view wanted) const {
  if (type != Type::object) return nullptr;
  for (const auto& child : children)
    if (child->key == wanted) return child.get();
  return nullptr;
}

std::string_view Node::textOf(std::string_view wanted) const {
  const Node* const child = find(wanted);
  return child && child->type == Type::string ? child->text : std::string_view();
}

Range Node::inside() const {
  if (type != Type::string) return range;
  return {range.begin + 1, range.begin + 1 + text.size()};
}

class JsonOutline::Parser {
 public:
  Parser(std::string_view text, std::vector<Range>& comments) : text_(text), comments_(comments) {
    if (text.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  std::unique_ptr<Node> run() {
    blank();
    auto root = value(nullptr, 0);
    if (root->type == Node::Type::absent) root->range = {0, text_.size()};
    return root;
  }

 private:
  bool ends() const { return at_ >= text_.size(); }
  char now() const { return ends() ? '\0' : text_[at_]; }

  void blank() {
    while (!ends()) {
      if (base::isSpace(now())) {
        ++at_;
      } else if (text_.substr(at_, 2) == "//" || text_.substr(at_, 2) == "/*") {
        const bool line = text_[at_ + 1] == '/';
        const std::size_t begin = at_;
        std::size_t found = text_.find(line ? "\n" : "*/", at_ + 2);
        // A comment that is never closed ends with its line: somebody is typing it, and the lines below still count.
        const bool closed = !line && found != std::string_view::npos;
        if (!line && !closed) found = text_.find('\n', at_ + 2);
        at_ = found == std::string_view::npos ? text_.size() : found + (closed ? 2 : 0);
        comments_.push_back({begin, at_});
      } else {
        return;
      }
    }
  }

  // A string ends with its line at the latest.
  void string(Node& node) {
    node.type = Node::Type::string;
    node.range.begin = at_++;
    const std::size_t begin = at_;
    while (!ends() && now() != '"' && now() != '\n' && now() != '\r')
      at_ += now() == '\\' && at_ + 1 < text_.size() ? 2 : 1;
    at_ = std::min(at_, text_.size());
    node.text = text_.substr(begin, at_ - begin);
    node.closed = now() == '"';
    if (node.closed) ++at_;
    node.range.end = at_;
  }

  std::unique_ptr<Node> value(const Node* parent, int depth) {
    auto node = std::make_unique<Node>();
    node->parent = parent;
    node->range = {at_, at_};
    if (now() == '"') {
      string(*node);
    } else if ((now() == '{' || now() == '[') && depth < kMostNesting) {
      container(*node, depth);
    } else {
      const std::size_t begin = at_;
      while (!ends() && !base::isSpace(now()) &&
             std::string_view(",:]}[{\"/").find(now()) == std::string_view::npos)
        ++at_;
      node->range = {begin, at_};
      node->text = text_.substr(begin, at_ - begin);
      if (begin != at_) node->type = Node::Type::word;
    }
    return node;
  }

  void container(Node& node, int depth) {
    const bool object = now() == '{';
    node.type = object ? Node::Type::object : Node::Type::array;
    ++at_;
    node.closed = false;
    for (;;) {
      blank();
      if (ends()) break;
      if (now() == '}' || now() == ']') {
        // A bracket of the other kind closes a container further out; this one was left open.
        node.closed = (now() == '}') == object;
        if (node.closed) ++at_;
        break;
      }
      const std::size_t before = at_;
      if (object)
        member(node, depth);
      else
        node.children.push_back(value(&node, depth + 1));
      blank();
      if (now() == ',') ++at_;
      if (at_ == before) ++at_;  // a byte that cannot stand here is passed over
    }
    node.range.end = at_;
  }

  void member(Node& object, int depth) {
    if (now() != '"') {
      value(&object, depth + 1);
      return;
    }
    Node key;
    string(key);
    blank();
    std::unique_ptr<Node> node;
    if (now() == ':') {
      ++at_;
      const std::size_t behind = at_;
      blank();
      node = value(&object, depth + 1);
      if (node->type == Node::Type::absent) node->range = {behind, at_};
    } else {
      node = std::make_unique<Node>();
      node->parent = &object;
      node->hasValue = false;
      node->range = {key.range.end, key.range.end};
    }
    node->key = key.text;
    node->keyRange = key.inside();
    object.children.push_back(std::move(node));
  }

  std::string_view text_;
  std::vector<Range>& comments_;
  std::size_t at_ = 0;
};

JsonOutline::JsonOutline(std::string_view text) : root_(Parser(text, comments_).run()) {}

JsonOutline::Spot JsonOutline::at(std::size_t offset) const {
  Spot spot;
  for (const Range& comment : comments_)
    if (comment.begin < offset && offset <= comment.end) spot.inComment = true;
  spot.node = root_.get();
  for (;;) {
    const Node* deeper = nullptr;
    for (const auto& child : spot.node->children) {
      if (!child->key.empty() || child->keyRange.end > 0) {
        if (child->keyRange.holds(offset)) return {child.get(), true, false, spot.inComment};
        if (child->hasValue && child->type == Node::Type::absent && child->range.holds(offset))
          deeper = child.get();
      }
      const bool container = child->type == Node::Type::array || child->type == Node::Type::object;
      const std::size_t end = child->range.end;
      if (container && child->range.begin < offset && (offset < end || (!child->closed && offset <= end)))
        deeper = child.get();
      else if (child->type == Node::Type::string && child->range.begin < offset &&
               (offset < end || (!child->closed && offset <= end)))
        deeper = child.get();
      else if (child->type == Node::Type::word && child->range.holds(offset))
        deeper = child.get();
    }
    if (!deeper) break;
    spot.node = deeper;
  }
  spot.atKey = spot.node->type == Node::Type::object;
  return spot;
}

}  // namespace weft::app::lsp
