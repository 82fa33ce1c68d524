#include "constraints/known_forces.hpp"

#include <set>

namespace bem {

std::vector<Vec3> KnownForces::start_for(const std::vector<ContactPair>& pairs) const {
  const auto mover = [](ContactKey key) {
    key.feature_b = -1;
    return key;
  };
  std::set<ContactKey> present;
  std::map<ContactKey, int> arrivals;
  for (const ContactPair& pair : pairs) {
    present.insert(pair.contact.key);
    arrivals[mover(pair.contact.key)] += forces_.count(pair.contact.key) == 0;
  }
  std::map<ContactKey, Vec3> left;
  for (const auto& [key, force] : forces_)
    if (present.count(key) == 0) left.try_emplace(mover(key), Vec3::Zero()).first->second += force;
  std::vector<Vec3> out;
  for (const ContactPair& pair : pairs) {
    const ContactKey& key = pair.contact.key;
    const auto known = forces_.find(key);
    const auto moved = left.find(mover(key));
    if (known != forces_.end())
      out.push_back(known->second);
    else if (moved != left.end())
      out.emplace_back(moved->second / arrivals[mover(key)]);
    else
      out.emplace_back(Vec3::Zero());
  }
  return out;
}

void KnownForces::set(const std::vector<ContactPair>& pairs, const std::vector<Vec3>& forces) {
  forces_.clear();
  for (std::size_t c = 0; c < forces.size(); ++c) forces_[pairs[c].contact.key] = forces[c];
}

}  // namespace bem
