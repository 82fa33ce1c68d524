#include "output/vtp_sequence.hpp"

#include "base/error.hpp"
#include "mesh/describe.hpp"
#include "render/render_mesh.hpp"

#include <cstdint>

namespace bem {
namespace {

static_assert(sizeof(Vec3) == 3 * sizeof(double), "vectors are stored without gaps");
static_assert(sizeof(Triangle) == 3 * sizeof(std::int32_t), "triangles are stored without gaps");

/// The numbers behind the XML: each array after its length in bytes, found by its offset.
class AppendedData {
 public:
  /// Appends an array; returns the element that describes it.
  template <class T>
  std::string add(const char* type, const char* name, int components,
                  const std::vector<T>& values) {
    const std::string element = std::string("<DataArray type=\"") + type + "\" Name=\"" + name +
                                "\" NumberOfComponents=\"" + std::to_string(components) +
                                "\" format=\"appended\" offset=\"" + std::to_string(bytes_.size()) +
                                "\"/>\n";
    const std::uint64_t size = values.size() * sizeof(T);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof size);
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return element;
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::vector<Vec3> deformation(const std::vector<Vec3>& rest, const BodyFrame& state) {
  std::vector<Vec3> out;
  out.reserve(rest.size());
  for (std::size_t v = 0; v < rest.size(); ++v)
    out.push_back(state.positions[v] - (state.frame.translation + state.frame.rotation * rest[v]));
  return out;
}

std::size_t face_count(const TrajectoryBody& body) {
  return body.render ? body.render->face_count() : body.triangles.size();
}

/// Where each face ends in the list of corners.
std::vector<std::int32_t> face_ends(const TrajectoryBody& body) {
  std::vector<std::int32_t> ends;
  for (std::size_t f = 1; f <= face_count(body); ++f)
    ends.push_back(static_cast<std::int32_t>(body.render ? body.render->starts[f] : 3 * f));
  return ends;
}

}  // namespace

VtpSequence::VtpSequence(const std::string& directory, const TrajectoryContents& contents,
                         std::size_t kept)
    : contents_((check_contents(contents), check_rest(contents.bodies), contents)),
      files_(directory, kVtpFolder, kVtpExtension, kept),
      list_(files_.folder() + "/" + kPvdFile, kept * contents.bodies.size()) {
  records_ = read_records(directory, contents_, 0);
}

std::string VtpSequence::contents_of(std::size_t body, const BodyFrame& state, double time) const {
  const TrajectoryBody& b = contents_.bodies[body];
  AppendedData data;
  std::string xml =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "<PolyData>\n"
      "<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">" +
      to_text(time) +
      "</DataArray>\n"
      "</FieldData>\n"
      "<Piece NumberOfPoints=\"" +
      std::to_string(b.vertices) +
      "\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"" +
      std::to_string(face_count(b)) + "\">\n";
  xml += "<PointData Vectors=\"deformation\">\n" +
         data.add("Float64", "deformation", 3, deformation(b.rest, state));
  for (std::size_t i = 0; i < b.fields.size(); ++i)
    xml += data.add("Float64", b.fields[i].name.c_str(), static_cast<int>(b.fields[i].components),
                    state.fields[i]);
  xml += "</PointData>\n<Points>\n" + data.add("Float64", "Points", 3, state.positions);
  xml += "</Points>\n<Polys>\n" +
         (b.render ? data.add("Int32", "connectivity", 1, b.render->corners)
                   : data.add("Int32", "connectivity", 1, b.triangles)) +
         data.add("Int32", "offsets", 1, face_ends(b));
  xml += "</Polys>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  return xml + data.bytes() + "\n</AppendedData>\n</VTKFile>\n";
}

void VtpSequence::write(const Frame& frame) {
  check_frame(contents_, frame);
  require(frame.index == files_.frames(), "frames are written in their order");
  std::vector<PvdCollection::Entry> parts;
  for (std::size_t i = 0; i < contents_.bodies.size(); ++i) {
    const std::string& name = contents_.bodies[i].name;
    parts.push_back(
        {files_.write(name, contents_of(i, frame.bodies[i], frame.time), records_[i]), name});
  }
  // Only then the list: what it names is there.
  records_.back().add(list_.add(frame.time, parts));
  files_.end_frame();
}

void VtpSequence::sync() {
  files_.sync(contents_.bodies);
  list_.sync();
}

bool VtpSequence::is_output(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  return is_frame_file_name(name, kVtpExtension) || name == kPvdFile;
}

FileRecords VtpSequence::read_records(const std::string& directory,
                                      const TrajectoryContents& contents, std::size_t frames) {
  const auto& bodies = contents.bodies;
  FileRecords records =
      FrameFiles::read_records(directory, kVtpFolder, bodies, kVtpExtension, frames);
  records.push_back({std::string(kVtpFolder) + "/" + kPvdFile, 0, {}});
  if (frames == 0) return records;
  const std::string path = directory + "/" + records.back().name;
  for (const std::string& text : PvdCollection::read(path, frames, bodies.size()))
    records.back().add(text);
  return records;
}

}  // namespace bem
