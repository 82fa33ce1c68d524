#pragma once

#include "handover/animated_scene.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace bem {

/// Numbers of single precision as bytes.
std::string float_bytes(const std::vector<double>& numbers);

/// A binary glTF 2.0 file: a JSON description and one buffer, whose parts are made when the file is
/// written
/// (https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html#glb-file-format-specification).
class GlbContainer {
 public:
  using Json = nlohmann::ordered_json;

  /// What a part of the buffer is for.
  enum class Use { other, corners, vertices };

  /// The description, without what the following functions add.
  Json& description() { return description_; }
  /// Adds to an array of the description. Returns the place.
  std::size_t add(const char* array, Json element);

  /// Hands the bytes of a part to a sink when the file is written.
  using PartMaker = std::function<void(const ByteSink&)>;

  /// Reserves a part of the buffer, whose size is a multiple of four. Returns its bufferView.
  std::size_t add_part(std::size_t bytes, Use use, PartMaker make);
  /// Numbers of single precision that are there: a part and its accessor, which is returned. `type`
  /// is "SCALAR", "VEC2", "VEC3" or "VEC4".
  std::size_t add_floats(const std::vector<double>& numbers, const char* type,
                         Use use = Use::other);
  std::size_t add_corners(const std::vector<std::uint32_t>& corners);
  /// Single numbers in a part of their own.
  std::size_t add_scalars(std::size_t count, PartMaker make);
  /// Vectors of single precision in a part, `count` from the byte `offset` on.
  std::size_t add_vectors(std::size_t part, std::size_t offset, std::size_t count);
  /// States the range of an accessor, which positions and times need.
  void set_range(std::size_t accessor, std::vector<double> least, std::vector<double> most);

  /// Throws ErrorCode::resources if the file would be larger than the format allows, 4 GB.
  void write(const ByteSink& sink);

 private:
  struct Part {
    std::size_t bytes;
    PartMaker make;
  };

  std::string description_text();

  Json description_;
  std::vector<Part> parts_;
  std::size_t bytes_ = 0;
};

}  // namespace bem
