#pragma once

#include "base/error.hpp"
#include "base/state_archive.hpp"

namespace bem {

/// Counts the bytes that a state takes, and keeps nothing.
class StateMeter : public StateArchive {
 public:
  bool restores() const override { return false; }
  std::uint64_t count() const { return count_; }
  std::uint64_t left() const override { return UINT64_MAX; }

 protected:
  void bytes(void* /*data*/, std::size_t size) override { count_ += size; }
  [[noreturn]] void refuse() const override {
    throw Error(ErrorCode::internal, "a state that is measured is not checked");
  }

 private:
  std::uint64_t count_ = 0;
};

/// `visit(state)` with its size in front, so that a reader may pass it by without knowing what it
/// is of (StateReader::skip_section). What is restored must take exactly that size.
template <class Visit>
void visit_section(StateArchive& state, const Visit& visit) {
  std::uint64_t size = 0;
  if (!state.restores()) {
    StateMeter meter;
    visit(static_cast<StateArchive&>(meter));
    size = meter.count();
  }
  state(size);
  const std::uint64_t before = state.left();
  state.check(size <= before);
  visit(state);
  state.check(before - state.left() == size);
}

}  // namespace bem
