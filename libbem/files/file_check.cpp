#include "files/file_check.hpp"

#include "files/isolated_process.hpp"

#include <filesystem>

namespace bem {
namespace {

constexpr int kSeconds = 5;                       // of processor time
constexpr std::uintmax_t kBytesPerSecond = 50e6;  // that any disk and processor manage

}  // namespace

void check_hdf5_file(const std::string& path, Hdf5Storage storage, ErrorCode code) {
  std::error_code unknown;
  const std::uintmax_t bytes = std::filesystem::file_size(path, unknown);
  if (unknown) throw Error(code, path + ": cannot be read (" + unknown.message() + ")");
  IsolatedLimits limits;
  limits.cpu_seconds = kSeconds + static_cast<int>(bytes / kBytesPerSecond);
  limits.wall_seconds = 10 * limits.cpu_seconds;
  const IsolatedResult result =
      run_isolated([&] { return hdf5_structure_fault(path, storage); }, limits);
  const std::string& fault = result.finished ? result.output : result.failure;
  if (!result.finished || !fault.empty())
    throw Error(code, path + ": its structure is damaged, or not one of this program: " + fault);
}

}  // namespace bem
