"""What pruning keeps of a matrix: its own largest entries, or those of its Haar transform, with its
rows and columns in different orders (Fig. 7 of the paper)."""
import h5py
import numpy as np

RATIOS = [2, 4, 8, 16, 32, 64, 128, 256]


def ranges(begin, end):
    """The ranges that recursive bisection halves, parts before the whole: begin, middle, end."""
    if end - begin > 1:
        middle = begin + (end - begin) // 2
        yield from ranges(begin, middle)
        yield from ranges(middle, end)
        yield begin, middle, end


def haar(rows, parts):
    """Transforms the rows of a matrix in place, each of `parts` equal ranges of them by itself."""
    size = len(rows) // parts
    for begin, middle, end in ranges(0, size):
        a, b = (np.float32(np.sqrt(n / (end - begin))) for n in (middle - begin, end - middle))
        for first in range(0, len(rows), size):
            left, right = rows[first + begin], rows[first + middle]
            mean = a * left + b * right
            right *= -a
            right += b * left
            left[:] = mean


def hilbert_order(points, bits=16):
    """Order along a Hilbert curve (J. Skilling, AIP Conf. Proc. 707, 2004)."""
    low, side = points.min(axis=0), np.ptp(points, axis=0).max()
    x = np.clip((points - low) / side * 2**bits, 0, 2**bits - 1).astype(np.int64).T.copy()
    for bit in range(bits - 1, 0, -1):
        q = 1 << bit
        for axis in range(3):
            inside = (x[axis] & q) != 0
            swap = np.where(inside, 0, (x[0] ^ x[axis]) & (q - 1))
            x[0] ^= np.where(inside, q - 1, swap)
            x[axis] ^= swap
    x[1] ^= x[0]
    x[2] ^= x[1]
    flip = np.zeros(len(points), dtype=np.int64)
    for bit in range(bits - 1, 0, -1):
        flip ^= np.where(x[2] & (1 << bit), (1 << bit) - 1, 0)
    x ^= flip
    key = np.zeros(len(points), dtype=np.int64)
    for bit in range(bits - 1, -1, -1):
        for axis in x:
            key = key << 1 | axis >> bit & 1
    return np.argsort(key, kind="stable")


def padded(matrix, parts):
    """With zeros behind each of `parts` equal ranges of rows and of columns, up to a power of two."""
    size = len(matrix) // parts
    full = 1 << (size - 1).bit_length()
    out = np.zeros((parts, full, parts, full), dtype=matrix.dtype)
    out[:, :size, :, :size] = matrix.reshape(parts, size, parts, size)
    return out.reshape(parts * full, parts * full)


def haar_nonstandard(matrix, parts):
    """Two-dimensional wavelets of one level for both directions, in place of haar() for rows and for
    columns; the parts have a power of two of rows."""
    size = len(matrix) // parts
    means = matrix.reshape(parts, size, parts, size)
    while size > 1:
        for axis in (1, 3):
            even, odd = (np.take(means, range(k, size, 2), axis=axis) for k in (0, 1))
            half = [slice(None)] * 4
            for where, value in ((slice(0, size // 2), even + odd), (slice(size // 2, size), even - odd)):
                half[axis] = where
                means[tuple(half)] = value * np.float32(np.sqrt(0.5))
        size //= 2
        means = means[:, :size, :, :size]


def pruning_errors(entries, ratios=RATIOS, count=None):
    """Relative Frobenius norm of what is lost if one entry in `ratio` is kept, of `count` entries or
    as many as there are."""
    squares = np.sort(np.square(entries, dtype=np.float32).ravel())
    total = squares.sum(dtype=np.float64)
    count = count or len(squares)
    return [float(np.sqrt(squares[:len(squares) - count // r].sum(dtype=np.float64) / total))
            for r in ratios]


def study(path, dataset="matrices/h/lag_001/component_0"):
    """Errors by ratio of an uncompressed archive's matrix, by name of the method."""
    with h5py.File(path) as archive:
        matrix = archive[dataset][:].astype(np.float32)
        nodes = archive["body/nodes"][:]
        node_of_vertex = archive["body/node_of_vertex"][:]
    count = len(nodes)
    used = node_of_vertex[node_of_vertex >= 0]
    orders = {"file order": used[np.sort(np.unique(used, return_index=True)[1])],
              "bisection": np.arange(count), "Hilbert": hilbert_order(nodes)}
    axes = np.arange(3)

    def ordered(name, separate):
        order = orders[name]
        index = (3 * order[None, :] + axes[:, None] if separate else
                 3 * order[:, None] + axes[None, :]).ravel()
        return matrix[np.ix_(index, index)]

    def standard(rows, parts):
        for _ in range(2):
            haar(rows, parts)
            rows = rows.T.copy()
        return rows

    result = {"naive": pruning_errors(matrix)}
    for name, separate in [("file order", False), ("bisection", False), ("file order", True),
                           ("Hilbert", True), ("bisection", True)]:
        coefficients = standard(ordered(name, separate), 3 if separate else 1)
        result[f"Haar, {name}{', axes apart' if separate else ''}"] = pruning_errors(coefficients)
    rows = padded(ordered("Hilbert", True), 3)
    result["Haar, Hilbert, axes apart, padded"] = pruning_errors(standard(rows.copy(), 3), count=matrix.size)
    haar_nonstandard(rows, 3)
    result["the same, nonstandard form"] = pruning_errors(rows, count=matrix.size)
    return {"ratios": RATIOS, "nodes": count, "errors": result}
