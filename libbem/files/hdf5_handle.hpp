#pragma once

#include <string>
#include <utility>

#include <hdf5.h>

namespace bem {

/// Owner of one identifier of the HDF5 library; a negative one is the library's "failed".
class Hdf5Handle {
 public:
  using Close = herr_t (*)(hid_t);

  Hdf5Handle() = default;
  Hdf5Handle(hid_t id, Close close) : id_(id), close_(close) {}
  Hdf5Handle(Hdf5Handle&& other) noexcept
      : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
    std::swap(id_, other.id_);
    std::swap(close_, other.close_);
    return *this;
  }
  ~Hdf5Handle() {
    if (id_ >= 0) close_(id_);
  }

  hid_t get() const { return id_; }
  explicit operator bool() const { return id_ >= 0; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

/// Switches the library's own error messages off for this thread (they are a property of threads),
/// and its clean-up at exit. To be called before anything else of the library.
void silence_hdf5();

/// The innermost cause of the library's last failed call, in words; empty if it knows none. To be
/// asked before any other call, which would forget it.
std::string hdf5_cause();

}  // namespace bem
