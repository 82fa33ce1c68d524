"""Z-buffer rasteriser: which triangle is seen at each sample, by vectorised scan conversion."""
import numpy as np

PAIRS_PER_BATCH = 4_000_000  # bounds the memory of one batch of (triangle, sample) pairs


def visible_triangles(corners, nearness, width, height):
    """Index of the nearest triangle at every sample, -1 where there is none; [height * width].

    corners [T, 3, 2] are sample coordinates (centres at integer + 0.5), nearness [T, 3] a number
    linear over each triangle on the screen, larger when nearer (inverse depth of a perspective
    camera). A sample on an edge that two triangles share belongs to exactly one of them. Equal
    nearness goes to the later triangle. Cost: O(covered samples), a few passes where they overlap.
    """
    owner = np.full(width * height, -1, dtype=np.int32)
    depth = np.full(width * height, -np.inf)
    usable = np.isfinite(corners).all(axis=(1, 2)) & np.isfinite(nearness).all(axis=1)
    coefficients = barycentric_coefficients(corners)
    usable &= np.isfinite(coefficients).all(axis=(1, 2))
    plane = np.einsum("tij,ti->tj", coefficients, nearness)
    row_triangle, row = _rows(corners, np.flatnonzero(usable), height)
    first, count = _spans(corners, row_triangle, row, width)
    keep = count > 0
    row_triangle, row, first, count = row_triangle[keep], row[keep], first[keep], count[keep]
    total = np.cumsum(count)
    start = 0
    while start < len(count):
        done = total[start - 1] if start else 0
        stop = max(int(np.searchsorted(total, done + PAIRS_PER_BATCH, side="right")), start + 1)
        part = slice(start, stop)
        column = _counted_up(first[part], count[part])
        triangle = np.repeat(row_triangle[part], count[part])
        y = row[part] + 0.5
        along, across = plane[row_triangle[part], 0], plane[row_triangle[part]]
        base = across[:, 1] * y + across[:, 2]
        value = np.repeat(along, count[part]) * (column + 0.5) + np.repeat(base, count[part])
        sample = np.repeat(row[part] * width, count[part]) + column
        _keep_nearest(owner, depth, sample, value, triangle)
        start = stop
    return owner


def barycentric_coefficients(corners):
    """[T, 3, 3]: barycentric coordinate i at (x, y) is coefficients[t, i] . (x, y, 1)."""
    x, y = corners[..., 0], corners[..., 1]
    following, last = [1, 2, 0], [2, 0, 1]
    a = y[:, following] - y[:, last]
    b = x[:, last] - x[:, following]
    c = x[:, following] * y[:, last] - x[:, last] * y[:, following]
    with np.errstate(all="ignore"):
        return np.stack([a, b, c], axis=-1) / c.sum(axis=1)[:, None, None]


def _counted_up(first, count):
    """first[0], first[0]+1, ... (count[0] of them), first[1], ..."""
    ends = np.cumsum(count)
    return np.arange(ends[-1] if len(ends) else 0) + np.repeat(first - (ends - count), count)


def _rows(corners, triangles, height):
    """Every (triangle, row of samples) pair that overlaps."""
    y = corners[triangles, :, 1]
    low = np.clip(np.ceil(y.min(axis=1) - 0.5), 0, height).astype(np.int64)
    high = np.clip(np.ceil(y.max(axis=1) - 0.5), 0, height).astype(np.int64)
    count = np.maximum(high - low, 0)
    return np.repeat(triangles, count), _counted_up(low, count)


def _spans(corners, triangle, row, width):
    """First column and number of columns of each (triangle, row) pair."""
    center = row + 0.5
    left, right = np.full(len(row), np.inf), np.full(len(row), -np.inf)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        # From the lower end to the upper one, so that both triangles of an edge get the same x.
        p, q = corners[:, i], corners[:, j]
        swap = (p[:, 1] > q[:, 1])[:, None]
        p, q = np.where(swap, q, p)[triangle], np.where(swap, p, q)[triangle]
        crossed = (p[:, 1] <= center) & (center < q[:, 1])
        with np.errstate(all="ignore"):
            x = p[:, 0] + (center - p[:, 1]) / (q[:, 1] - p[:, 1]) * (q[:, 0] - p[:, 0])
        left = np.where(crossed, np.minimum(left, x), left)
        right = np.where(crossed, np.maximum(right, x), right)
    empty = left > right
    low = np.clip(np.ceil(np.where(empty, 0, left) - 0.5), 0, width).astype(np.int64)
    high = np.clip(np.ceil(np.where(empty, 0, right) - 0.5), 0, width).astype(np.int64)
    return low, np.where(empty, 0, np.maximum(high - low, 0))


def _keep_nearest(owner, depth, sample, value, triangle):
    # Assignment to a repeated index keeps the last value; who was nearer than that tries again.
    pending = np.flatnonzero(value >= depth[sample])
    while pending.size:
        at = sample[pending]
        depth[at] = value[pending]
        owner[at] = triangle[pending]
        pending = pending[value[pending] > depth[at]]
