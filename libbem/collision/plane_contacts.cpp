#include "collision/plane_contacts.hpp"

namespace bem {

void add_plane_contacts(const MovingSurface& a, int plane_index, const Vec3& point,
                        const Vec3& normal, const ContactLimits& limits,
                        std::vector<Contact>& contacts) {
  for (int v = 0; v < a.topology->vertex_count(); ++v) {
    const Vec3 end = a.vertex(v, 1);
    const double gap = normal.dot(end - point);
    if (gap >= limits.margin) continue;
    Contact c;
    c.a = {a.index, 1, {v, -1, -1}, {1, 0, 0}};
    c.b.surface = plane_index;
    c.normal = normal;
    c.point = end - gap * normal;
    c.offset_start = a.vertex(v, 0) - c.point;
    c.gap_start = normal.dot(c.offset_start);
    c.gap_end = gap;
    c.key = {a.index, plane_index, ContactKind::vertex_plane, v, 0};
    contacts.push_back(c);
  }
}

}  // namespace bem
