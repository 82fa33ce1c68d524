#pragma once

#include "base/choices.hpp"

#include <optional>

namespace bem {

/// What happens to a mesh that is no closed surface of one solid.
enum class RepairMode {
  off,        ///< it is refused
  automatic,  ///< the gentlest step that works mends it
  wrap,       ///< every mesh is wrapped, whether it needs that or not
};

template <>
struct Choices<RepairMode> {
  static constexpr Choice<RepairMode> all[] = {
      {RepairMode::off, "off"}, {RepairMode::automatic, "auto"}, {RepairMode::wrap, "wrap"}};
};

/// How many vertices a mesh can be remeshed to.
inline constexpr int kFewestNodes = 12, kMostNodes = 1000000;

/// Lengths are relative to the size of a mesh, the diagonal of its bounding box.
struct RepairOptions {
  RepairMode mode = RepairMode::automatic;
  bool fill_all_holes = false;    ///< otherwise those alone that are a small part of the surface
  double weld_tolerance = 1e-6;   ///< vertices up to so far apart are joined; at most 0.1
  double thickness = 0.02;        ///< that sheets are given; in (0, 0.5]
  double alpha = 0.02;            ///< gaps narrower than this are bridged by wraps; in (0, 1]
  double offset = 0.002;          ///< distance of wraps from the surface; in (0, 0.5]
  std::optional<int> nodes;       ///< remesh to so many vertices
  double feature_angle_deg = 40;  ///< sharper edges stay edges when a mesh is remeshed; (0, 180]
  double unit = 1;                ///< of the mesh's lengths [m], in which the report speaks
};

/// Throws ErrorCode::usage if a number is out of its range.
void check_repair_options(const RepairOptions& options);

}  // namespace bem
