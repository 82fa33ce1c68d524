#pragma once

#include "archive/archive_reader.hpp"

#include <nlohmann/json_fwd.hpp>

namespace bem {

/// What is in an archive, without its matrices and arrays.
nlohmann::ordered_json info_json(const Archive& archive);

// Parts of it, of an archive or a model that is to become one.

nlohmann::ordered_json material_json(const Material& material);
nlohmann::ordered_json body_json(const BodyGeometry& geometry, ModelKind kind);
nlohmann::ordered_json scheme_json(const Discretisation& discretisation, double window);
nlohmann::ordered_json report_json(const ModelReport& report);
void add_codec(nlohmann::ordered_json& json, const Codec& codec);

}  // namespace bem
