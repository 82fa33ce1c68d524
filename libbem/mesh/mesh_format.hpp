#pragma once

#include <string>
#include <string_view>

namespace bem {

/// The well-known format of geometry that a file begins like although no reader is there for it,
/// e.g. "a Medit mesh"; empty otherwise.
std::string unreadable_format(std::string_view head);

/// Is this an archive in the ZIP format, whole from its first to its last entry, as 3MF files are?
bool is_whole_zip(std::string_view bytes);

/// "path: a Medit mesh is a format that is not supported; supported are OBJ, ...".
std::string unsupported_text(const std::string& path, const std::string& what);

}  // namespace bem
