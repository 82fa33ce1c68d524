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
    bool all_views = false;  ///< old views of known contacts are kept
    bool friction = true;    ///< false: contacts are taken without their friction
  };
  /// Adds the contacts of a detection to the known ones. A known contact that is found again gets
  /// the points and the normal of this detection (its new view); one that is not found again keeps
  /// its own. There is one exception: where a vertex or edge has gone over a ridge, from one
  /// triangle or edge of a surface to another one, the new contact replaces the old one. That
  /// happens at most `most_replacements` times to a contact, so that two contacts cannot replace
  /// each other for ever. With `all_views` a known contact whose new view is broken is asked for in
  /// its old views as well, and one whose new view is not broken keeps its old view.
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
