#include "output/exported_file.hpp"
#include "output/hdf5_trajectory.hpp"
#include "output/obj_sequence.hpp"
#include "output/output_format.hpp"
#include "output/point_cache.hpp"
#include "output/vtp_sequence.hpp"

#include <algorithm>
#include <functional>

namespace bem {
namespace {

/// The format of a writer, which names and recognises its files.
template <class Writer>
OutputFormat format_of(const char* name, const char* folder) {
  return {name,
          folder,
          &Writer::is_output,
          &Writer::may_write,
          [](const std::string& directory, const TrajectoryContents& contents,
             std::size_t kept) -> std::unique_ptr<FrameWriter> {
            return std::make_unique<Writer>(directory, contents, kept);
          },
          &Writer::read_records};
}

template <const ExportKind& kKind>
OutputFormat export_format(const char* name) {
  OutputFormat format = format_of<ExportedAs<kKind>>(name, "");
  format.from_trajectory = true;
  return format;
}

bool is_from_trajectory(const OutputFormat* format) {
  return format->from_trajectory;
}

}  // namespace

const std::vector<const OutputFormat*>& output_formats() {
  static const OutputFormat obj = format_of<ObjSequence>("obj", kObjFolder),
                            hdf5 = format_of<Hdf5Trajectory>("hdf5", ""),
                            vtp = format_of<VtpSequence>("vtp", kVtpFolder),
                            pc2 = format_of<PointCache>("pc2", kPointCacheFolder),
                            usda = export_format<kUsdaExport>("usda"),
                            glb = export_format<kGlbExport>("glb");
  static const std::vector<const OutputFormat*> formats = {&obj, &hdf5, &vtp, &pc2, &usda, &glb};
  return formats;
}

std::vector<std::string> output_format_names() {
  std::vector<std::string> names;
  for (const OutputFormat* format : output_formats()) names.emplace_back(format->name);
  return names;
}

const OutputFormat* find_output_format(const std::string& name) {
  for (const OutputFormat* format : output_formats())
    if (format->name == name) return format;
  return nullptr;
}

std::vector<const OutputFormat*> with_trajectory(std::vector<const OutputFormat*> formats) {
  const OutputFormat* const hdf5 = find_output_format("hdf5");
  const auto made =
      std::stable_partition(formats.begin(), formats.end(), std::not_fn(is_from_trajectory));
  if (made != formats.end() && std::find(formats.begin(), made, hdf5) == made)
    formats.insert(formats.begin(), hdf5);
  return formats;
}

}  // namespace bem
