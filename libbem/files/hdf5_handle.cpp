#include "files/hdf5_handle.hpp"

namespace bem {
namespace {

herr_t take_innermost(unsigned index, const H5E_error2_t* error, void* out) {
  if (index == 0 && error->desc) *static_cast<std::string*>(out) = error->desc;
  return 0;
}

}  // namespace

void silence_hdf5() {
  // At exit the library would close files once more that it could not close because of a full disk,
  // and crash. Files are closed by their owners.
  static const herr_t without_exit_handler = H5dont_atexit();
  static_cast<void>(without_exit_handler);
  thread_local const herr_t done = H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  static_cast<void>(done);
}

std::string hdf5_cause() {
  std::string cause;
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_innermost, &cause);
  // Failures of the operating system come with pointers and times of day; the message is enough.
  const std::string marker = "error message = '";
  const std::size_t begin = cause.find(marker);
  if (begin == std::string::npos) return cause;
  const std::size_t text = begin + marker.size();
  return cause.substr(text, cause.find('\'', text) - text);
}

}  // namespace bem
