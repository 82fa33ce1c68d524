#pragma once

#include "mesh/triangle_mesh.hpp"

namespace bem {

/// How coarse a closed, outward mesh is whatever deforms the body: the norm of what linear
/// triangles leave out of bending and twisting, over the norm of bending and twisting.
///
/// All displacements u = sum of x_j x_k a_jk (18 coefficients, x from the centre of mass) are
/// considered; their strain is linear in space and vanishes on average: bending and twisting, and
/// others that are stiffer. Of those with unit strain energy, int tr(eps^2) dV = 1 (a material with
/// nu = 0),
///
///     eta = max_u (int |b|^2 dA)^(1/2) / max_u (int |u - affine|^2 dA)^(1/2),
///
/// b the exact bubble part of u, -h^2/8 times its second derivative along each edge at midpoints,
/// and u - affine what remains of u without its nearest affine field in this norm. The
/// denominator belongs to the softest of these shapes: bending of a beam or a plate. The ratio is
/// of order h^2, and depends on neither the position, orientation nor size of the mesh.
/// O(n).
double mesh_coarseness(const TriangleMesh& mesh);

/// How far the softest of the same displacements moves the surface: the largest mean of
/// |u - affine|^2 over the surface for int tr(eps^2) dV = 1 m^3 [1/m]. O(n).
double softness(const TriangleMesh& mesh);

}  // namespace bem
