#include "dynamics/coarseness_watch.hpp"

#include <algorithm>

namespace bem {

void CoarsenessWatch::record(const Coarseness& mesh, const Eigen::VectorXd& displacement,
                             double time) {
  const FieldNorms norms = mesh.norms(displacement);
  largest_.deformation = std::max(largest_.deformation, norms.deformation);
  deformed_ = largest_.deformation > kLeastDeformation * mesh.area();
  if (!(norms.bubbles > largest_.bubbles)) return;
  largest_.bubbles = norms.bubbles;
  displacement_ = displacement;
  time_ = time;
}

}  // namespace bem
