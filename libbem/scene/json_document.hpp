#pragma once

#include "scene/location.hpp"

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace bem {

enum class JsonKind : std::uint8_t { null, boolean, number, string, array, object };

/// A JSON text as a flat list of values in the order of the text, each with its place in the file.
/// Values are named by their index; the whole document is value root(), 0 after parsing.
///
/// A document may take in others and derive values from those that it has (scene/expansion.hpp).
/// Places in messages stay those in the files that the values were written in.
///
/// Parsing is strict (RFC 8259, UTF-8): comments, trailing commas, NaN, numbers beyond the range of
/// double, a key twice in one object, anything after the document and nesting deeper than
/// kMaxDepth are errors. Texts are at most 64 MiB. Cost: O(bytes) time and memory, no recursion.
class JsonDocument {
 public:
  static constexpr int kMaxDepth = 100;
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// One value. Children of arrays and objects are a linked list.
  struct Node {
    JsonKind kind = JsonKind::null;
    bool boolean = false;
    double number = 0;
    std::uint32_t text = kNone;                  ///< index of the string
    std::uint32_t key = kNone;                   ///< index of the key, for members of objects
    std::uint32_t parent = kNone;                ///< the array or object around it in its file
    std::uint32_t index = 0;                     ///< place among the parent's children there
    std::uint32_t count = 0;                     ///< number of children
    std::uint32_t first_child = kNone;           ///< in the order of the text
    std::uint32_t next_sibling = kNone;          ///< next child of the same parent
    std::uint32_t line = 1, column = 1;          ///< first character of the value
    std::uint32_t key_line = 0, key_column = 0;  ///< first character of the key
    std::uint32_t file = 0;                      ///< index in files()
  };

  /// Parses `text`; `file` is the name used in messages. Throws ErrorCode::invalid_input with the
  /// place of the first mistake.
  static JsonDocument parse(const std::string& file, const std::string& text);

  /// Reads and parses a file. Throws ErrorCode::invalid_input if it cannot be found, is no regular
  /// text or is no JSON, and ErrorCode::resources if it may not be read.
  static JsonDocument read(const std::string& path);

  const std::string& text() const { return text_; }  ///< that was parsed
  /// The files that values were written in; the first is the one that was parsed.
  const std::vector<std::string>& files() const { return files_; }
  std::uint32_t root() const { return root_; }
  std::size_t size() const { return nodes_.size(); }
  const Node& node(std::uint32_t id) const { return nodes_[id]; }
  const std::string& string(std::uint32_t text) const { return strings_[text]; }

  /// Place of value `id`, or of its key.
  Location location(std::uint32_t id) const;
  Location key_location(std::uint32_t id) const;

  /// The value that a JSON pointer names; nothing if there is none. Cost: O(members on the way).
  std::optional<std::uint32_t> find(const std::string& pointer) const;

  /// The children of an array or object, in their order.
  std::vector<std::uint32_t> children(std::uint32_t id) const;
  /// The member `key` of an object, if there is one.
  std::optional<std::uint32_t> member(std::uint32_t id, const std::string& key) const;

  /// Takes in another document and returns its root.
  std::uint32_t adopt(JsonDocument other);
  /// A new value like `id`, key and place included, whose children are like `children`.
  std::uint32_t derive(std::uint32_t id, const std::vector<std::uint32_t>& children);
  void set_root(std::uint32_t id) { root_ = id; }

 private:
  friend class JsonBuilder;
  std::string pointer(std::uint32_t id) const;

  std::string text_;
  std::vector<std::string> files_;
  std::uint32_t root_ = 0;
  std::vector<Node> nodes_;
  std::deque<std::string> strings_;  // addresses stay valid while it grows
};

}  // namespace bem
