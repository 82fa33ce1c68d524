"""Numbers from trajectories: errors, frequencies and decays, orders of convergence, Pareto fronts."""
import math

import numpy as np


def rms(values):
    return float(np.sqrt(np.mean(np.square(values))))


def factor_of_ringing(values):
    """The complex z of values[n] = Re(C z^n) + d, a decaying oscillation about d: linear prediction, then
    Gauss-Newton for z with C and d eliminated."""
    centred = values - np.mean(values)
    a = np.stack([centred[1:-1], centred[:-2], np.ones(len(values) - 2)], axis=1)
    p, q, _ = np.linalg.lstsq(a, centred[2:], rcond=None)[0]
    z = complex(np.roots([1, -p, -q])[0])
    log = np.array([math.log(max(abs(z), 1e-3)), abs(np.angle(z)) or 0.1])
    n = np.arange(len(values))

    def residual(x):
        power = np.exp((x[0] + 1j * x[1]) * n)
        base = np.stack([power.real, power.imag, np.ones(len(n))], axis=1)
        return values - base @ np.linalg.lstsq(base, values, rcond=None)[0]

    for _ in range(30):
        r = residual(log)
        slopes = np.stack([(residual(log + h) - r) / 1e-6 for h in 1e-6 * np.eye(2)], axis=1)
        change = np.linalg.lstsq(slopes, -r, rcond=None)[0]
        while np.linalg.norm(residual(log + change)) > np.linalg.norm(r) and np.linalg.norm(change) > 1e-12:
            change = change / 2
        log = log + change
        if np.linalg.norm(change) < 1e-11:
            break
    return complex(np.exp(log[0] + 1j * log[1]))


def angle_between(a, b):
    """Angles [rad] of the rotations from a to b (n, 3, 3); exact for small ones, too."""
    relative = np.einsum("nji,njk->nik", a, b)
    skew = 0.5 * (relative - relative.transpose(0, 2, 1))
    sine = np.sqrt(skew[:, 2, 1]**2 + skew[:, 0, 2]**2 + skew[:, 1, 0]**2)
    return np.arctan2(sine, 0.5 * (np.trace(relative, axis1=1, axis2=2) - 1))


def growth_per_period(values, rest, steps):
    """Factor of the amplitude about `rest` per period of `steps` steps, from extremes half a period apart,
    the first and the last."""
    half = steps / 2
    count = int(len(values) / half)
    peaks = [np.max(np.abs(values[int(k * half):int((k + 1) * half)] - rest)) for k in range(count)]
    return float((peaks[-1] / peaks[0])**(2 / (count - 1)))


def order(sizes, errors):
    """Slope of log error over log size, of the best line."""
    return float(np.polyfit(np.log(sizes), np.log(errors), 1)[0])


def pareto(points):
    """Those of (cost, error, ...) that no other one beats in both, by increasing cost."""
    front, best = [], math.inf
    for point in sorted(points, key=lambda p: (p[0], p[1])):
        if point[1] < best:
            best = point[1]
            front.append(point)
    return front
