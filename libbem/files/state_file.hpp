#pragma once

#include "base/state_archive.hpp"
#include "files/pending_file.hpp"

#include <cstdio>
#include <memory>
#include <string>

struct XXH3_state_s;

namespace bem {

/// A file that holds a state: a mark with the version of the layout, what was visited in its order,
/// and the XXH3-128 digest of all that.
///
/// Saves a state; the file appears under its name when commit() has been called. Everything here
/// throws ErrorCode::resources.
class StateWriter : public StateArchive {
 public:
  explicit StateWriter(const std::string& path);
  ~StateWriter() override;
  bool restores() const override { return false; }
  std::uint64_t left() const override { return UINT64_MAX; }
  void commit();

 protected:
  void bytes(void* data, std::size_t size) override;
  [[noreturn]] void refuse() const override;

 private:
  void put(const void* data, std::size_t size);

  PendingFile pending_;
  std::string buffer_;  ///< not yet written
  std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> digest_;
};

/// Restores a state in the order in which it was saved. Throws ErrorCode::invalid_input if the file
/// is missing, foreign, of another version of the layout or damaged; the digest is checked before
/// anything is given out. Throws ErrorCode::archive if it is whole, but holds something else than a
/// state of the objects that are restored.
class StateReader : public StateArchive {
 public:
  explicit StateReader(const std::string& path);
  bool restores() const override { return true; }
  std::uint64_t left() const override { return left_; }
  /// Checks that all of the state has been visited.
  void finish();

  /// Passes by what visit_section() has saved.
  void skip_section();
  /// A place in the file that can be gone back to.
  struct Place {
    long at = 0;
    std::uint64_t left = 0;
  };
  Place place() const;
  void go_to(const Place& place);

 protected:
  void bytes(void* data, std::size_t size) override;
  [[noreturn]] void refuse() const override;

 private:
  [[noreturn]] void unreadable(const std::string& what) const;

  std::string path_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::uint64_t left_ = 0;  ///< bytes of the state
};

}  // namespace bem
