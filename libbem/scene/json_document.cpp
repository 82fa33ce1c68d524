#include "scene/json_document.hpp"

#include <algorithm>
#include <iterator>

namespace bem {

std::string JsonDocument::pointer(std::uint32_t id) const {
  std::vector<std::string> steps;
  for (; nodes_[id].parent != kNone; id = nodes_[id].parent) {
    const Node& n = nodes_[id];
    steps.push_back(pointer_token(n.key == kNone ? std::to_string(n.index) : strings_[n.key]));
  }
  std::string out;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) out += *step;
  return out;
}

Location JsonDocument::location(std::uint32_t id) const {
  const Node& n = nodes_[id];
  return {files_[n.file], static_cast<int>(n.line), static_cast<int>(n.column), pointer(id)};
}

Location JsonDocument::key_location(std::uint32_t id) const {
  const Node& n = nodes_[id];
  if (n.key == kNone) return location(id);
  return {files_[n.file], static_cast<int>(n.key_line), static_cast<int>(n.key_column),
          pointer(id)};
}

std::optional<std::uint32_t> JsonDocument::find(const std::string& pointer) const {
  std::uint32_t id = root_;
  std::size_t begin = 0;
  while (begin < pointer.size()) {
    const std::size_t end = std::min(pointer.find('/', begin + 1), pointer.size());
    const std::string token = pointer.substr(begin, end - begin);
    const bool object = nodes_[id].kind == JsonKind::object;
    std::uint32_t child = nodes_[id].first_child;
    for (std::size_t i = 0; child != kNone; child = nodes_[child].next_sibling, ++i)
      if (token == pointer_token(object ? strings_[nodes_[child].key] : std::to_string(i))) break;
    if (child == kNone) return std::nullopt;
    id = child;
    begin = end;
  }
  return id;
}

std::vector<std::uint32_t> JsonDocument::children(std::uint32_t id) const {
  std::vector<std::uint32_t> out;
  for (auto child = nodes_[id].first_child; child != kNone; child = nodes_[child].next_sibling)
    out.push_back(child);
  return out;
}

std::optional<std::uint32_t> JsonDocument::member(std::uint32_t id, const std::string& key) const {
  if (nodes_[id].kind != JsonKind::object) return std::nullopt;
  for (auto child = nodes_[id].first_child; child != kNone; child = nodes_[child].next_sibling)
    if (strings_[nodes_[child].key] == key) return child;
  return std::nullopt;
}

std::uint32_t JsonDocument::adopt(JsonDocument other) {
  const auto values = static_cast<std::uint32_t>(nodes_.size());
  const auto texts = static_cast<std::uint32_t>(strings_.size());
  const auto names = static_cast<std::uint32_t>(files_.size());
  for (Node n : other.nodes_) {
    for (std::uint32_t* id : {&n.parent, &n.first_child, &n.next_sibling})
      if (*id != kNone) *id += values;
    for (std::uint32_t* text : {&n.text, &n.key})
      if (*text != kNone) *text += texts;
    n.file += names;
    nodes_.push_back(n);
  }
  std::move(other.strings_.begin(), other.strings_.end(), std::back_inserter(strings_));
  std::move(other.files_.begin(), other.files_.end(), std::back_inserter(files_));
  return other.root_ + values;
}

std::uint32_t JsonDocument::derive(std::uint32_t id, const std::vector<std::uint32_t>& children) {
  const auto derived = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back(Node(nodes_[id]));
  nodes_.back().count = static_cast<std::uint32_t>(children.size());
  nodes_.back().first_child = children.empty() ? kNone : derived + 1;
  for (std::size_t i = 0; i < children.size(); ++i) {
    nodes_.push_back(Node(nodes_[children[i]]));
    nodes_.back().next_sibling =
        i + 1 < children.size() ? derived + 2 + static_cast<std::uint32_t>(i) : kNone;
  }
  return derived;
}

}  // namespace bem
