#include "collision/mirrored_contacts.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace bem {
namespace {

constexpr double kOpposite = -0.9998;  ///< cosine below which two normals are opposite

/// The vertex that side b of the contact is at, -1 if it is not at any.
int vertex_of_b(const Contact& c, const MovingSurface& b, double tolerance) {
  if (c.key.kind != ContactKind::vertex_triangle) return -1;
  for (int v : c.b.vertices)
    if ((b.vertex(v, 1) - c.point).norm() <= tolerance) return v;
  return -1;
}

}  // namespace

void remove_mirrored(const ContactLimits& limits, const MovingSurface& a, const MovingSurface& b,
                     std::vector<Contact>& contacts) {
  // (vertex of the first surface, vertex of the second, which of them is side a, contact)
  std::vector<std::tuple<int, int, bool, std::size_t>> meetings;
  for (std::size_t i = 0; i < contacts.size(); ++i) {
    const Contact& c = contacts[i];
    const bool swapped = c.key.surface_a != a.index;
    const int v = c.key.feature_a;
    const int w = vertex_of_b(c, swapped ? a : b, 3 * limits.tolerance);
    if (w >= 0) meetings.emplace_back(swapped ? w : v, swapped ? v : w, swapped, i);
  }
  std::sort(meetings.begin(), meetings.end());
  std::vector<char> removed(contacts.size(), 0);
  const auto same_meeting = [](const auto& x, const auto& y) {
    return std::get<0>(x) == std::get<0>(y) && std::get<1>(x) == std::get<1>(y);
  };
  for (std::size_t i = 0; i < meetings.size(); ++i) {
    for (std::size_t j = i + 1; j < meetings.size() && same_meeting(meetings[i], meetings[j]);
         ++j) {
      const std::size_t first = std::get<3>(meetings[i]), second = std::get<3>(meetings[j]);
      if (std::get<2>(meetings[i]) != std::get<2>(meetings[j]) &&
          contacts[first].normal.dot(contacts[second].normal) < kOpposite)
        removed[contacts[first].key < contacts[second].key ? second : first] = 1;
    }
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < contacts.size(); ++i)
    if (!removed[i]) contacts[kept++] = contacts[i];
  contacts.resize(kept);
}

}  // namespace bem
