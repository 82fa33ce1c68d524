#pragma once

#include <complex>
#include <cstddef>

namespace bem {

/// Column-major matrix views handed to BLAS: pointer and leading dimension.
/// All calls are single-threaded: parallelism comes from tiles, so that results do not depend on
/// the number of threads.
enum class Side { left, right };
enum class TriangleShape { lower_unit, upper };

/// Makes BLIS use its AVX-512 kernels where the processor has them. BLIS 0.9 recognises only some
/// processor names and otherwise falls back to AVX2, at half the speed; BLIS_ARCH_TYPE set by the
/// user wins. Called by the functions below.
void prepare_blas();

/// c += alpha a b  (m x k times k x n).
template <class T>
void gemm(int m, int n, int k, T alpha, const T* a, int lda, const T* b, int ldb, T* c, int ldc);

/// b := t^{-1} b (left) or b t^{-1} (right) for a triangular matrix t.
template <class T>
void trsm(Side side, TriangleShape shape, int m, int n, const T* t, int ldt, T* b, int ldb);

/// b := t b for an upper triangular m x m matrix t.
template <class T>
void trmm_upper(int m, int n, const T* t, int ldt, T* b, int ldb);

}  // namespace bem
