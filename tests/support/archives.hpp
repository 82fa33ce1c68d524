#pragma once

#include "archive/archive_reader.hpp"
#include "archive/archive_writer.hpp"
#include "support/bodies.hpp"
#include "support/temporary_folder.hpp"

#include <fstream>
#include <iterator>

namespace bem_test {

/// A sphere of 42 nodes with a vertex that no triangle uses, so that vertices and nodes differ.
inline bem::BodyGeometry small_body() {
  bem::TriangleMesh mesh = bem::icosphere(1, 0.1);
  mesh.vertices.insert(mesh.vertices.begin(), bem::Vec3(7, 8, 9));
  for (bem::Triangle& t : mesh.triangles)
    for (int& v : t) ++v;
  for (bem::Vec3& v : mesh.vertices) v += bem::Vec3(0.3, -0.1, 0.2);
  return bem::make_geometry(bem::make_surface(mesh, "sphere"), 1000);
}

/// A complete model that takes a fraction of a second to compute.
inline bem::BodyModel small_model(const std::string& scheme = "radau2",
                                  const bem::CodecOptions& codec = {}) {
  bem::PrecomputeOptions options;
  options.discretisation.material = material(1000, 1e5, 0.3);
  options.discretisation.material.time_step = 0.01;
  options.discretisation.scheme = bem::Scheme::parse(scheme);
  options.discretisation.dt = 0.01;
  options.discretisation.history_length = 4;
  options.codec = codec;
  options.window = 0.99;
  options.measure_growth = false;
  return bem::precompute(small_body(), options);
}

inline bem::Provenance provenance() {
  return {"bem 0.0.0", "sphere.obj", "rubber.json", 0.5, "--scheme radau2"};
}

inline std::string file_bytes(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// The code and message of the bem::Error that `f` throws; {0, ""} if it throws none.
template <class F>
std::pair<int, std::string> error_of(const F& f) {
  try {
    f();
  } catch (const bem::Error& e) {
    return {static_cast<int>(e.code()), e.what()};
  }
  return {0, ""};
}

}  // namespace bem_test
