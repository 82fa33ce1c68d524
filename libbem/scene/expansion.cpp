#include "scene/expansion.hpp"

#include "scene/scene_parts.hpp"

#include <algorithm>
#include <filesystem>
#include <map>
#include <string_view>
#include <unordered_map>

namespace bem {
namespace {

namespace fs = std::filesystem;
using ValueId = std::uint32_t;
using ValueIds = std::vector<ValueId>;

constexpr std::size_t kMostValues = std::size_t{1} << 24;
constexpr std::size_t kDeepestInclude = 50;

/// What an included file is a part of: it decides whether lists of things are joined.
enum class Part { scene, thing };

/// Keys that say the same in another way: a default does not stand against them.
constexpr std::pair<const char*, const char*> kAlternatives[] = {{"position", "place"},
                                                                 {"plane", "mesh"}};

std::string alternative_to(const std::string& key) {
  for (const auto& [a, b] : kAlternatives) {
    if (key == a) return b;
    if (key == b) return a;
  }
  return "";
}

class Expansion {
 public:
  explicit Expansion(JsonDocument& document) : document_(document) {
    open_.push_back(identity(document.files()[0]));
  }

  void run() {
    if (!is_object(document_.root())) return;
    document_.set_root(with_defaults(expanded(document_.root(), Part::scene)));
  }

 private:
  static fs::path identity(const std::string& path) {
    std::error_code unknown;
    return fs::weakly_canonical(path, unknown);
  }

  bool is_object(ValueId id) const { return document_.node(id).kind == JsonKind::object; }
  bool is_array(ValueId id) const { return document_.node(id).kind == JsonKind::array; }
  const std::string& key(ValueId id) const { return document_.string(document_.node(id).key); }

  ValueId derive(ValueId id, const ValueIds& children) {
    if (document_.size() + children.size() > kMostValues)
      throw error_at(document_.location(id),
                     "the scene becomes too large: includes, defaults and what they are written "
                     "into have more than " +
                         std::to_string(kMostValues) + " values");
    return document_.derive(id, children);
  }

  /// `id` with every child replaced.
  template <class Replace>
  ValueId with_children(ValueId id, const Replace& replace) {
    ValueIds children = document_.children(id);
    for (ValueId& child : children) child = replace(child);
    return derive(id, children);
  }

  /// The object with what it and its parts include.
  ValueId expanded(ValueId id, Part part) {
    if (!is_object(id)) return id;
    if (part == Part::scene)
      id = with_children(id, [&](ValueId member) { return expanded_member(member); });
    const auto include = document_.member(id, "include");
    if (!include) return id;
    ValueIds own = document_.children(id);
    own.erase(std::find(own.begin(), own.end(), *include));
    const ValueId high = derive(id, own);
    const ValueIds paths = is_array(*include) ? document_.children(*include) : ValueIds{*include};
    if (paths.empty()) return high;
    ValueId low = included(paths[0], part);
    for (std::size_t i = 1; i < paths.size(); ++i)
      low = merged(low, included(paths[i], part), part);
    return merged(low, high, part);
  }

  /// A member of a scene: bodies, obstacles and their defaults may include files.
  ValueId expanded_member(ValueId member) {
    const std::string& name = key(member);
    const bool things = (name == "bodies" || name == "obstacles") && is_array(member);
    if (!things && (name != "defaults" || !is_object(member))) return member;
    return with_children(member, [&](ValueId thing) { return expanded(thing, Part::thing); });
  }

  /// The expanded contents of a file.
  ValueId included(ValueId path, Part part) {
    const FilePath file = read_path(JsonValue(document_, path));
    const fs::path id = identity(file.resolved);
    check_nesting(file, id);
    const auto known = known_.find({id, part});
    if (known != known_.end()) return known->second;
    std::error_code unknown;
    if (!fs::is_regular_file(id, unknown))
      throw error_at(file.location,
                     "the file " + in_quotes(file.written) + " to include " +
                         (fs::exists(id, unknown) ? "is no regular file" : "does not exist") +
                         " (" + printable(file.resolved) + ")");
    const ValueId root = document_.adopt(JsonDocument::read(file.resolved));
    if (!is_object(root)) throw JsonValue(document_, root).unexpected("an object to include");
    open_.push_back(id);
    const ValueId result = expanded(root, part);
    open_.pop_back();
    known_[{id, part}] = result;
    return result;
  }

  void check_nesting(const FilePath& file, const fs::path& id) const {
    const auto first = std::find(open_.begin(), open_.end(), id);
    if (first != open_.end()) {
      std::string chain;
      for (auto at = first; at != open_.end(); ++at) chain += at->filename().string() + " -> ";
      throw error_at(file.location, "the file " + in_quotes(file.written) + " includes itself: " +
                                        printable(chain + id.filename().string()));
    }
    if (open_.size() > kDeepestInclude)
      throw error_at(file.location,
                     "includes are nested more than " + std::to_string(kDeepestInclude) + " deep");
  }

  /// Members of both objects; those of `high` win, objects are merged in their turn.
  ValueId merged(ValueId low, ValueId high, Part part) {
    std::unordered_map<std::string_view, ValueId> rest;
    for (ValueId member : document_.children(low)) rest.emplace(key(member), member);
    ValueIds members;
    for (ValueId member : document_.children(high)) {
      const auto other = rest.find(key(member));
      members.push_back(other == rest.end() ? member : combined(other->second, member, part));
      if (other != rest.end()) rest.erase(other);
    }
    for (ValueId member : document_.children(low))
      if (rest.count(key(member)) > 0) members.push_back(member);
    return derive(high, members);
  }

  ValueId combined(ValueId low, ValueId high, Part part) {
    const std::string& name = key(high);
    if (part == Part::scene && (name == "bodies" || name == "obstacles" || name == "joints")) {
      ValueIds all;
      for (ValueId list : {low, high}) {
        if (!is_array(list)) throw JsonValue(document_, list).unexpected("an array of " + name);
        for (ValueId item : document_.children(list)) all.push_back(item);
      }
      return derive(high, all);
    }
    return is_object(low) && is_object(high) ? merged(low, high, Part::thing) : high;
  }

  ValueId with_defaults(ValueId scene) {
    const auto defaults = document_.member(scene, "defaults");
    if (!defaults) return scene;
    const auto body = document_.member(*defaults, "body");
    const auto obstacle = document_.member(*defaults, "obstacle");
    return with_children(scene, [&](ValueId member) {
      if (body && key(member) == "bodies") return with_default(member, *body);
      if (obstacle && key(member) == "obstacles") return with_default(member, *obstacle);
      return member;
    });
  }

  ValueId with_default(ValueId things, ValueId defaults) {
    if (!is_array(things) || !is_object(defaults)) return things;
    return with_children(things, [&](ValueId thing) {
      if (!is_object(thing)) return thing;
      ValueIds members = document_.children(thing);
      for (ValueId member : document_.children(defaults))
        if (!document_.member(thing, key(member)) &&
            !document_.member(thing, alternative_to(key(member))))
          members.push_back(member);
      return derive(thing, members);
    });
  }

  JsonDocument& document_;
  std::vector<fs::path> open_;  ///< files that are being expanded, each included by the one before
  std::map<std::pair<fs::path, Part>, ValueId> known_;
};

}  // namespace

JsonDocument expanded_scene(JsonDocument scene) {
  Expansion(scene).run();
  return scene;
}

}  // namespace bem
