#include "algebra/blas.hpp"

#include <cstdlib>

#include <blis.h>
#include <cblas.h>
#include <hwy/highway.h>

namespace bem {
namespace {

CBLAS_SIDE side_of(Side side) {
  return side == Side::left ? CblasLeft : CblasRight;
}
CBLAS_UPLO uplo_of(TriangleShape shape) {
  return shape == TriangleShape::upper ? CblasUpper : CblasLower;
}
CBLAS_DIAG diag_of(TriangleShape shape) {
  return shape == TriangleShape::upper ? CblasNonUnit : CblasUnit;
}

}  // namespace

void prepare_blas() {
  static const bool done = [] {
    if (hwy::SupportedTargets() & HWY_AVX3) setenv("BLIS_ARCH_TYPE", "skx", /*overwrite=*/0);
    return true;
  }();
  static_cast<void>(done);
  // BLIS builds its fast complex product on the real one (method 1m), but switches that on only for
  // the thread that used it first: on every other one products would be slow, and rounded
  // otherwise.
  thread_local const bool ready = [] {
    bli_init();
    bli_ind_enable_dt(BLIS_1M, BLIS_DCOMPLEX);
    return true;
  }();
  static_cast<void>(ready);
}

template <>
void gemm(int m, int n, int k, double alpha, const double* a, int lda, const double* b, int ldb,
          double* c, int ldc) {
  if (m == 0 || n == 0 || k == 0) return;
  prepare_blas();
  cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, alpha, a, lda, b, ldb, 1, c, ldc);
}

template <>
void gemm(int m, int n, int k, float alpha, const float* a, int lda, const float* b, int ldb,
          float* c, int ldc) {
  if (m == 0 || n == 0 || k == 0) return;
  prepare_blas();
  cblas_sgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, alpha, a, lda, b, ldb, 1, c, ldc);
}

template <>
void gemm(int m, int n, int k, std::complex<double> alpha, const std::complex<double>* a, int lda,
          const std::complex<double>* b, int ldb, std::complex<double>* c, int ldc) {
  prepare_blas();
  const std::complex<double> one = 1;
  cblas_zgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, m, n, k, &alpha, a, lda, b, ldb, &one, c,
              ldc);
}

template <>
void trsm(Side side, TriangleShape shape, int m, int n, const double* t, int ldt, double* b,
          int ldb) {
  prepare_blas();
  cblas_dtrsm(CblasColMajor, side_of(side), uplo_of(shape), CblasNoTrans, diag_of(shape), m, n, 1,
              t, ldt, b, ldb);
}

template <>
void trsm(Side side, TriangleShape shape, int m, int n, const std::complex<double>* t, int ldt,
          std::complex<double>* b, int ldb) {
  prepare_blas();
  const std::complex<double> one = 1;
  cblas_ztrsm(CblasColMajor, side_of(side), uplo_of(shape), CblasNoTrans, diag_of(shape), m, n,
              &one, t, ldt, b, ldb);
}

template <>
void trmm_upper(int m, int n, const double* t, int ldt, double* b, int ldb) {
  prepare_blas();
  cblas_dtrmm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, m, n, 1, t, ldt, b,
              ldb);
}

template <>
void trmm_upper(int m, int n, const std::complex<double>* t, int ldt, std::complex<double>* b,
                int ldb) {
  prepare_blas();
  const std::complex<double> one = 1;
  cblas_ztrmm(CblasColMajor, CblasLeft, CblasUpper, CblasNoTrans, CblasNonUnit, m, n, &one, t, ldt,
              b, ldb);
}

}  // namespace bem
