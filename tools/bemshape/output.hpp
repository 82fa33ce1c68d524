#pragma once

#include <string>

namespace bem {

/// Throws ErrorCode::usage for names of files that other programs take for something else than the
/// OBJ files that are written.
void check_output_name(const std::string& path);

}  // namespace bem
