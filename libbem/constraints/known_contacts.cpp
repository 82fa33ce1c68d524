#include "constraints/known_contacts.hpp"

#include <algorithm>
#include <limits>
#include <set>

namespace bem {
namespace {

/// What touches, whatever it touches of the other surface.
ContactKey mover(ContactKey key) {
  key.feature_b = -1;
  key.view = 0;
  return key;
}

ContactKey last_view(ContactKey key) {
  key.view = std::numeric_limits<int>::max();
  return key;
}

/// Does the surface fall away from the old contact's plane towards the new one, as over a ridge? In
/// a valley both hold.
bool leaves(const Contact& old, const Contact& now) {
  return old.normal.dot(now.point - old.point) <= 0;
}

}  // namespace

void KnownContacts::clear() {
  known_.clear();
  replaced_.clear();
  views_.clear();
  pairs_.clear();
}

KnownContacts::Finding KnownContacts::judge(const std::vector<ContactPair>& found,
                                            double least_gap) {
  Finding out;
  for (const ContactPair& pair : found) {
    if (pair.contact.gap_end < least_gap) out.broken.push_back(pair.contact.key);
    out.deepest = std::max(out.deepest, -pair.contact.gap_end);
  }
  return out;
}

void KnownContacts::take(const std::vector<ContactPair>& found, const Manner& manner) {
  std::set<ContactKey> seen;
  for (const ContactPair& pair : found) seen.insert(pair.contact.key);
  std::map<ContactKey, std::vector<ContactKey>> left;  // by mover
  for (const auto& [key, pair] : known_)
    if (key.view == 0 && seen.count(key) == 0 && replaced_[key] < most_replacements_)
      left[mover(key)].push_back(key);
  for (const ContactPair& pair : found) {
    const ContactKey& key = pair.contact.key;
    const auto it = known_.find(key);
    const auto old = left.find(mover(key));
    bool replaces = false;
    if (it == known_.end() && old != left.end())
      for (const ContactKey& gone : old->second) {
        const auto before = known_.find(gone);
        if (before == known_.end() || !leaves(before->second.contact, pair.contact)) continue;
        // its older views are right behind it
        known_.erase(before, known_.upper_bound(last_view(gone)));
        ++replaced_[gone];
        replaces = true;
      }
    if (it == known_.end() && !replaces && pair.contact.gap_end >= manner.least_gap) continue;
    if (it != known_.end() && manner.all_views) {
      if (pair.contact.gap_end >= manner.broken) continue;
      ContactPair before = it->second;
      before.contact.key.view = 1 + views_[key]++ % most_views_;
      known_[before.contact.key] = before;
    }
    known_[key] = pair;
  }
  pairs_.clear();
  for (const auto& [key, pair] : known_) {
    pairs_.push_back(pair);
    if (!manner.friction) pairs_.back().friction = 0;
  }
}

}  // namespace bem
