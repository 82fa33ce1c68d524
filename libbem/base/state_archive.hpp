#pragma once

#include "base/types.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace bem {

/// Saves the state of objects, or restores it into objects that were made in the same way. A class
/// with a state names its members once, for both directions:
///
///     void visit_state(StateArchive& state) { state(steps_, positions_, frame_); }
///
/// Numbers are stored as they are in memory: a state that is restored on the same kind of machine
/// is the same in every bit.
///
/// What is restored may come from anywhere. Vectors and matrices must have the size that the object
/// has already, unless they are named resizable(); numbers must be finite, unless they are named
/// any_numbers(); no size is believed that what is left of the data could not fill. What else a
/// class relies on, it checks: state.check(newest_ < ring_.size()).
class StateArchive {
 public:
  virtual ~StateArchive() = default;
  /// false: what is visited is saved.
  virtual bool restores() const = 0;
  /// Bytes that can still be restored.
  virtual std::uint64_t left() const = 0;

  template <class... T>
  void operator()(T&... values) {
    (visit(values), ...);
  }
  /// Vectors and matrices that come back in the size that they were saved with. Elements of vectors
  /// that are objects take at least 8 bytes each.
  template <class... T>
  void resizable(T&... values) {
    (visit_resizable(values), ...);
  }
  /// Numbers that may be infinite or undefined.
  template <class... T>
  void any_numbers(T&... values) {
    (visit_raw(values), ...);
  }
  /// Refuses what is restored if it is not right.
  void check(bool right) const {
    if (restores() && !right) refuse();
  }

 protected:
  /// Saves `size` bytes, or overwrites them with what was saved.
  virtual void bytes(void* data, std::size_t size) = 0;
  /// Throws that the data are no state of these objects.
  [[noreturn]] virtual void refuse() const = 0;

 private:
  template <class T, class = void>
  struct HasState : std::false_type {};
  template <class T>
  struct HasState<
      T, std::void_t<decltype(std::declval<T&>().visit_state(std::declval<StateArchive&>()))>>
      : std::true_type {};

  template <class T>
  void visit_raw(T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>,
                  "a class with a state has visit_state()");
    bytes(&value, sizeof value);
  }
  template <class T>
  void visit(T& value) {
    if constexpr (HasState<T>::value) {
      value.visit_state(*this);
    } else {
      visit_raw(value);
      if constexpr (std::is_floating_point_v<T>) check(std::isfinite(value));
    }
  }
  void visit(bool& value) {
    unsigned char byte = value ? 1 : 0;
    visit_raw(byte);
    check(byte <= 1);
    value = byte == 1;
  }
  /// A size as it was saved, at most that of `bytes_each` times what is left.
  std::size_t count(std::size_t now, std::size_t bytes_each) {
    std::uint64_t n = now;
    visit_raw(n);
    check(n <= left() / bytes_each);
    return static_cast<std::size_t>(n);
  }
  void same_count(std::size_t now) {
    std::uint64_t n = now;
    visit_raw(n);
    check(n == now);
  }

  template <class C>
  void visit_elements(C& values) {
    for (auto& value : values) visit(value);
  }
  template <class T>
  void visit_elements(std::vector<T>& values) {
    if constexpr (!std::is_arithmetic_v<T>) {
      for (T& value : values) visit(value);
    } else {
      static_assert(!std::is_same_v<T, bool>, "a vector of bool has no elements to refer to");
      bytes(values.data(), values.size() * sizeof(T));
      if constexpr (std::is_floating_point_v<T>)
        for (T value : values) check(std::isfinite(value));
    }
  }
  template <class C>
  void visit_resizable_container(C& values) {
    using T = typename C::value_type;
    values.resize(count(values.size(), std::is_arithmetic_v<T> ? sizeof(T) : 8));
    visit_elements(values);
  }

  void visit(std::string& text) { visit_resizable_container(text); }
  template <class T>
  void visit(std::deque<T>& values) {
    visit_resizable_container(values);
  }
  template <class T, std::size_t n>
  void visit(std::array<T, n>& values) {
    visit_elements(values);
  }
  template <class T>
  void visit(std::vector<T>& values) {
    same_count(values.size());
    visit_elements(values);
  }
  template <class T>
  void visit_resizable(std::vector<T>& values) {
    visit_resizable_container(values);
  }
  template <class T>
  void visit_resizable(std::vector<std::vector<T>>& values) {
    values.resize(count(values.size(), 8));
    for (std::vector<T>& inner : values) visit_resizable(inner);
  }
  template <class Key, class T>
  void visit(std::map<Key, T>& map) {
    std::vector<std::pair<Key, T>> entries(map.begin(), map.end());
    visit_resizable_container(entries);
    if (restores()) map = std::map<Key, T>(entries.begin(), entries.end());
  }
  template <class A, class B>
  void visit(std::pair<A, B>& pair) {
    (*this)(pair.first, pair.second);
  }

  template <class Scalar, int Rows, int Cols, int Options, int MaxRows, int MaxCols>
  void visit(Eigen::Matrix<Scalar, Rows, Cols, Options, MaxRows, MaxCols>& m) {
    same_count(static_cast<std::size_t>(m.rows()));
    same_count(static_cast<std::size_t>(m.cols()));
    visit_entries(m);
  }
  template <class Scalar, int Rows, int Cols>
  void visit_resizable(Eigen::Matrix<Scalar, Rows, Cols>& m) {
    const std::size_t rows = count(static_cast<std::size_t>(m.rows()), 1);
    const std::size_t cols = count(static_cast<std::size_t>(m.cols()), 1);
    check((Rows == Eigen::Dynamic || rows == std::size_t(Rows)) &&
          (Cols == Eigen::Dynamic || cols == std::size_t(Cols)) &&
          (rows == 0 || cols <= left() / sizeof(Scalar) / rows));
    if (restores()) m.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(cols));
    visit_entries(m);
  }
  template <class Matrix>
  void visit_entries(Matrix& m) {
    bytes(m.data(), static_cast<std::size_t>(m.size()) * sizeof(typename Matrix::Scalar));
    check(m.allFinite());
  }
};

}  // namespace bem
