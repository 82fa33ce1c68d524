#include "scene/json_document.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <string_view>
#include <system_error>
#include <unordered_set>

#include <nlohmann/json.hpp>

namespace bem {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxBytes = std::size_t{1} << 26;

/// Walks over a text and knows the line and column it has reached.
class TextCursor {
 public:
  explicit TextCursor(const std::string& text) : text_(text) {
    if (text.compare(0, 3, "\xEF\xBB\xBF") == 0) offset_ = 3;  // byte order mark
  }

  std::uint32_t line() const { return line_; }
  std::uint32_t column() const { return column_; }

  void skip_to(std::size_t offset) {
    while (offset_ < std::min(offset, text_.size())) advance();
  }

  /// To the next token that is a value, a key or a closing bracket.
  void skip_separators() {
    while (offset_ < text_.size() && std::strchr(" \t\r\n,:", text_[offset_]) != nullptr) advance();
  }

  /// Over the token that begins here; the parser has found it to be well formed.
  void skip_token() {
    if (text_[offset_] == '"') {
      advance();
      while (text_[offset_] != '"') {
        if (text_[offset_] == '\\') advance();
        advance();
      }
      advance();
    } else if (std::strchr("{}[]", text_[offset_]) != nullptr) {
      advance();
    } else {
      while (offset_ < text_.size() && std::strchr(" \t\r\n,:{}[]", text_[offset_]) == nullptr)
        advance();
    }
  }

 private:
  void advance() {
    const auto byte = static_cast<unsigned char>(text_[offset_++]);
    if (byte == '\n') {
      ++line_;
      column_ = 1;
    } else if (offset_ == text_.size() || (text_[offset_] & 0xC0) != 0x80) {
      ++column_;  // the next byte starts a character
    }
  }

  const std::string& text_;
  std::size_t offset_ = 0;
  std::uint32_t line_ = 1, column_ = 1;
};

/// What the parser has to say, without its own numbering of the place.
std::string syntax_message(std::string what) {
  if (const auto end = what.find("] "); what.compare(0, 1, "[") == 0 && end != std::string::npos)
    what.erase(0, end + 2);
  if (what.compare(0, 11, "parse error") == 0)
    if (const auto end = what.find(": "); end != std::string::npos) what.erase(0, end + 2);
  return printable(what);
}

}  // namespace

/// Receives the parser's events and stores the values; the cursor follows them through the text,
/// because the parser does not tell where a token begins.
class JsonBuilder final : public nlohmann::json_sax<Json> {
 public:
  JsonBuilder(JsonDocument& document, const std::string& text)
      : document_(document), text_(text), cursor_(text) {}

  bool null() override { return add(JsonKind::null); }
  bool boolean(bool value) override {
    add(JsonKind::boolean);
    document_.nodes_.back().boolean = value;
    return true;
  }
  bool number_integer(std::int64_t value) override {
    return add_number(static_cast<double>(value));
  }
  bool number_unsigned(std::uint64_t value) override {
    return add_number(static_cast<double>(value));
  }
  bool number_float(double value, const std::string&) override { return add_number(value); }
  bool string(std::string& value) override {
    add(JsonKind::string);
    document_.nodes_.back().text = store(value);
    return true;
  }
  bool binary(Json::binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(JsonKind::object); }
  bool start_array(std::size_t) override { return open(JsonKind::array); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(std::string& value) override {
    cursor_.skip_separators();
    key_line_ = cursor_.line();
    key_column_ = cursor_.column();
    cursor_.skip_token();
    key_ = store(value);
    if (!open_.back().keys.insert(document_.strings_[key_]).second)
      throw error_at(
          {document_.files_[0], static_cast<int>(key_line_), static_cast<int>(key_column_),
           next_pointer()},
          "the key " + in_quotes(document_.strings_[key_]) + " appears twice in one object");
    return true;
  }

  bool parse_error(std::size_t position, const std::string&,
                   const Json::exception& error) override {
    const bool overflow = dynamic_cast<const Json::out_of_range*>(&error) != nullptr;
    if (overflow) {
      cursor_.skip_separators();
      throw error_at(next_location(), "expected a number within +-1.8e308, found a larger one");
    }
    TextCursor last_read(text_);
    last_read.skip_to(position == 0 ? 0 : position - 1);
    throw error_at({document_.files_[0], static_cast<int>(last_read.line()),
                    static_cast<int>(last_read.column()), ""},
                   "not valid JSON: " + syntax_message(error.what()));
  }

 private:
  struct Open {
    std::uint32_t id;
    std::uint32_t last_child = JsonDocument::kNone;
    std::unordered_set<std::string_view> keys = {};
  };

  std::uint32_t store(std::string& value) {
    document_.strings_.push_back(std::move(value));
    return static_cast<std::uint32_t>(document_.strings_.size() - 1);
  }

  /// Pointer to the value that comes next.
  std::string next_pointer() const {
    if (open_.empty()) return "";
    const JsonDocument::Node& parent = document_.nodes_[open_.back().id];
    const bool member = parent.kind == JsonKind::object;
    if (member && key_ == JsonDocument::kNone) return document_.pointer(open_.back().id);
    return document_.pointer(open_.back().id) +
           pointer_token(member ? document_.strings_[key_] : std::to_string(parent.count));
  }

  Location next_location() const {
    return {document_.files_[0], static_cast<int>(cursor_.line()),
            static_cast<int>(cursor_.column()), next_pointer()};
  }

  bool add(JsonKind kind) {
    cursor_.skip_separators();
    JsonDocument::Node node;
    node.kind = kind;
    node.line = cursor_.line();
    node.column = cursor_.column();
    const auto id = static_cast<std::uint32_t>(document_.nodes_.size());
    if (!open_.empty()) {
      Open& open = open_.back();
      JsonDocument::Node& parent = document_.nodes_[open.id];
      node.parent = open.id;
      node.index = parent.count++;
      if (parent.kind == JsonKind::object) {
        node.key = key_;
        node.key_line = key_line_;
        node.key_column = key_column_;
      }
      if (open.last_child == JsonDocument::kNone)
        parent.first_child = id;
      else
        document_.nodes_[open.last_child].next_sibling = id;
      open.last_child = id;
    }
    document_.nodes_.push_back(node);
    cursor_.skip_token();
    return true;
  }

  bool add_number(double value) {
    add(JsonKind::number);
    document_.nodes_.back().number = value;
    return true;
  }

  bool open(JsonKind kind) {
    cursor_.skip_separators();
    if (open_.size() == JsonDocument::kMaxDepth)
      throw error_at(next_location(), "arrays and objects are nested more than " +
                                          std::to_string(JsonDocument::kMaxDepth) + " deep");
    add(kind);
    open_.push_back({static_cast<std::uint32_t>(document_.nodes_.size() - 1)});
    key_ = JsonDocument::kNone;
    return true;
  }

  bool close() {
    cursor_.skip_separators();
    cursor_.skip_token();
    open_.pop_back();
    key_ = JsonDocument::kNone;
    return true;
  }

  JsonDocument& document_;
  const std::string& text_;
  TextCursor cursor_;
  std::vector<Open> open_;
  std::uint32_t key_ = JsonDocument::kNone;
  std::uint32_t key_line_ = 0, key_column_ = 0;
};

JsonDocument JsonDocument::parse(const std::string& file, const std::string& text) {
  JsonDocument document;
  document.files_ = {file};
  document.text_ = text;
  if (text.size() > kMaxBytes) throw error_at({file, 0, 0, ""}, "larger than 64 MiB");
  if (const auto zero = text.find('\0'); zero != std::string::npos) {
    // The parser would take a zero byte for the end of the text.
    TextCursor cursor(text);
    cursor.skip_to(zero);
    throw error_at({file, static_cast<int>(cursor.line()), static_cast<int>(cursor.column()), ""},
                   "not valid JSON: a zero byte");
  }
  JsonBuilder builder(document, text);
  require(Json::sax_parse(text, &builder), "the parser reports its errors");
  return document;
}

JsonDocument JsonDocument::read(const std::string& path) {
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    const int reason = errno;
    const bool missing = reason == ENOENT || reason == ENOTDIR;
    throw Error(missing ? ErrorCode::invalid_input : ErrorCode::resources,
                printable(path) + ": cannot be opened: " + std::generic_category().message(reason));
  }
  std::string text;
  std::vector<char> block(1 << 16);
  while (file.read(block.data(), static_cast<std::streamsize>(block.size())) || file.gcount() > 0) {
    text.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > kMaxBytes) break;
  }
  if (file.bad())
    throw Error(ErrorCode::invalid_input, printable(path) + ": cannot be read (a folder?)");
  return parse(path, text);
}

}  // namespace bem
