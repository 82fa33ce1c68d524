#include "handover/glb_container.hpp"

#include "base/error.hpp"
#include "base/text.hpp"

#include <limits>

namespace bem {
namespace {

constexpr int kFloat = 5126, kUnsigned = 5125;               // of accessors
constexpr int kVertexTarget = 34962, kCornerTarget = 34963;  // of bufferViews
constexpr std::size_t kVectorBytes = 3 * sizeof(float);

template <class T>
std::string raw_bytes(const std::vector<T>& numbers) {
  return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T)};
}

std::string chunk_head(std::size_t bytes, const char* kind) {
  return raw_bytes(std::vector<std::uint32_t>{static_cast<std::uint32_t>(bytes)}) +
         std::string(kind, 4);
}

std::vector<double> rounded(const std::vector<double>& numbers) {
  std::vector<double> out;
  for (double x : numbers) out.push_back(static_cast<double>(static_cast<float>(x)));
  return out;
}

std::size_t components_of(const std::string& type) {
  return type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
}

}  // namespace

std::string float_bytes(const std::vector<double>& numbers) {
  return raw_bytes(std::vector<float>(numbers.begin(), numbers.end()));
}

std::size_t GlbContainer::add(const char* array, Json element) {
  Json& all = description_[array];
  all.push_back(std::move(element));
  return all.size() - 1;
}

std::size_t GlbContainer::add_part(std::size_t bytes, Use use, PartMaker make) {
  Json view{{"buffer", 0}, {"byteOffset", bytes_}, {"byteLength", bytes}};
  if (use == Use::vertices) view["byteStride"] = kVectorBytes;
  if (use != Use::other) view["target"] = use == Use::vertices ? kVertexTarget : kCornerTarget;
  parts_.push_back({bytes, std::move(make)});
  bytes_ += bytes;
  return add("bufferViews", std::move(view));
}

std::size_t GlbContainer::add_floats(const std::vector<double>& numbers, const char* type,
                                     Use use) {
  const std::string bytes = float_bytes(numbers);
  const std::size_t part = add_part(bytes.size(), use, [bytes](const ByteSink& to) { to(bytes); });
  if (use == Use::vertices)
    description_["bufferViews"][part]["byteStride"] = components_of(type) * sizeof(float);
  return add("accessors", {{"bufferView", part},
                           {"componentType", kFloat},
                           {"count", numbers.size() / components_of(type)},
                           {"type", type}});
}

std::size_t GlbContainer::add_corners(const std::vector<std::uint32_t>& corners) {
  const std::string bytes = raw_bytes(corners);
  const std::size_t part =
      add_part(bytes.size(), Use::corners, [bytes](const ByteSink& to) { to(bytes); });
  return add("accessors", {{"bufferView", part},
                           {"componentType", kUnsigned},
                           {"count", corners.size()},
                           {"type", "SCALAR"}});
}

std::size_t GlbContainer::add_scalars(std::size_t count, PartMaker make) {
  const std::size_t part = add_part(count * sizeof(float), Use::other, std::move(make));
  return add(
      "accessors",
      {{"bufferView", part}, {"componentType", kFloat}, {"count", count}, {"type", "SCALAR"}});
}

std::size_t GlbContainer::add_vectors(std::size_t part, std::size_t offset, std::size_t count) {
  return add("accessors", {{"bufferView", part},
                           {"byteOffset", offset},
                           {"componentType", kFloat},
                           {"count", count},
                           {"type", "VEC3"}});
}

void GlbContainer::set_range(std::size_t accessor, std::vector<double> least,
                             std::vector<double> most) {
  Json& of = description_["accessors"][accessor];
  of["min"] = rounded(least);
  of["max"] = rounded(most);
}

std::string GlbContainer::description_text() {
  description_["buffers"] = Json::array({{{"byteLength", bytes_}}});
  std::string text = description_.dump(-1, ' ', false, Json::error_handler_t::replace);
  return text.append((4 - text.size() % 4) % 4, ' ');
}

void GlbContainer::write(const ByteSink& sink) {
  constexpr std::size_t kHeads = 12 + 8 + 8;
  const std::string text = description_text();
  const std::size_t size = kHeads + text.size() + bytes_;
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw Error(ErrorCode::resources, "the glb would have " +
                                          bytes_text(static_cast<double>(size)) +
                                          ", and the format ends at 4.29 GB");
  sink("glTF" + raw_bytes(std::vector<std::uint32_t>{2, static_cast<std::uint32_t>(size)}));
  sink(chunk_head(text.size(), "JSON") + text);
  sink(chunk_head(bytes_, "BIN\0"));
  for (const Part& part : parts_) {
    std::size_t bytes = 0;
    part.make([&](std::string_view piece) {
      bytes += piece.size();
      sink(piece);
    });
    require(bytes == part.bytes, "a part of a glb has the size that was reserved");
  }
}

}  // namespace bem
