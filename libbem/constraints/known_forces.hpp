#pragma once

#include "constraints/placed_contacts.hpp"

#include <map>

namespace bem {

/// The contact forces that were found last, by contact: what the next solution starts from.
class KnownForces {
 public:
  /// World forces on the sides a of contacts [N]: that of the same contact where there was one. A
  /// vertex or edge that has left triangles or edges of a surface for others of it takes their
  /// forces along, in equal parts. Others start from zero.
  std::vector<Vec3> start_for(const std::vector<ContactPair>& pairs) const;
  /// Forgets the others.
  void set(const std::vector<ContactPair>& pairs, const std::vector<Vec3>& forces);

  void visit_state(StateArchive& state) { state(forces_); }

 private:
  std::map<ContactKey, Vec3> forces_;
};

}  // namespace bem
