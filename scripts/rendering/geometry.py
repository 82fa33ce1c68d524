"""Surface geometry that the pictures need: areas, normals and best rigid motions."""
import numpy as np


def normalised(vectors):
    length = np.linalg.norm(vectors, axis=-1, keepdims=True)
    return vectors / np.maximum(length, 1e-300)


class Extent:
    """The box of some motions, each [frames, N, 3], and the sphere around it."""

    def __init__(self, motions):
        self.low = np.min([x.min(axis=(0, 1)) for x in motions], axis=0)
        self.high = np.max([x.max(axis=(0, 1)) for x in motions], axis=0)
        self.center = (self.low + self.high) / 2
        self.radius = max(float(np.linalg.norm(self.high - self.low)) / 2, 1e-12)

    def near(self, points):
        """Those of the points that lie within a radius of the box."""
        return points[((points > self.low - self.radius) & (points < self.high + self.radius)).all(axis=1)]


def plane_axes(normal):
    """Two unit vectors [2, 3] that span the plane with the unit normal: u, v, normal are right-handed."""
    helper = np.eye(3)[np.argmin(np.abs(normal))]
    u = normalised(np.cross(helper, normal))
    return np.stack([u, np.cross(normal, u)])


def split_long_edges(points, faces, longest, rounds):
    """Points and faces of the same surface in which each triangle with an edge above `longest` has become four, that
    many rounds at most. Neighbours of such a triangle may keep a long edge, on which its new point lies."""
    for _ in range(rounds):
        corners = points[faces]
        long = np.linalg.norm(corners - np.roll(corners, 1, axis=1), axis=2).max(axis=1) > longest
        if not long.any():
            break
        a, b, c = np.moveaxis(corners[long], 1, 0)
        start = len(points) + np.arange(long.sum())
        ab, bc, ca = start, start + len(start), start + 2 * len(start)
        points = np.concatenate([points, (a + b) / 2, (b + c) / 2, (c + a) / 2])
        old = faces[long].T
        four = [(old[0], ab, ca), (old[1], bc, ab), (old[2], ca, bc), (ab, bc, ca)]
        faces = np.concatenate([faces[~long], *(np.stack(t, axis=1) for t in four)])
    return points, faces


def is_closed(faces):
    """Whether every edge is passed as often in one direction as in the other."""
    ends = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    return np.array_equal(*(e[np.lexsort(e.T)] for e in (ends, ends[:, ::-1])))


def face_normals(points, faces):
    """Unnormalised normals [M, 3]; their length is twice the triangle's area."""
    a, b, c = (points[faces[:, k]] for k in range(3))
    return np.cross(b - a, c - a)


def vertex_areas(points, faces):
    """A third of the area of the triangles around each vertex [N]."""
    areas = np.linalg.norm(face_normals(points, faces), axis=1) / 6.0
    return np.bincount(faces.ravel(), np.repeat(areas, 3), minlength=len(points))


def area_changes(rest, positions, faces):
    """How much the area of each triangle has grown [%], per frame [frames, M]."""
    start = np.linalg.norm(face_normals(rest, faces), axis=1)
    return np.stack([100 * (np.linalg.norm(face_normals(x, faces), axis=1) / start - 1) for x in positions])


def smoothing_groups(points, faces, sharp_angle_deg):
    """For every triangle corner the index of the normal that it shares, and how many there are:
    corners at one vertex share a normal when edges less sharp than the angle join their triangles."""
    normals = normalised(face_normals(points, faces))
    corner = np.arange(3 * len(faces))  # corner 3t+k is also the half edge that starts there
    following = corner - corner % 3 + (corner + 1) % 3
    start = faces.ravel()
    end = start[following]
    low, high = np.minimum(start, end), np.maximum(start, end)
    order = np.lexsort((high, low))
    same = (low[order][1:] == low[order][:-1]) & (high[order][1:] == high[order][:-1])
    one, two = order[:-1][same], order[1:][same]
    cosine = np.einsum("ij,ij->i", normals[one // 3], normals[two // 3])
    smooth = (cosine >= np.cos(np.radians(sharp_angle_deg))) & (start[one] == end[two])
    one, two = one[smooth], two[smooth]
    left = np.concatenate([one, following[one]])
    right = np.concatenate([following[two], two])
    labels = corner
    while True:
        lower = np.minimum(labels[left], labels[right])
        updated = labels.copy()
        np.minimum.at(updated, left, lower)
        np.minimum.at(updated, right, lower)
        if np.array_equal(updated, labels):
            break
        labels = updated
    unique, groups = np.unique(labels, return_inverse=True)
    return groups.reshape(-1, 3), len(unique)


def corner_normals(points, faces, groups, group_count):
    """Unit normals [M, 3 corners, 3], averaged over each smoothing group, weighted by area."""
    flat = face_normals(points, faces)
    sums = np.stack([np.bincount(groups.ravel(), np.repeat(flat[:, axis], 3), minlength=group_count)
                     for axis in range(3)], axis=1)
    return normalised(sums)[groups]


def rigid_fit(rest, points, weights):
    """The rest shape moved by the rigid motion that brings it closest to points in the weighted
    least-squares sense (Kabsch)."""
    weights = weights / weights.sum()
    rest_center, center = weights @ rest, weights @ points
    covariance = (rest - rest_center).T @ (weights[:, None] * (points - center))
    u, _, vt = np.linalg.svd(covariance)
    flip = np.diag([1.0, 1.0, np.sign(np.linalg.det(u @ vt)) or 1.0])
    return (rest - rest_center) @ (u @ flip @ vt) + center
