#pragma once

#include "constraints/contact_tolerances.hpp"
#include "constraints/placed_contacts.hpp"

#include <map>

namespace bem {

/// The contacts that a step is solved for, as detection after detection adds to them.
class KnownContacts {
 public:
  explicit KnownContacts(const ContactTolerances& tolerances)
      : most_replacements_(tolerances.search.most_replacements),
        most_views_(tolerances.search.most_views) {}

  void clear();

  /// What a detection finds at the end of a motion.
  struct Finding {
    std::vector<ContactKey> broken;  ///< whose gap is below what was asked for
    double deepest = 0;              ///< largest penetration [m]
  };
  static Finding judge(const std::vector<ContactPair>& found, double least_gap);

  struct Manner {
    double least_gap = 0;    ///< below it a contact that is not known yet is added [m]
    double broken = 0;       ///< below it a contact is broken [m]
    bool all_views = false;  ///< no view of what is known is forgotten any more
    bool friction = true;    ///< or none of it has any
  };
  /// Adds what is found and takes what is found again as it is seen now. What is not found any more
  /// stays, but for a vertex or edge that has left a triangle or edge over a ridge for another one
  /// of the same surface: it is held by that alone. Twice at most, so that nothing goes to and fro
  /// for ever. With all views a known contact that is broken as it is seen now is asked for as seen
  /// before, too, and one that is not broken stays as it is.
  void take(const std::vector<ContactPair>& found, const Manner& manner);
  /// Gives contacts that were taken without friction their own.
  void restore_friction() { take({}, {}); }

  bool empty() const { return pairs_.empty(); }
  const std::vector<ContactPair>& pairs() const { return pairs_; }  ///< ascending by key

 private:
  int most_replacements_, most_views_;
  std::map<ContactKey, ContactPair> known_;
  std::map<ContactKey, int> replaced_;  ///< how often
  std::map<ContactKey, int> views_;     ///< how many older ones
  std::vector<ContactPair> pairs_;
};

}  // namespace bem
