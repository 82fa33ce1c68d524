#pragma once

#include "base/types.hpp"

#include <fstream>
#include <string>

#include <nlohmann/json.hpp>

namespace bem_test {

using nlohmann::json;

inline json load_reference(const std::string& name) {
  std::ifstream file(std::string(BEM_TEST_DATA) + "/reference/" + name);
  if (!file) throw std::runtime_error("no reference file " + name);
  return json::parse(file);
}

/// Reference numbers are decimal strings of 32 digits or plain numbers.
inline double number(const json& j) {
  return j.is_string() ? std::stod(j.get<std::string>()) : j.get<double>();
}
inline bem::Complex complex(const json& j) {
  return j.is_array() ? bem::Complex(number(j[0]), number(j[1])) : bem::Complex(number(j));
}
inline bem::Vec3 vec3(const json& j) {
  return {number(j[0]), number(j[1]), number(j[2])};
}
inline Eigen::Matrix3cd matrix3(const json& j) {
  Eigen::Matrix3cd m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m(r, c) = complex(j[r][c]);
  return m;
}

}  // namespace bem_test
