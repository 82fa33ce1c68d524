#include "base/parallel.hpp"
#include "mesh/extent.hpp"
#include "mesh/shapes.hpp"
#include "output/hdf5_trajectory.hpp"
#include "output/obj_sequence.hpp"
#include "render/bound_mesh.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <benchmark/benchmark.h>
#include <unistd.h>

namespace {

using namespace bem;

constexpr int kAround = 250, kAcross = 200;  // 50,000 vertices

/// A torus of quads with texture coordinates and normals, and the 800 nodes that move it.
class Torus {
 public:
  Torus()
      : folder_(std::filesystem::temp_directory_path() / ("bem_bench_" + std::to_string(getpid()))),
        surface_(torus(0.5, 0.2, 40, 20)) {
    std::filesystem::create_directories(folder_);
    std::ofstream(file()) << text();
    mesh_ = std::make_shared<const RenderMesh>(read_render_mesh(file(), 1));
  }
  ~Torus() { std::filesystem::remove_all(folder_); }
  Torus(const Torus&) = delete;
  Torus& operator=(const Torus&) = delete;

  std::string folder() const { return folder_.string(); }
  std::string file() const { return (folder_ / "torus.obj").string(); }
  const TriangleMesh& surface() const { return surface_; }
  const std::shared_ptr<const RenderMesh>& mesh() const { return mesh_; }

 private:
  static std::string text() {
    std::string out;
    const auto add = [&out](double x) { out += " " + std::to_string(x); };
    for (const Vec3& x : torus(0.5, 0.2, kAround, kAcross).vertices) {
      for (const char* keyword : {"v", "vn", "vt"}) {
        out += keyword;
        for (int k = 0; k < 3; ++k) add(x[k]);
        out += "\n";
      }
    }
    for (int i = 0; i < kAround; ++i)
      for (int j = 0; j < kAcross; ++j) {
        out += "f";
        for (const auto& [di, dj] : {std::pair(0, 0), {1, 0}, {1, 1}, {0, 1}}) {
          const std::string v =
              std::to_string((i + di) % kAround * kAcross + (j + dj) % kAcross + 1);
          out += " " + v + "/" + v + "/" + v;
        }
        out += "\n";
      }
    return out;
  }

  std::filesystem::path folder_;
  TriangleMesh surface_;
  std::shared_ptr<const RenderMesh> mesh_;
};

const Torus& example() {
  static const Torus torus;
  set_thread_count(1);
  return torus;
}

Frame frame_of(const BoundMesh::Shape& shape) {
  Frame frame;
  frame.bodies.resize(1);
  frame.bodies[0].positions = shape.positions;
  frame.bodies[0].normals = shape.normals;
  return frame;
}

void render_read(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(read_render_mesh(example().file(), 1));
}

void render_bind(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(BoundMesh(example().mesh(), example().surface()));
}

/// How far bound vertices are from where an affine motion takes them, at most, over the size.
double largest_error(const BoundMesh& bound, const Mat3& gradient) {
  const auto moved = [&](std::vector<Vec3> points) {
    for (Vec3& x : points) x = gradient * x + Vec3(1, 2, 3);
    return points;
  };
  const std::vector<Vec3> exact = moved(bound.mesh()->triangles.vertices),
                          found = bound.shape(moved(example().surface().vertices)).positions;
  double error = 0;
  for (std::size_t v = 0; v < exact.size(); ++v)
    error = std::max(error, (found[v] - exact[v]).norm());
  return error / diameter(example().surface().vertices);
}

void render_move(benchmark::State& state) {
  const BoundMesh bound(example().mesh(), example().surface());
  for (auto _ : state) benchmark::DoNotOptimize(bound.shape(example().surface().vertices));
  Mat3 stretch;
  stretch << 1.1, 0.1, 0, 0, 0.9, 0.05, 0.1, 0, 1;
  state.counters["rigid_error"] =
      largest_error(bound, Eigen::AngleAxisd(2, Vec3(1, -2, 0.5).normalized()).toRotationMatrix());
  state.counters["linear_error"] = largest_error(bound, stretch);
  state.counters["distance"] = bound.binding().farthest() / diameter(example().surface().vertices);
}

template <class Writer>
void render_write(benchmark::State& state) {
  const auto& mesh = example().mesh();
  const TriangleMesh& triangles = mesh->triangles;
  Frame frame = frame_of(BoundMesh(mesh, example().surface()).shape(example().surface().vertices));
  Writer writer(example().folder(), {{"torus", triangles.vertices.size(), triangles.triangles,
                                      false, triangles.vertices, TrajectorySurface::render, mesh}});
  for (auto _ : state) {
    writer.write(frame);
    ++frame.index;
  }
}

BENCHMARK(render_read)->Unit(benchmark::kMillisecond);
BENCHMARK(render_bind)->Unit(benchmark::kMillisecond);
BENCHMARK(render_move)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(render_write, ObjSequence)->Unit(benchmark::kMillisecond);
BENCHMARK_TEMPLATE(render_write, Hdf5Trajectory)->Unit(benchmark::kMillisecond);

}  // namespace
