#include "scene/repeat.hpp"

#include "scene/scene_parts.hpp"

#include <array>
#include <limits>
#include <random>

#include <Eigen/Geometry>

namespace bem {
namespace {

constexpr int kMostCopies = 10000;

/// How many copies there are along three axes, or in one row.
struct CopyCount {
  std::array<int, 3> along = {1, 1, 1};
  bool is_row = false;
};

CopyCount read_count(const JsonValue& value) {
  CopyCount count;
  count.is_row = value.kind() != JsonKind::array;
  if (count.is_row) {
    if (value.kind() != JsonKind::number) throw value.unexpected("an integer, or three of them");
    count.along[0] = value.integer_in(1, kMostCopies);
    return count;
  }
  const auto items = value.items(3, "array of three integers");
  if (items.size() != 3) throw value.unexpected("an array of three integers");
  long all = 1;
  for (std::size_t k = 0; k < 3; ++k) all *= count.along[k] = items[k].integer_in(1, kMostCopies);
  if (all > kMostCopies)
    throw value.error("expected at most " + std::to_string(kMostCopies) + " copies, found " +
                      std::to_string(all));
  return count;
}

/// Random displacements of copies.
class Jitter {
 public:
  Jitter() = default;
  explicit Jitter(const JsonValue& value) {
    JsonReader reader(value, "a jitter");
    if (const auto position = reader.optional("position"))
      position_ = position->non_negative(dimension::length);
    if (const auto rotation = reader.optional("rotation_deg")) turn_ = rotation->angle_in(0, 180);
    if (const auto seed = reader.optional("seed"))
      random_.seed(
          static_cast<std::uint64_t>(seed->integer_in(0, std::numeric_limits<int>::max())));
    reader.finish();
  }

  void apply(RepeatedCopy& copy) {
    copy.offset += position_ * next_vector();
    AxisAngle turn;
    turn.axis = next_axis();
    turn.angle = turn_ * next();
    if (turn_ > 0) copy.turn = turn;
  }

 private:
  /// Uniform from -1 to 1.
  double next() { return 2 * (static_cast<double>(random_() >> 11) * 0x1p-53) - 1; }

  Vec3 next_vector() {
    Vec3 v;
    for (int k = 0; k < 3; ++k) v[k] = next();
    return v;
  }

  Vec3 next_axis() {
    for (;;) {
      const Vec3 v = next_vector();
      const double square = v.squaredNorm();
      if (square > 1e-6 && square <= 1) return v / std::sqrt(square);
    }
  }

  double position_ = 0, turn_ = 0;  // [m], [rad]
  std::mt19937_64 random_{0};
};

template <class Thing, class Move>
std::vector<Thing> copies_of(const Thing& thing, const std::optional<JsonValue>& repeat,
                             const Move& move) {
  if (!repeat) return {thing};
  std::vector<Thing> things;
  for (const RepeatedCopy& copy : read_repeat(*repeat)) {
    things.push_back(thing);
    things.back().name += copy.suffix;
    if (things.back().name.size() > kMaxNameBytes)
      throw repeat->error("the name " + in_quotes(things.back().name) +
                          " of a copy has more than " + std::to_string(kMaxNameBytes) + " bytes");
    move(things.back(), copy);
  }
  return things;
}

void move_copy(BodySpec& body, const RepeatedCopy& copy) {
  body.position += copy.offset;
  if (body.place) body.place->offset = copy.offset;
  body.rotation = copy.turned(body.rotation);
}

void move_copy(ObstacleSpec& obstacle, const RepeatedCopy& copy) {
  if (auto* plane = std::get_if<PlaneObstacle>(&obstacle.shape)) {
    plane->point += copy.offset;
    if (copy.turn) plane->normal = (copy.turn->matrix() * plane->normal).normalized();
  } else {
    auto& mesh = std::get<MeshObstacle>(obstacle.shape);
    mesh.position += copy.offset;
    mesh.rotation = copy.turned(mesh.rotation);
  }
}

}  // namespace

AxisAngle RepeatedCopy::turned(const AxisAngle& rotation) const {
  if (!turn) return rotation;
  const Eigen::AngleAxisd first(rotation.angle, rotation.axis), second(turn->angle, turn->axis);
  const Eigen::AngleAxisd both(Eigen::Quaterniond(second) * Eigen::Quaterniond(first));
  AxisAngle out;
  out.axis = both.axis();
  out.angle = both.angle();
  return out;
}

std::vector<RepeatedCopy> read_repeat(const JsonValue& value) {
  JsonReader reader(value, "a repetition");
  const CopyCount count = read_count(reader.required("count"));
  const Vec3 spacing = reader.required("spacing").vec3(dimension::length);
  const auto jitter_value = reader.optional("jitter");
  Jitter jitter = jitter_value ? Jitter(*jitter_value) : Jitter();
  reader.finish();
  std::vector<RepeatedCopy> copies;
  for (int i = 0; i < count.along[0]; ++i)
    for (int j = 0; j < count.along[1]; ++j)
      for (int k = 0; k < count.along[2]; ++k) {
        RepeatedCopy copy;
        copy.suffix = '-' + std::to_string(i);
        if (!count.is_row) copy.suffix += '-' + std::to_string(j) + '-' + std::to_string(k);
        copy.offset = count.is_row ? Vec3(i * spacing) : spacing.cwiseProduct(Vec3(i, j, k));
        if (jitter_value) jitter.apply(copy);
        copies.push_back(copy);
      }
  return copies;
}

std::vector<BodySpec> repeated(const BodySpec& body, const std::optional<JsonValue>& repeat) {
  return copies_of(body, repeat, [](BodySpec& b, const RepeatedCopy& c) { move_copy(b, c); });
}

std::vector<ObstacleSpec> repeated(const ObstacleSpec& obstacle,
                                   const std::optional<JsonValue>& repeat) {
  return copies_of(obstacle, repeat,
                   [](ObstacleSpec& o, const RepeatedCopy& c) { move_copy(o, c); });
}

}  // namespace bem
