#include "simulation/known_contacts.hpp"

#include <algorithm>
#include <set>

namespace bem {
namespace {

/// What touches, whatever it touches of the other surface.
ContactKey mover(ContactKey key) {
  key.feature_b = -1;
  return key;
}

/// Does the surface fall away from the old contact's plane towards the new one, as over a ridge? In
/// a valley both hold.
bool leaves(const Contact& old, const Contact& now) {
  return old.normal.dot(now.point - old.point) <= 0;
}

/// A contact half way between two views of the same.
ContactPair halfway(const ContactPair& old, ContactPair now) {
  const auto mix = [](SurfacePoint& to, const SurfacePoint& from) {
    for (std::size_t i = 0; i < to.weights.size(); ++i)
      to.weights[i] = 0.5 * (to.weights[i] + from.weights[i]);
  };
  Contact& c = now.contact;
  mix(c.a, old.contact.a);
  mix(c.b, old.contact.b);
  c.normal = (c.normal + old.contact.normal).normalized();
  c.point = 0.5 * (c.point + old.contact.point);
  c.offset_start = 0.5 * (c.offset_start + old.contact.offset_start);
  c.gap_start = c.normal.dot(c.offset_start);
  now.obstacle_a = 0.5 * (now.obstacle_a + old.obstacle_a);
  now.obstacle_b = 0.5 * (now.obstacle_b + old.obstacle_b);
  return now;
}

}  // namespace

KnownContacts::Finding KnownContacts::judge(const std::vector<ContactPair>& found,
                                            double least_gap) {
  Finding out;
  for (const ContactPair& pair : found) {
    out.broken = out.broken || pair.contact.gap_end < least_gap;
    out.deepest = std::max(out.deepest, -pair.contact.gap_end);
  }
  return out;
}

void KnownContacts::take(const std::vector<ContactPair>& found, const Manner& manner) {
  constexpr int kMostReplacements = 2;
  std::set<ContactKey> seen;
  for (const ContactPair& pair : found) seen.insert(pair.contact.key);
  std::map<ContactKey, std::vector<ContactKey>> left;  // by mover
  for (const auto& [key, pair] : known_)
    if (seen.count(key) == 0 && replaced_[key] < kMostReplacements) left[mover(key)].push_back(key);
  for (const ContactPair& pair : found) {
    const ContactKey& key = pair.contact.key;
    const auto it = known_.find(key);
    const auto old = left.find(mover(key));
    bool replaces = false;
    if (it == known_.end() && old != left.end())
      for (const ContactKey& gone : old->second) {
        const auto before = known_.find(gone);
        if (before == known_.end() || !leaves(before->second.contact, pair.contact)) continue;
        known_.erase(before);
        ++replaced_[gone];
        replaces = true;
      }
    if (it == known_.end() && !replaces && pair.contact.gap_end >= manner.least_gap) continue;
    if (it != known_.end() && manner.damped)
      it->second = halfway(it->second, pair);
    else
      known_[key] = pair;
  }
  pairs_.clear();
  for (const auto& [key, pair] : known_) {
    pairs_.push_back(pair);
    if (!manner.friction) pairs_.back().friction = 0;
  }
}

}  // namespace bem
