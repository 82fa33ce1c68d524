#include "compress/dense_storage.hpp"

#include "base/finite.hpp"
#include "base/parallel.hpp"

#include <algorithm>

namespace bem {
namespace {

template <class T>
std::size_t rows_of_piece(std::size_t columns) {
  return std::max<std::size_t>(1, kPieceBytes / (columns * sizeof(T)));
}

/// Calls f(first, rows) for pieces of a matrix, and reports each.
template <class T, class F>
void for_each_piece(std::size_t size, const BytesReport& report, const F& f) {
  const std::size_t piece = rows_of_piece<T>(size);
  for (std::size_t first = 0; first < size; first += piece) {
    const std::size_t rows = std::min(piece, size - first);
    f(first, rows);
    report(rows * size * sizeof(T));
  }
}

/// Rows of a matrix, which must be finite.
template <class T>
void read_rows(const Hdf5File& file, const std::string& path, std::size_t size, std::size_t first,
               std::size_t rows, T* out) {
  file.read_rows(path, first, rows, out);
  if (!all_finite(out, rows * size))
    throw Error(ErrorCode::archive, file.path() + ": " + path + " has a number that is not finite");
}

}  // namespace

template <class T>
void write_dense(Hdf5File& file, const FamilyPlace& place, const DenseFamily<T>& family,
                 const BytesReport& report) {
  for (int k = 0; k < family.count(); ++k) {
    const DenseStore<T>& store = family.matrix(k);
    file.create_dataset(place.paths[k], hdf5_type<T>(), {store.rows(), store.columns()});
    for_each_piece<T>(store.rows(), report, [&](std::size_t first, std::size_t rows) {
      file.write_rows(place.paths[k], first, rows, store.row(first));
    });
  }
}

template <class T>
std::unique_ptr<MatrixFamily> read_dense(const Hdf5File& file, const FamilyPlace& place,
                                         std::size_t size, const BytesReport& report) {
  auto family = std::make_unique<DenseFamily<T>>(size, place.count());
  for (int k = 0; k < place.count(); ++k)
    for_each_piece<T>(size, report, [&](std::size_t first, std::size_t rows) {
      read_rows(file, place.paths[k], size, first, rows, family->matrix(k).row(first));
    });
  return family;
}

template <class T>
std::unique_ptr<MatrixFamily> read_dense_columns(const Hdf5File& file, const FamilyPlace& place,
                                                 std::size_t size, const std::vector<int>& columns,
                                                 const BytesReport& report) {
  auto family = std::make_unique<ColumnFamily<T>>(size, columns, place.count());
  std::vector<T> piece(std::min(size, rows_of_piece<T>(size)) * size);
  for (int k = 0; k < place.count(); ++k)
    for_each_piece<T>(size, report, [&](std::size_t first, std::size_t rows) {
      read_rows(file, place.paths[k], size, first, rows, piece.data());
      parallel_for(columns.size(), [&](std::size_t c) {
        T* column = family->matrix(k).column(c) + first;
        for (std::size_t i = 0; i < rows; ++i)
          column[i] = piece[i * size + static_cast<std::size_t>(columns[c])];
      });
    });
  return family;
}

template <class T>
void check_dense_numbers(const Hdf5File& file, const FamilyPlace& place, std::size_t size,
                         const BytesReport& report) {
  std::vector<T> piece(std::min(size, rows_of_piece<T>(size)) * size);
  for (const std::string& path : place.paths)
    for_each_piece<T>(size, report, [&](std::size_t first, std::size_t rows) {
      read_rows(file, path, size, first, rows, piece.data());
    });
}

#define BEM_INSTANTIATE(T)                                                                  \
  template void write_dense(Hdf5File&, const FamilyPlace&, const DenseFamily<T>&,           \
                            const BytesReport&);                                            \
  template std::unique_ptr<MatrixFamily> read_dense<T>(const Hdf5File&, const FamilyPlace&, \
                                                       std::size_t, const BytesReport&);    \
  template std::unique_ptr<MatrixFamily> read_dense_columns<T>(                             \
      const Hdf5File&, const FamilyPlace&, std::size_t, const std::vector<int>&,            \
      const BytesReport&);                                                                  \
  template void check_dense_numbers<T>(const Hdf5File&, const FamilyPlace&, std::size_t,    \
                                       const BytesReport&);
BEM_INSTANTIATE(float)
BEM_INSTANTIATE(double)
#undef BEM_INSTANTIATE

}  // namespace bem
