#pragma once

namespace bem {

/// The JSON schema of scenes with marks (scene/schema_marks.hpp) where something follows from the
/// code.
extern const char* const kSchemaText;

}  // namespace bem
