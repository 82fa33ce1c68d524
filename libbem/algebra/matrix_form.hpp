#pragma once

namespace bem {

/// Which entries of a square matrix are computed and stored.
enum class MatrixForm {
  general,   ///< all
  symmetric  ///< on and to the right of the diagonal (blocks); the others follow from them
};

}  // namespace bem
