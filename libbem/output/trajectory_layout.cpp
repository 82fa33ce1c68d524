#include "output/trajectory_layout.hpp"

#include <numeric>
#include <utility>

namespace bem {
namespace {

using Rows = std::vector<double>;

static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are stored without gaps");
static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t), "triangles are stored without gaps");

std::string group_of(const TrajectoryBody& body) {
  return "/bodies/" + body.name;
}

std::string group_of(const TrajectoryObstacle& obstacle) {
  return "/obstacles/" + obstacle.name;
}

void append(const Vec3& v, Rows& to) {
  to.insert(to.end(), v.data(), v.data() + 3);
}

void append(const std::vector<Vec3>& vectors, Rows& to) {
  if (!vectors.empty())
    to.insert(to.end(), vectors[0].data(), vectors[0].data() + 3 * vectors.size());
}

/// Row by row.
void append(const Mat3& m, Rows& to) {
  for (int i = 0; i < 3; ++i) append(Vec3(m.row(i).transpose()), to);
}

/// Extents of a value with these components after those of what it belongs to.
Hdf5Dims extents_of(const FrameQuantity& q, Hdf5Dims dims = {}) {
  if (q.components > 1) dims.push_back(q.components);
  return dims;
}

class Datasets {
 public:
  explicit Datasets(const TrajectoryContents& contents) {
    for (std::size_t b = 0; b < contents.bodies.size(); ++b) add_body(contents.bodies[b], b);
    for (std::size_t o = 0; o < contents.obstacles.size(); ++o)
      if (!contents.obstacles[o].plane) add_obstacle(contents.obstacles[o], o);
    if (contents.contacts) add_contacts();
    add(kTimesPath, "s", {}, [](const Frame& f, Rows& to) { to.push_back(f.time); });
  }

  std::vector<TrajectoryDataset> take() { return std::move(all_); }

 private:
  template <class F>
  void add(std::string path, std::string units, Hdf5Dims extents, const F& append) {
    all_.push_back(
        {std::move(path), std::move(units), std::move(extents), Hdf5Type::float64, false, append});
  }

  template <class F>
  void add_place(const std::string& group, const F& place) {
    add(group + "/translation", "m", {3},
        [place](const Frame& f, Rows& to) { append(place(f).translation, to); });
    add(group + "/rotation", "1", {3, 3},
        [place](const Frame& f, Rows& to) { append(place(f).rotation, to); });
  }

  void add_body(const TrajectoryBody& body, std::size_t b) {
    const std::string group = group_of(body);
    add(group + "/positions", "m", {body.vertices, 3},
        [b](const Frame& f, Rows& to) { append(f.bodies[b].positions, to); });
    add_place(group + "/frame", [b](const Frame& f) { return f.bodies[b].frame; });
    for (std::size_t i = 0; i < body.fields.size(); ++i)
      add(group + "/" + body.fields[i].name, body.fields[i].units,
          extents_of(body.fields[i], {body.vertices}), [b, i](const Frame& f, Rows& to) {
            const Rows& values = f.bodies[b].fields[i];
            to.insert(to.end(), values.begin(), values.end());
          });
    std::size_t at = 0;
    for (const FrameQuantity& q : body.series) {
      add(group + "/series/" + q.name, q.units, extents_of(q),
          [b, at, n = q.components](const Frame& f, Rows& to) {
            const double* values = f.bodies[b].series.data() + at;
            to.insert(to.end(), values, values + n);
          });
      at += q.components;
    }
  }

  void add_obstacle(const TrajectoryObstacle& obstacle, std::size_t o) {
    add_place(group_of(obstacle), [o](const Frame& f) { return f.obstacles[o]; });
  }

  template <class F>
  void add_by_contact(const char* name, const char* units, Hdf5Dims extents, Hdf5Type type,
                      const F& value) {
    all_.push_back({std::string("/contacts/") + name, units, std::move(extents), type, true,
                    [value](const Frame& f, Rows& to) {
                      for (const ContactFrame& c : f.contacts) value(c, to);
                    }});
  }

  void add_contacts() {
    constexpr Hdf5Type kNumber = Hdf5Type::float64;
    add(kContactCountsPath, "1", {},
        [](const Frame& f, Rows& to) { to.push_back(static_cast<double>(f.contacts.size())); });
    all_.back().type = Hdf5Type::int32;
    add_by_contact("points", "m", {3}, kNumber,
                   [](const ContactFrame& c, Rows& to) { append(c.point, to); });
    add_by_contact("normals", "1", {3}, kNumber,
                   [](const ContactFrame& c, Rows& to) { append(c.normal, to); });
    add_by_contact("forces", "N", {3}, kNumber,
                   [](const ContactFrame& c, Rows& to) { append(c.force, to); });
    add_by_contact("pairs", "1", {2}, Hdf5Type::int32, [](const ContactFrame& c, Rows& to) {
      to.insert(to.end(), c.surface.begin(), c.surface.end());
    });
  }

  std::vector<TrajectoryDataset> all_;
};

void set_text(Hdf5File& file, const std::string& object, const char* name,
              const std::string& text) {
  if (!text.empty()) file.set_attribute(object, name, text);
}

void write_vectors(Hdf5File& file, const std::string& path, const std::vector<Vec3>& vectors,
                   const char* units) {
  file.write(path, vectors.empty() ? nullptr : vectors[0].data(), {vectors.size(), 3});
  file.set_attribute(path, "units", units);
}

void write_faces(Hdf5File& file, const std::string& group, const std::vector<Triangle>& faces) {
  const std::string path = group + "/faces";
  file.write(path, faces.empty() ? nullptr : faces[0].data(), {faces.size(), 3});
  file.set_attribute(path, "units", "1");
}

void write_body(Hdf5File& file, const TrajectoryBody& body) {
  const std::string group = group_of(body);
  write_faces(file, group, body.triangles);
  if (body.surface != TrajectorySurface::only)
    file.set_attribute(
        group, kSurfaceAttribute,
        body.surface == TrajectorySurface::render ? kRenderSurface : kSimulatedSurface);
  file.set_attribute(group, "index", body.index);
  if (body.mass > 0) file.set_attribute(group, "mass", body.mass);
  set_text(file, group, "archive_digest", body.archive_digest);
  set_text(file, group, "mesh_digest", body.mesh_digest);
}

void write_obstacle(Hdf5File& file, const TrajectoryObstacle& obstacle) {
  const std::string group = group_of(obstacle);
  file.create_group(group);
  file.set_attribute(group, "index", obstacle.index);
  if (!obstacle.plane) {
    write_vectors(file, group + "/vertices", obstacle.vertices, "m");
    write_faces(file, group, obstacle.triangles);
    return;
  }
  const auto write = [&](const char* name, const Vec3& v, const char* units) {
    file.write(group + name, v.data(), {3});
    file.set_attribute(group + name, "units", units);
  };
  write("/point", obstacle.plane->point, "m");
  write("/normal", obstacle.plane->normal, "1");
}

}  // namespace

std::size_t TrajectoryDataset::width() const {
  return std::accumulate(extents.begin(), extents.end(), std::size_t(1), std::multiplies<>());
}

std::vector<TrajectoryDataset> trajectory_datasets(const TrajectoryContents& contents) {
  return Datasets(contents).take();
}

void write_contents(Hdf5File& file, const TrajectoryContents& contents) {
  file.set_attribute("/", "format", "bem trajectory");
  file.set_attribute("/", "version", kTrajectoryVersion);
  set_text(file, "/", "program", contents.program);
  set_text(file, "/", "scene", contents.scene);
  if (contents.time_step > 0) file.set_attribute("/", "time_step", contents.time_step);
  for (const TrajectoryBody& body : contents.bodies) write_body(file, body);
  for (const TrajectoryObstacle& obstacle : contents.obstacles) write_obstacle(file, obstacle);
}

}  // namespace bem
