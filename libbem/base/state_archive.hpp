#pragma once

#include "base/types.hpp"

#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <type_traits>
#include <utility>

namespace bem {

/// Saves the state of objects, or restores it into objects that were made in the same way. A class
/// with a state names its members once, for both directions:
///
///     void visit_state(StateArchive& state) { state(steps_, positions_, frame_); }
///
/// Numbers are stored as they are in memory: a state that is restored on the same kind of machine
/// is the same in every bit.
class StateArchive {
 public:
  virtual ~StateArchive() = default;
  /// false: what is visited is saved.
  virtual bool restores() const = 0;

  template <class... T>
  void operator()(T&... values) {
    (visit(values), ...);
  }

 protected:
  /// Saves `size` bytes, or overwrites them with what was saved.
  virtual void bytes(void* data, std::size_t size) = 0;

 private:
  template <class T, class = void>
  struct HasState : std::false_type {};
  template <class T>
  struct HasState<
      T, std::void_t<decltype(std::declval<T&>().visit_state(std::declval<StateArchive&>()))>>
      : std::true_type {};

  template <class T>
  void visit(T& value) {
    if constexpr (HasState<T>::value) {
      value.visit_state(*this);
    } else {
      static_assert(std::is_trivially_copyable_v<T> && !std::is_pointer_v<T>,
                    "a class with a state has visit_state()");
      bytes(&value, sizeof value);
    }
  }
  std::size_t count(std::size_t now) {
    std::uint64_t n = now;
    visit(n);
    return static_cast<std::size_t>(n);
  }

  void visit(std::string& text) {
    text.resize(count(text.size()));
    bytes(text.data(), text.size());
  }
  template <class Scalar, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
  void visit(Eigen::Matrix<Scalar, Rows, Cols, Options, MaxRows, MaxCols>& m) {
    const auto rows = static_cast<Eigen::Index>(count(static_cast<std::size_t>(m.rows())));
    const auto cols = static_cast<Eigen::Index>(count(static_cast<std::size_t>(m.cols())));
    if (restores()) m.resize(rows, cols);
    bytes(m.data(), static_cast<std::size_t>(m.size()) * sizeof(Scalar));
  }
  template <class A, class B>
  void visit(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }
  template <class T>
  void visit(std::vector<T>& values) {
    values.resize(count(values.size()));
    if constexpr (std::is_arithmetic_v<T>)
      bytes(values.data(), values.size() * sizeof(T));
    else
      for (T& value : values) visit(value);
  }
  template <class T>
  void visit(std::deque<T>& values) {
    values.resize(count(values.size()));
    for (T& value : values) visit(value);
  }
  template <class Key, class T>
  void visit(std::map<Key, T>& map) {
    std::vector<std::pair<Key, T>> entries(map.begin(), map.end());
    visit(entries);
    if (restores()) map = std::map<Key, T>(entries.begin(), entries.end());
  }
};

}  // namespace bem
