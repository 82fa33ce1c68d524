#pragma once

#include "compress/dense_family.hpp"
#include "compress/family_storage.hpp"

namespace bem {

// Uncompressed families in an HDF5 file: a dataset of `size` x `size` numbers for every matrix.
// Reading throws ErrorCode::archive if a number is not finite. T: float or double.

template <class T>
void write_dense(Hdf5File& file, const FamilyPlace& place, const DenseFamily<T>& family,
                 const BytesReport& report);

template <class T>
std::unique_ptr<MatrixFamily> read_dense(const Hdf5File& file, const FamilyPlace& place,
                                         std::size_t size, const BytesReport& report);

/// Some columns (ascending) as a ColumnFamily. The matrices are never in memory as a whole.
template <class T>
std::unique_ptr<MatrixFamily> read_dense_columns(const Hdf5File& file, const FamilyPlace& place,
                                                 std::size_t size, const std::vector<int>& columns,
                                                 const BytesReport& report);

template <class T>
void check_dense_numbers(const Hdf5File& file, const FamilyPlace& place, std::size_t size,
                         const BytesReport& report);

}  // namespace bem
