#include "page.hpp"

#include "packing.hpp"
#include "prediction.hpp"

#include <algorithm>

namespace bem {
namespace {

constexpr std::size_t kSegmentNumbers = 400000;  // of a segment, about; a page decodes it in 10 ms
constexpr std::size_t kFewestFrames = 8, kMostFrames = 64;  // in a segment

std::vector<std::uint32_t> corners(const std::vector<Triangle>& triangles) {
  std::vector<std::uint32_t> out;
  for (const Triangle& t : triangles)
    for (int corner : t) out.push_back(static_cast<std::uint32_t>(corner));
  return out;
}

nlohmann::ordered_json to_json(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

/// JSON that may stand in an HTML page, whatever names it holds.
std::string page_text(const nlohmann::ordered_json& json) {
  std::string out;
  for (char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace))
    out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

std::vector<float> obstacle_poses(const RecordedObstacle& obstacle,
                                  const std::vector<std::size_t>& frames) {
  std::vector<float> poses;
  for (std::size_t k : frames)
    Pose(obstacle.translations.data() + 3 * k, obstacle.rotations.data() + 9 * k).append_to(poses);
  return poses;
}

}  // namespace

PageData::PageData(const Recording& recording, const Survey& survey, std::string title)
    : recording_(recording),
      survey_(survey),
      title_(std::move(title)),
      series_(recorded_series(recording)),
      obstacles_(read_obstacles(recording.file())) {
  series_.insert(series_.end(), survey.measured.begin(), survey.measured.end());
  std::size_t numbers = 1;
  for (const std::string& body : recording.bodies()) numbers += 3 * recording.file().vertices(body);
  segment_frames_ = std::clamp(kSegmentNumbers / numbers, kFewestFrames, kMostFrames);
}

std::size_t PageData::segments() const {
  return (recording_.frames().size() + segment_frames_ - 1) / segment_frames_;
}

std::size_t PageData::segment_end(std::size_t index) const {
  return std::min((index + 1) * segment_frames_, recording_.frames().size());
}

nlohmann::ordered_json PageData::bodies_json() const {
  auto out = nlohmann::ordered_json::array();
  for (std::size_t b = 0; b < recording_.bodies().size(); ++b) {
    const std::string& name = recording_.bodies()[b];
    auto fields = nlohmann::ordered_json::array();
    for (const ViewField& field : recording_.fields())
      fields.push_back(recording_.has_field(b, field));
    out.push_back({{"name", name},
                   {"vertices", recording_.file().vertices(name)},
                   {"triangles", recording_.file().faces(name).size()},
                   {"origin", to_json(survey_.grids[b].origin())},
                   {"step", to_json(survey_.grids[b].step())},
                   {"fields", fields}});
  }
  return out;
}

nlohmann::ordered_json PageData::fields_json() const {
  auto out = nlohmann::ordered_json::array();
  for (std::size_t f = 0; f < recording_.fields().size(); ++f) {
    const ViewField& field = recording_.fields()[f];
    out.push_back({{"name", field.name},
                   {"label", field.label},
                   {"units", field.units},
                   {"stored", field.stored},
                   {"most", survey_.ranges[f].most},
                   {"top", survey_.ranges[f].top}});
  }
  return out;
}

nlohmann::ordered_json PageData::obstacles_json() const {
  auto out = nlohmann::ordered_json::array();
  for (const RecordedObstacle& o : obstacles_)
    if (o.is_plane)
      out.push_back({{"name", o.name}, {"point", to_json(o.point)}, {"normal", to_json(o.normal)}});
    else
      out.push_back({{"name", o.name},
                     {"vertices", o.vertices.size() / 3},
                     {"triangles", o.triangles.size()}});
  return out;
}

nlohmann::ordered_json PageData::series_json() const {
  auto out = nlohmann::ordered_json::array();
  for (const ViewSeries& s : series_)
    out.push_back(
        {{"name", s.name}, {"units", s.units}, {"body", s.body}, {"components", s.components}});
  return out;
}

nlohmann::ordered_json PageData::description() const {
  const Vec3 extent = survey_.bounds.step() * PositionGrid::kLevels;
  return {{"format", 1},
          {"title", title_},
          {"program", recording_.file().text("/", "program")},
          {"up", to_json(recording_.up())},
          {"frames", recording_.frames().size()},
          {"segmentFrames", segment_frames_},
          {"least", to_json(survey_.bounds.origin())},
          {"most", to_json(survey_.bounds.origin() + extent)},
          {"bodies", bodies_json()},
          {"fields", fields_json()},
          {"obstacles", obstacles_json()},
          {"series", series_json()}};
}

std::string PageData::scene() const {
  PackedSection section;
  section.add(recording_.times());
  std::vector<float> poses;
  for (std::size_t b = 0; b < recording_.bodies().size(); ++b) {
    section.add(corners(recording_.file().faces(recording_.bodies()[b])));
    for (std::size_t k = 0; k < recording_.frames().size(); ++k)
      recording_.pose(b, k).append_to(poses);
  }
  section.add(poses);
  for (const RecordedObstacle& o : obstacles_) {
    if (o.is_plane) continue;
    section.add(to_floats(o.vertices));
    section.add(corners(o.triangles));
    section.add(obstacle_poses(o, recording_.frames()));
  }
  return section.text();
}

std::string PageData::segment(std::size_t index) const {
  PackedSection section;
  for (std::size_t b = 0; b < recording_.bodies().size(); ++b) {
    PredictedFrames positions(3);
    for (std::size_t k = index * segment_frames_; k < segment_end(index); ++k)
      positions.add(
          survey_.grids[b].quantised(recording_.pose(b, k).to_local(recording_.positions(b, k))));
    positions.flush(section);
    for (std::size_t f = 0; f < recording_.fields().size(); ++f) {
      const ViewField& field = recording_.fields()[f];
      if (!field.stored || !recording_.has_field(b, field)) continue;
      PredictedFrames values(1);
      for (std::size_t k = index * segment_frames_; k < segment_end(index); ++k)
        values.add(ValueGrid{survey_.ranges[f].most}.quantised(recording_.values(b, field, k)));
      values.flush(section);
    }
  }
  return section.text();
}

std::string PageData::series() const {
  PackedSection section;
  for (const ViewSeries& s : series_) section.add(to_floats(s.numbers));
  return section.text();
}

/// Those of the shown frames.
std::string PageData::contacts() const {
  const RecordedContacts all = read_contacts(recording_.file());
  std::vector<std::uint32_t> ends;
  std::vector<double> points, forces;
  if (!all.ends.empty())
    for (std::size_t k : recording_.frames()) {
      const auto begin = static_cast<std::ptrdiff_t>(k == 0 ? 0 : 3 * all.ends[k - 1]);
      const auto end = static_cast<std::ptrdiff_t>(3 * all.ends[k]);
      points.insert(points.end(), all.points.begin() + begin, all.points.begin() + end);
      forces.insert(forces.end(), all.forces.begin() + begin, all.forces.begin() + end);
      ends.push_back(static_cast<std::uint32_t>(points.size() / 3));
    }
  PackedSection section;
  section.add(ends);
  section.add(to_floats(points));
  section.add(to_floats(forces));
  return section.text();
}

void write_page(const PageData& data, const std::string& shell, const PageSink& sink,
                const std::function<void(double)>& progress) {
  const std::size_t mark = shell.find(kDataMark);
  require(mark != std::string::npos, "the viewer has a place for data");
  const auto add = [&](const std::string& kind, const std::string& text) {
    sink("<script type=\"text/plain\" class=\"" + kind + "\">" + text + "</script>\n");
  };
  sink(shell.substr(0, mark));
  sink("<script type=\"application/json\" id=\"description\">" + page_text(data.description()) +
       "</script>\n");
  add("scene", data.scene());
  for (std::size_t k = 0; k < data.segments(); ++k) {
    add("frames", data.segment(k));
    progress(static_cast<double>(k + 1) / static_cast<double>(data.segments()));
  }
  add("series", data.series());
  add("contacts", data.contacts());
  sink(shell.substr(mark + std::string(kDataMark).size()));
}

}  // namespace bem
