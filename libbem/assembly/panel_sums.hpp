#pragma once

#include "assembly/panel_quadrature.hpp"
#include "base/aligned.hpp"
#include "kernels/radial_functions.hpp"
#include "kernels/radial_table.hpp"

namespace bem {

/// What is summed over the quadrature points of one triangle, for every lane (lag and stage
/// component): radial functions times the tensors of h = r/|r|. The constant normal of the triangle
/// is multiplied in afterwards (add_panel), which saves a third of the sums.
enum PanelSum : int {
  kSumA = 0,            ///< a phi_a                                  [3 shape functions]
  kSumB = kSumA + 3,    ///< -b h_i h_j phi_a                         [3][6: xx xy xz yy yz zz]
  kSumP = kSumB + 18,   ///< P h_i phi_a                              [3][3]
  kSumQ = kSumP + 9,    ///< Q h_i phi_a                              [3][3]
  kSumS = kSumQ + 9,    ///< S (h.n) h_i h_j phi_a                    [3][6]
  kSumF = kSumS + 18,   ///< F h_i                                    [3]
  kSumFr = kSumF + 3,   ///< r F h_i h_j                              [6]
  kSumM1 = kSumFr + 6,  ///< -M_1 (h.n)
  kSumM0 = kSumM1 + 1,  ///< r M_0
  kSumC0 = kSumM0 + 1,  ///< r kappa M_0(z1)
  kPanelSums = kSumC0 + 1
};

/// Prefactors of the kernels: 1/(4 pi mu), 1/(4 pi), 1/(4 pi c2^2), and lam per distance.
struct KernelScales {
  KernelScales(double shear_modulus, double shear_speed, double dt);
  double displacement, traction, body_force, lam_per_distance;
};

/// Working memory of one thread.
template <class T>
struct PanelScratch {
  static constexpr int kCoefficients = 59;
  /// Not a power of two, so that the rows fall into different cache sets.
  static constexpr int kStride = PointBatch::kCapacity + 64 / sizeof(T);
  alignas(64) T coefficient[kCoefficients][kStride];
  alignas(64) T local[PointBatch::kCapacity];
  const T* interval[PointBatch::kCapacity];
};

/// sums[PanelSum][padded lane] += the contribution of a batch of points. At singular batches the
/// static parts of P, Q, S are left out. Runs on the widest vector unit of the machine. Only the
/// first `functions` radial functions are summed: 2 gives u* alone.
void accumulate_panel(const LaneTable<double>& table, const KernelScales& scales,
                      const PointBatch& batch, const Vec3& normal, PanelScratch<double>& scratch,
                      double* sums, int functions = kRadialCount);
void accumulate_panel(const LaneTable<float>& table, const KernelScales& scales,
                      const PointBatch& batch, const Vec3& normal, PanelScratch<float>& scratch,
                      float* sums, int functions = kRadialCount);

/// Row blocks that a panel adds to: 3x3 blocks [entry][padded lane] of the three vertices of the
/// triangle (h: 9 entries, g: 6 entries xx xy xz yy yz zz) and of the body-force columns d, l (9
/// entries) and m (18).
template <class T>
struct PanelTarget {
  T* h[3];
  T* g[3];
  T* d;
  T* l;
  T* m;
};

/// Multiplies the normal in and adds the panel's 3x3 blocks to the row.
void add_panel(const double* sums, const Vec3& normal, int padded_lanes,
               const PanelTarget<double>& target);
void add_panel(const float* sums, const Vec3& normal, int padded_lanes,
               const PanelTarget<float>& target);

}  // namespace bem
