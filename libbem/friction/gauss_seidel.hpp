#pragma once

#include "friction/contact_set.hpp"
#include "friction/one_contact.hpp"

namespace bem {

/// Nonsmooth Gauss-Seidel: contact by contact, the contact law is solved exactly with the other
/// forces as they are [Jean 1999].
class GaussSeidel {
 public:
  explicit GaussSeidel(const ContactSet& set);

  /// One sweep over all contacts. Returns the norm of the scaled natural map of every contact
  /// before its own solve, an estimate of the error that costs nothing.
  double sweep(Eigen::VectorXd& forces) const;

 private:
  const ContactSet& set_;
  std::vector<OneContact> contacts_;
  std::vector<Mat3> own_;  ///< diagonal blocks
};

/// Staggered projections [Kaufman et al. 2008]: the normal problem with fixed friction forces and
/// the friction problem with fixed bounds mu r_n in turns, each by projected Gauss-Seidel.
class StaggeredProjections {
 public:
  explicit StaggeredProjections(const ContactSet& set);

  /// Both problems once, each with at most `max_sweeps` sweeps; returns the sweeps made.
  int pass(Eigen::VectorXd& forces, int max_sweeps) const;

 private:
  double normal_sweep(Eigen::VectorXd& forces) const;
  double friction_sweep(Eigen::VectorXd& forces) const;

  const ContactSet& set_;
  std::vector<double> normal_step_, friction_step_;  ///< force per displacement
};

}  // namespace bem
