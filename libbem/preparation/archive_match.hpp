#pragma once

#include "archive/archive_reader.hpp"
#include "preparation/body_plan.hpp"

#include <string>

namespace bem {

// How an archive differs from what it is held to, for messages: "has another mesh: 42 vertices
// instead of 64". Empty if it does not.

/// Whether the archive is of a mesh that a repair or a remeshing has made of its file.
bool is_repaired(const Archive& archive);

/// From a mesh as it is in its file, times a factor, and from a material.
std::string difference_from_mesh(const Archive& archive, TriangleMesh mesh, double scale);
std::string difference_from_material(const Archive& archive, const Material& material);

/// From what `program` would write for a plan.
std::string difference_from_plan(const Archive& archive, const BodyPlan& plan,
                                 const std::string& program);

/// Whether the file is there and is what `program` would write for a plan. Throws ErrorCode::usage,
/// with the option "force" as the cure, for another file, but for an archive that is to be
/// replaced.
bool is_up_to_date(const std::string& path, const BodyPlan& plan, const std::string& program,
                   SettingStyle style, bool replaces_archives = false);

}  // namespace bem
