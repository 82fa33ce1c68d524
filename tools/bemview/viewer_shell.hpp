#pragma once

#include <string>

namespace bem {

/// The page without data: HTML, styles and the bundled program of tools/bemview/viewer, with
/// kDataMark where the data belong. viewer/bundle.mjs writes the source.
const std::string& viewer_shell();

}  // namespace bem
