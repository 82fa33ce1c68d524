#include "assembly/triangle_cell.hpp"

namespace bem {

TriangleCell::TriangleCell(const std::array<Vec3, 3>& corners) : corners_(corners) {
  measure();
}

void TriangleCell::measure() {
  longest_side_ = 0;
  longest_ = length(0);
  for (int i = 1; i < 3; ++i)
    if (const double l = length(i); l > longest_) {
      longest_ = l;
      longest_side_ = i;
    }
}

TriangleCell TriangleCell::half(int index) const {
  const int first = longest_side_, second = (first + 1) % 3;
  const int moved = index == 0 ? second : first;
  TriangleCell c = *this;
  for (int a = 0; a < 3; ++a)
    c.barycentric_[moved][a] = 0.5 * (barycentric_[first][a] + barycentric_[second][a]);
  c.corners_[moved] = 0.5 * (corners_[first] + corners_[second]);
  c.part_ = 0.5 * part_;
  c.measure();
  return c;
}

Eigen::Matrix<double, 6, 6> TriangleCell::shapes() const {
  // with L_a = sum_k c_ka l_k and l_k^2 = l_k - l_k l_m - l_k l_n
  const auto& c = barycentric_;
  Eigen::Matrix<double, 6, 6> out = Eigen::Matrix<double, 6, 6>::Zero();
  for (int a = 0; a < 3; ++a) {
    const int b = (a + 1) % 3;
    for (int k = 0; k < 3; ++k) {
      const int m = (k + 1) % 3;
      out(a, k) = c[k][a];
      out(3 + a, k) = 4 * c[k][a] * c[k][b];
      out(3 + a, 3 + k) = -(c[k][a] - c[m][a]) * (c[k][b] - c[m][b]);
    }
  }
  return out;
}

}  // namespace bem
