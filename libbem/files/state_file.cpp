#include "files/state_file.hpp"

#include "base/error.hpp"

#include <cerrno>
#include <cstring>
#include <string_view>
#include <vector>

#include <xxhash.h>

namespace bem {
namespace {

constexpr std::string_view kStateMark = "BEM state 0005\n\n";
static_assert(kStateMark.size() == 16);

void free_digest(XXH3_state_s* state) {
  XXH3_freeState(state);
}

std::string canonical(XXH128_hash_t hash) {
  XXH128_canonical_t bytes;
  XXH128_canonicalFromHash(&bytes, hash);
  return {reinterpret_cast<const char*>(bytes.digest), sizeof bytes.digest};
}

}  // namespace

StateWriter::StateWriter(const std::string& path)
    : pending_(path), digest_(XXH3_createState(), free_digest) {
  XXH3_128bits_reset(digest_.get());
  put(kStateMark.data(), kStateMark.size());
}

StateWriter::~StateWriter() = default;

void StateWriter::put(const void* data, std::size_t size) {
  constexpr std::size_t kPiece = 1 << 20;
  buffer_.append(static_cast<const char*>(data), size);
  if (buffer_.size() < kPiece) return;
  pending_.append(buffer_);
  buffer_.clear();
}

void StateWriter::bytes(void* data, std::size_t size) {
  XXH3_128bits_update(digest_.get(), data, size);
  put(data, size);
}

void StateWriter::refuse() const {
  throw Error(ErrorCode::internal, "the state that is saved is not one that is checked");
}

void StateWriter::commit() {
  const std::string digest = canonical(XXH3_128bits_digest(digest_.get()));
  put(digest.data(), digest.size());
  pending_.append(buffer_);
  pending_.commit();
}

StateReader::StateReader(const std::string& path)
    : path_(path), file_(std::fopen(path.c_str(), "rb"), std::fclose) {
  if (!file_) unreadable(std::string("cannot be read (") + std::strerror(errno) + ")");
  std::string mark(kStateMark.size(), '\0');
  if (std::fread(mark.data(), 1, mark.size(), file_.get()) != mark.size() || mark != kStateMark)
    unreadable("is not a checkpoint of this version of bemsim");
  // everything else, the last bytes of which are the digest
  const std::unique_ptr<XXH3_state_s, void (*)(XXH3_state_s*)> digest(XXH3_createState(),
                                                                      free_digest);
  XXH3_128bits_reset(digest.get());
  std::vector<char> piece(1 << 20);
  std::string held;  // bytes that may be the digest
  while (const std::size_t n = std::fread(piece.data(), 1, piece.size(), file_.get())) {
    held.append(piece.data(), n);
    if (held.size() <= sizeof(XXH128_canonical_t)) continue;
    const std::size_t done = held.size() - sizeof(XXH128_canonical_t);
    XXH3_128bits_update(digest.get(), held.data(), done);
    left_ += done;
    held.erase(0, done);
  }
  if (held != canonical(XXH3_128bits_digest(digest.get()))) unreadable("is damaged");
  std::fseek(file_.get(), static_cast<long>(kStateMark.size()), SEEK_SET);
}

void StateReader::bytes(void* data, std::size_t size) {
  if (size > left_ || std::fread(data, 1, size, file_.get()) != size) refuse();
  left_ -= size;
}

void StateReader::finish() {
  if (left_ > 0) refuse();
}

void StateReader::skip_section() {
  std::uint64_t size = 0;
  (*this)(size);
  check(size <= left_);
  go_to({place().at + static_cast<long>(size), left_ - size});
}

StateReader::Place StateReader::place() const {
  return {std::ftell(file_.get()), left_};
}

void StateReader::go_to(const Place& place) {
  if (std::fseek(file_.get(), place.at, SEEK_SET) != 0) refuse();
  left_ = place.left;
}

void StateReader::refuse() const {
  throw Error(ErrorCode::archive, path_ + ": does not hold the state of this scene");
}

void StateReader::unreadable(const std::string& what) const {
  throw Error(ErrorCode::invalid_input, path_ + ": " + what);
}

}  // namespace bem
