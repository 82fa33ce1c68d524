#include "survey.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
namespace {

constexpr std::size_t kSamples = 200000;  // of a field's values, by which colours are chosen
constexpr double kShown = 0.998;          // of the values are below the top of the colours

Vec3 middle(const std::vector<double>& points) {
  const auto count = static_cast<Eigen::Index>(points.size() / 3);
  return Eigen::Map<const Eigen::Matrix3Xd>(points.data(), 3, count).rowwise().mean();
}

/// Values of one field: their largest, and samples of them at equal distances.
class ValueStatistics {
 public:
  explicit ValueStatistics(std::size_t expected) : stride_(expected / kSamples + 1) {}

  void add(const std::vector<double>& values) {
    for (double v : values) {
      most_ = std::max(most_, v);
      if (count_++ % stride_ == 0) samples_.push_back(v);
    }
  }

  FieldRange range() {
    if (samples_.empty()) return {};
    const auto at = samples_.begin() +
                    static_cast<std::ptrdiff_t>(kShown * static_cast<double>(samples_.size() - 1));
    std::nth_element(samples_.begin(), at, samples_.end());
    return {most_, round_above(*at > 0.05 * most_ ? *at : most_)};
  }

 private:
  std::size_t stride_, count_ = 0;
  double most_ = 0;
  std::vector<double> samples_;
};

/// Goes through the frames of one body.
class BodySurvey {
 public:
  BodySurvey(const Recording& recording, std::size_t body, Survey& out,
             std::vector<ValueStatistics>& statistics)
      : recording_(recording), body_(body), out_(out), statistics_(statistics) {
    height_ = {"height", "m", body, 1, {}};
    displacement_ = {"largest displacement", "m", body, 1, {}};
  }

  void add(std::size_t frame) {
    const std::vector<double> points = recording_.positions(body_, frame);
    std::vector<double> local = recording_.pose(body_, frame).to_local(points);
    out_.bounds.include(points);
    out_.grids[body_].include(local);
    if (frame == 0) first_ = local;
    const std::vector<double> moved = distances(local, first_);
    height_.numbers.push_back(points.empty() ? 0 : middle(points).dot(recording_.up()));
    displacement_.numbers.push_back(moved.empty() ? 0
                                                  : *std::max_element(moved.begin(), moved.end()));
    for (std::size_t f = 0; f < statistics_.size(); ++f)
      if (recording_.has_field(body_, recording_.fields()[f]))
        statistics_[f].add(values(recording_.fields()[f], frame, points, moved));
    last_ = points;
  }

  void finish() {
    out_.measured.push_back(height_);
    out_.measured.push_back(displacement_);
  }

 private:
  static std::vector<double> distances(std::vector<double> a, const std::vector<double>& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
    return lengths(a, 3);
  }

  std::vector<double> values(const ViewField& field, std::size_t frame,
                             const std::vector<double>& points,
                             const std::vector<double>& moved) const {
    if (field.stored) return recording_.values(body_, field, frame);
    if (field.name == kDisplacement) return moved;
    if (frame == 0) return {};
    const auto& times = recording_.file().times();
    const auto& frames = recording_.frames();
    std::vector<double> speeds = distances(points, last_);
    for (double& v : speeds) v /= times[frames[frame]] - times[frames[frame - 1]];
    return speeds;
  }

  const Recording& recording_;
  std::size_t body_;
  Survey& out_;
  std::vector<ValueStatistics>& statistics_;
  ViewSeries height_, displacement_;
  std::vector<double> first_, last_;
};

}  // namespace

double round_above(double value) {
  if (value <= 0) return 0;
  const double power = std::pow(10, std::floor(std::log10(value)));
  for (double digits : {1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0})
    if (digits * power >= value * (1 - 1e-12)) return digits * power;
  return 10 * power;
}

Survey survey(const Recording& recording, const std::function<void(double)>& progress) {
  const std::size_t bodies = recording.bodies().size(), frames = recording.frames().size();
  std::size_t vertices = 0;
  for (const std::string& body : recording.bodies()) vertices += recording.file().vertices(body);
  Survey out;
  out.grids.resize(bodies);
  std::vector<ValueStatistics> statistics(recording.fields().size(),
                                          ValueStatistics(vertices * frames));
  for (std::size_t b = 0; b < bodies; ++b) {
    BodySurvey body(recording, b, out, statistics);
    for (std::size_t k = 0; k < frames; ++k) {
      body.add(k);
      progress(static_cast<double>(b * frames + k) / static_cast<double>(bodies * frames));
    }
    body.finish();
  }
  for (ValueStatistics& field : statistics) out.ranges.push_back(field.range());
  return out;
}

std::vector<ViewSeries> recorded_series(const Recording& recording) {
  const TrajectoryFile& file = recording.file();
  std::vector<ViewSeries> out;
  for (std::size_t b = 0; b < recording.bodies().size(); ++b) {
    const std::string group = "/bodies/" + recording.bodies()[b] + "/series";
    for (const std::string& name : file.children(group)) {
      const std::string path = group + "/" + name;
      const Hdf5Dims extents = file.row_extents(path);
      if (!extents.empty() && extents != Hdf5Dims{3}) continue;
      ViewSeries series{name, file.text(path, "units"), b, extents.empty() ? 1u : 3u, {}};
      std::replace(series.name.begin(), series.name.end(), '_', ' ');
      const std::vector<double> all = file.all_frames(path, extents);
      for (std::size_t k : recording.frames())
        series.numbers.insert(series.numbers.end(), all.begin() + k * series.components,
                              all.begin() + (k + 1) * series.components);
      out.push_back(series);
    }
  }
  return out;
}

}  // namespace bem
