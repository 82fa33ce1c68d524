#include "assembly/discretisation.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace bem {
namespace {

constexpr std::pair<SpatialMethod, const char*> kMethods[] = {
    {SpatialMethod::collocation, "collocation"}, {SpatialMethod::galerkin, "galerkin"}};

}  // namespace

const char* spatial_method_name(SpatialMethod method) {
  for (const auto& [m, name] : kMethods)
    if (m == method) return name;
  return "";
}

SpatialMethod parse_spatial_method(const std::string& name) {
  for (const auto& [method, text] : kMethods)
    if (name == text) return method;
  throw Error(ErrorCode::usage,
              "unknown discretisation \"" + name + "\"; use galerkin or collocation");
}

double largest_symbol(const Scheme& scheme) {
  constexpr int kSamples = 64;
  constexpr double kWeaklyDamped = 0.31;  // real by imaginary part: exp(-z r/(c2 dt))
  double largest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const StageMatrixC delta = scheme.delta(std::polar(1.0, kPi * i / kSamples));
    const StageVectorC values = delta.eigenvalues();
    largest = std::max(largest, values.cwiseAbs().minCoeff());
    for (const Complex& z : values)
      if (z.real() <= kWeaklyDamped * std::abs(z.imag())) largest = std::max(largest, std::abs(z));
  }
  return largest;
}

}  // namespace bem
