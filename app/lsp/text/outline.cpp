#include "app/lsp/text/outline.h"

namespace weft::app::lsp {

namespace {

std::unique_ptr<Node> nodeOf(std::string_view text, const base::JsonValue& value, const Node* parent) {
  using From = base::JsonValue::Type;
  auto node = std::make_unique<Node>();
  const auto between = [&](const Range& range) { return text.substr(range.begin, range.end - range.begin); };
  node->parent = parent;
  node->range = {value.begin, value.end};
  node->closed = value.closed;
  switch (value.type) {
    case From::object:
    case From::array:
      node->type = value.is(From::object) ? Node::Type::object : Node::Type::array;
      break;
    case From::string:
      node->type = Node::Type::string;
      node->text = between({value.begin + std::size_t{1}, value.end - (value.closed ? std::size_t{1} : 0)});
      break;
    case From::absent:
      break;
    default:
      node->type = Node::Type::word;
      node->text = between(node->range);
  }
  for (const base::JsonValue& item : value.items) node->children.push_back(nodeOf(text, item, node.get()));
  for (const base::JsonMember& member : value.members) {
    Node& child = *node->children.emplace_back(nodeOf(text, member.value, node.get()));
    child.keyRange = {member.begin + std::size_t{1}, member.end - (member.closed ? std::size_t{1} : 0)};
    child.key = between(child.keyRange);
    child.hasValue = member.hasValue;
  }
  return node;
}

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

Outline::Outline(std::string_view text) {
  base::JsonTree tree = base::parseJsonTree(text);
  comments_ = std::move(tree.comments);
  root_ = nodeOf(text, tree.root, nullptr);
  if (root_->type == Node::Type::absent) root_->range = {0, text.size()};
}

Outline::Spot Outline::at(std::size_t offset) const {
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
