#pragma once

#include "model/slab_assembly.hpp"

namespace bem {

/// Matrices of a slab as builders take them. Factors of the slab are referred to.
template <class T>
struct SlabFamily {
  std::vector<typename MatrixSlab<T>::Matrix> matrices;  ///< rounded
  std::vector<FactoredMatrices> sums;                    ///< of factors, by block
  SlabParts<T> parts;
};

/// The lags of H and G.
template <class T>
SlabParts<T> h_parts(const MatrixSlab<T>& slab);
template <class T>
SlabParts<T> g_parts(const MatrixSlab<T>& slab);

/// D(0); `count` parts of lag 0 from `first` on.
template <class T>
SlabFamily<T> stiffness_parts(const MatrixSlab<T>& slab);
template <class T>
SlabFamily<T> initial_h_parts(const MatrixSlab<T>& slab, int first, int count);
template <class T>
SlabFamily<T> initial_g_parts(const MatrixSlab<T>& slab, int first, int count);

/// Stores the entries of a block, which a slab has columns for.
template <class T>
void multiply_out(const FarBlock& block, const Scheme& scheme, MatrixSlab<T>& slab);

}  // namespace bem
