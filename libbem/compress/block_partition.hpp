#pragma once

#include "algebra/matrix_form.hpp"
#include "base/types.hpp"

#include <vector>

namespace bem {

/// A rectangle of a matrix between two clusters of nodes [row_begin, row_end) x [column_begin,
/// column_end).
struct NodeBlock {
  int row_begin = 0, row_end = 0, column_begin = 0, column_end = 0;
  bool far = false;  ///< the clusters are far apart compared with the smaller one's size

  int rows() const { return row_end - row_begin; }
  int columns() const { return column_end - column_begin; }
};

/// What decides on the blocks.
struct PartitionOptions {
  int leaf = 64;            ///< clusters of at most so many nodes are not divided
  int slab = 128;           ///< no block has more rows (nodes)
  double admissible = 4.0;  ///< far: smaller diameter <= admissible * distance
};

/// A range of rows that holds whole blocks.
struct Slab {
  int row_begin = 0, row_end = 0;  ///< nodes
  std::vector<NodeBlock> blocks;   ///< sorted by rows, then columns
};

/// Tiles the square matrix of all pairs of nodes with blocks, slab by slab. `nodes`: in the order
/// of recursive bisection (mesh/bisection.hpp), whose ranges are the clusters. O(n) blocks.
std::vector<Slab> make_partition(const std::vector<Vec3>& nodes, const PartitionOptions& options);

/// The blocks that a matrix of this form stores: of a symmetric one those on the diagonal, whose
/// rows and columns are the same, and those to the right of them.
std::vector<Slab> with_form(std::vector<Slab> slabs, MatrixForm form);

/// A slab to learn about such matrices from: one of the middle, or of symmetric ones the first,
/// whose blocks are those of whole rows.
const Slab& typical_slab(const std::vector<Slab>& slabs, MatrixForm form);

}  // namespace bem
