#include "assembly/discretisation.hpp"

#include "algebra/decompositions.hpp"

#include <algorithm>
#include <cmath>

namespace bem {
double largest_symbol(const Scheme& scheme) {
  constexpr int kSamples = 64;
  constexpr double kWeaklyDamped = 0.31;  // real by imaginary part: exp(-z r/(c2 dt))
  double largest = 0;
  for (int i = 0; i <= kSamples; ++i) {
    const Eigen::VectorXcd values = eigenvalues(scheme.delta(std::polar(1.0, kPi * i / kSamples)));
    largest = std::max(largest, values.cwiseAbs().minCoeff());
    for (const Complex& z : values)
      if (z.real() <= kWeaklyDamped * std::abs(z.imag())) largest = std::max(largest, std::abs(z));
  }
  return largest;
}

double largest_wave_number(const Discretisation& d) {
  return largest_symbol(d.scheme) / (d.material.shear_speed() * d.dt);
}

}  // namespace bem
