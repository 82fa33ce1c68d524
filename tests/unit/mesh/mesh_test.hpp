#pragma once

#include "base/error.hpp"
#include "mesh/triangle_mesh.hpp"

#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include <catch2/catch.hpp>
#include <unistd.h>

namespace bem::test {

/// Checks that `call` throws Error with this code, and returns the message.
inline std::string error_message(ErrorCode code, const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    CHECK(static_cast<int>(e.code()) == static_cast<int>(code));
    return e.what();
  }
  FAIL("no error was thrown");
  return {};
}

/// A file in the temporary directory that goes away with the object.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& name, const std::string& content = {})
      : path_((std::filesystem::temp_directory_path() /
               ("bem_" + std::to_string(getpid()) + "_" + name))
                  .string()) {
    std::ofstream(path_, std::ios::binary) << content;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Tetrahedron with corners 0, e1, e2, e3 and outward triangles; volume 1/6.
inline TriangleMesh unit_tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
          {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}};
}

/// Both meshes in one, the second one scaled about the origin, moved and turned inside out if
/// `inward`.
inline TriangleMesh combined(TriangleMesh a, const TriangleMesh& b, double scale, const Vec3& shift,
                             bool inward) {
  const int offset = static_cast<int>(a.vertices.size());
  for (const Vec3& v : b.vertices) a.vertices.push_back(scale * v + shift);
  for (Triangle t : b.triangles) {
    for (int& v : t) v += offset;
    if (inward) std::swap(t[1], t[2]);
    a.triangles.push_back(t);
  }
  return a;
}

}  // namespace bem::test
