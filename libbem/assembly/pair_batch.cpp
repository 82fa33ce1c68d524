#include "assembly/pair_batch.hpp"

namespace bem {

void PairBatch::pad() {
  for (int q = size; q < padded_size(); ++q) {
    for (auto& component : r) component[q] = component[0];
    for (auto& shape : moving) shape[q] = 0;
  }
}

}  // namespace bem
