#include "output.hpp"

#include "base/error.hpp"

#include <filesystem>

namespace bem {

void check_output_name(const std::string& path) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension.empty() || extension == ".obj" || extension == ".OBJ") return;
  throw Error(ErrorCode::usage,
              "-o " + path + ": bemshape writes OBJ files; give a name that ends with .obj");
}

}  // namespace bem
