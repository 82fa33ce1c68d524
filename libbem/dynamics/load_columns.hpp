#pragma once

#include "model/elastic_system.hpp"

namespace bem {

/// Tractions on triangles, for several load cases, as inputs of the elastic system: integrated for
/// every node and lag. `assembler` is that of the system's model. O(N x loads).
InputColumns load_columns(const ElasticSystem& system, const LoadAssembler& assembler,
                          const std::vector<PanelLoad>& loads);

}  // namespace bem
