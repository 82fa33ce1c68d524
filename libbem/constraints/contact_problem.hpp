#pragma once

#include "constraints/mechanism.hpp"
#include "constraints/placed_contacts.hpp"
#include "friction/friction_problem.hpp"

namespace bem {

/// The linearised contact problem of a set of contacts, about the bodies as they are, and what it
/// takes to eliminate the joints.
class ContactProblem {
 public:
  /// Bodies must have been updated with the contacts' nodes.
  ContactProblem(const PlacedContacts& contacts, const std::vector<Body>& bodies,
                 std::vector<Mechanism>& mechanisms);

  /// Compliance among the contacts with the joints held; q is that of the last linearise().
  const FrictionProblem& friction() const { return friction_; }
  /// Per contact |W_ii| / sqrt(3) [m/N].
  const Eigen::VectorXd& scale() const { return scale_; }

  /// Sets q such that the displacements are u (3 per contact) under the forces r, and change as the
  /// joints (by mechanism) move by what the force changes `joint_changes` bring about.
  void linearise(const Eigen::VectorXd& u, const Eigen::VectorXd& r,
                 const std::vector<Eigen::VectorXd>& joint_changes);
  /// Changes of a mechanism's joint forces that go with a change of the contact forces.
  Eigen::VectorXd joint_change(std::size_t mechanism, const Eigen::VectorXd& force_change) const;

 private:
  struct Part {
    std::vector<int> contacts;           ///< that touch a mechanism, ascending
    Eigen::MatrixXd compliance;          ///< among them, joints eliminated
    Eigen::MatrixXd joint_change;        ///< W_bb^{-1} W_bc
    Eigen::MatrixXd contacts_by_joints;  ///< W_cb
  };
  static Part make_part(const PlacedContacts& contacts, const std::vector<Body>& bodies,
                        Mechanism& mechanism);
  void assemble(const PlacedContacts& contacts);

  std::vector<Part> parts_;  ///< by mechanism
  FrictionProblem friction_;
  Eigen::VectorXd scale_;
};

}  // namespace bem
