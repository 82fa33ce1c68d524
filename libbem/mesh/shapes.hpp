#pragma once

#include "mesh/triangle_mesh.hpp"

#include <array>
#include <cstdint>

namespace bem {

/// Closed test bodies: vertices shared, triangles outward, lengths in metres. The same arguments
/// give the same mesh every time. A value out of range throws ErrorCode::usage.

/// Icosahedron refined `subdivisions` >= 0 times (at most 9), vertices on the sphere of `radius`
/// > 0 around the origin: 10 * 4^subdivisions + 2 vertices.
TriangleMesh icosphere(int subdivisions, double radius);

/// Box centred at the origin with `divisions` >= 1 cells along each axis; a beam is a long box. The
/// diagonals of a face point to its centre, so that the pattern is mirror symmetric for even
/// divisions. `grading` in [0, 1] makes the cells smaller towards both ends of every axis: 0 is
/// uniform, 1 spaces the planes like the cosine of equal angles.
TriangleMesh box(const Vec3& size, const std::array<int, 3>& divisions, double grading = 0);

/// Torus around the z axis: circle of radius `minor` > 0 at distance `major` > minor from the axis,
/// `around` cells the long way, `across` the short way (each >= 3).
TriangleMesh torus(double major, double minor, int around, int across);

/// Cylinder along z centred at the origin; `segments` >= 3 around the rim, `rings` >= 1 layers
/// along its height; the caps are discs of about equally large triangles.
TriangleMesh cylinder(double radius, double height, int segments, int rings);

/// Smooth rounded cube (|x|^4 + |y|^4 + |z|^4 = const) of width `size` with sinusoidal bumps:
/// radii times 1 + amplitude * b, |b| <= 1, 0 <= amplitude < 1; `divisions` cells per edge.
TriangleMesh bumpy_cube(double size, int divisions, double amplitude);

/// Thick bowl, the lower half of a spherical shell of outer `radius` around the origin, opening
/// towards +z; 0 < thickness < radius; `segments` >= 6 around the rim.
TriangleMesh bowl(double radius, double thickness, int segments);

/// Sphere-like body with smooth hills and dales: radii from 0.65 to 1.35 times `radius`, both
/// reached. Vertices as icosphere.
TriangleMesh star(int subdivisions, double radius);

/// Cube of width `size` around the origin without its octant x, y, z > 0; `divisions` per edge is
/// even and >= 2.
TriangleMesh notched_cube(double size, int divisions);

/// Fish along x, its nose at +x, flattened along y, with a forked tail; about 0.85 * segments^2
/// vertices, `segments` >= 8 around its girth.
TriangleMesh fish(double length, int segments);

/// Clip: a bar bent to a U, around the origin: two arms along x, one above the other in y, that
/// join at -x. Its box has `cells` cells of width `cell` [m], the bar is `wall` of them thick;
/// 1 <= wall < cells[0] and 2 wall < cells[1].
TriangleMesh clip(const std::array<int, 3>& cells, int wall, double cell);

/// Tetrahedron with corners in the unit cube and a volume of at least 0.05.
TriangleMesh random_tetrahedron(std::uint64_t seed);

}  // namespace bem
