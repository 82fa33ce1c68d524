"""What the time discretisation alone makes of the problems of the study: convolution quadrature of their transfer
functions, exact in space. No mesh can do better than this (but by chance)."""
import math

import numpy as np

from . import measures
from .closed_forms import Beam, Rod

ROOT6 = math.sqrt(6)
BUTCHER = {"radau2": np.array([[5 / 12, -1 / 12], [3 / 4, 1 / 4]]),
           "radau3": np.array([[(88 - 7 * ROOT6) / 360, (296 - 169 * ROOT6) / 1800, (-2 + 3 * ROOT6) / 225],
                               [(296 + 169 * ROOT6) / 1800, (88 + 7 * ROOT6) / 360, (-2 - 3 * ROOT6) / 225],
                               [(16 - ROOT6) / 36, (16 + ROOT6) / 36, 1 / 9]])}


def theta(scheme):
    return {"bdf1": 0.0, "bdf2": 1.0}.get(scheme) if ":" not in scheme else float(scheme.split(":")[1])


def symbol(scheme, zeta):
    """Delta(zeta), s x s."""
    if scheme in BUTCHER:
        inverse = np.linalg.inv(BUTCHER[scheme])
        last = np.zeros_like(inverse)
        last[:, -1] = 1
        return inverse - zeta * inverse @ last
    return np.array([[(1 - zeta) + theta(scheme) / 2 * (1 - zeta)**2]])


def weights(transfer, scheme, dt, count):
    """The first weights of X(s): (count, s, s), with X(Delta(zeta)/dt) = sum_k X_k zeta^k."""
    points = 4 * count
    radius = 1e-15**(1 / (2 * points))
    values = []
    for k in range(points):
        eigenvalues, vectors = np.linalg.eig(symbol(scheme, radius * np.exp(2j * np.pi * k / points)) / dt)
        values.append(vectors @ np.diag([transfer(s) for s in eigenvalues]) @ np.linalg.inv(vectors))
    found = np.fft.fft(np.array(values), axis=0)[:count] / points
    return (found * radius**-np.arange(count)[:, None, None]).real


def response(transfer, scheme, dt, steps):
    """What a unit load from t = 0 on does: at the end of every step, from 0 at the start on."""
    return np.concatenate([[0.0], np.cumsum(weights(transfer, scheme, dt, steps)[:, -1, :].sum(axis=1))])


def rod_end(fixed):
    """Displacement of the loaded end per traction, in units of the deflection at rest per traction."""
    def transfer(s):
        x = s * Rod.LENGTH / Rod.SPEED
        return np.tanh(x) / x if fixed else 1 / (np.tanh(x) * x)
    return transfer


def sphere_surface(sphere):
    """Radial displacement of the surface per pressure, in units of that at rest."""
    longitudinal = sphere.lame + 2 * sphere.shear

    def transfer(s):
        x = s * sphere.RADIUS / sphere.c1
        bessel = 1 / x - np.tanh(x) / x**2  # i1(x)/cosh(x), and its derivative
        slope = np.tanh(x) / x - 2 / x**2 + 2 * np.tanh(x) / x**3
        rigidity = (longitudinal * x * slope + 2 * sphere.lame * bessel) / sphere.RADIUS
        return -sphere.LOAD * bessel / rigidity / sphere.static
    return transfer


def beam_tip(s):
    return sum(a * (2 * math.pi * f)**2 / (s * s + (2 * math.pi * f)**2) for f, a in Beam.MODES) / Beam().static()


def error(transfer, exact, scheme, period, steps):
    """As the study measures it: over two periods of so many steps."""
    times = np.arange(2 * steps + 1) * period / steps
    return measures.rms((response(transfer, scheme, period / steps, 2 * steps) - exact(times))[1:])


def ringing(frequency, scheme, dt):
    """The factor of a free vibration per step."""
    s = 1j * frequency * dt
    if scheme in BUTCHER:
        a = BUTCHER[scheme]
        return np.linalg.solve(np.eye(len(a)) - s * a, np.ones(len(a)))[-1]
    t = theta(scheme)  # (1 - z) + t/2 (1 - z)^2 = s for z = 1/factor
    roots = np.roots([t / 2, -1 - t, 1 + t / 2 - s]) if t > 0 else np.array([1 - s])
    return 1 / roots[np.argmin(abs(roots))]


def ringing_measures(frequency, scheme, period, steps):
    """Error over two periods, relative frequency and energy left per period, as FreeMode measures them."""
    dt = period / steps
    z = ringing(frequency, scheme, dt)
    off = np.abs(np.exp((np.log(z) - 1j * frequency * dt) * np.arange(2 * steps + 1)) - 1)
    return {"error": measures.rms(off), "frequency": float(np.angle(z) / dt / frequency - 1),
            "energy": float(abs(z)**(2 * steps))}


def rebound(scheme, steps):
    """Speed with which a rod leaves a wall that it met head-on with speed 1, with so many steps per contact and
    constant forces in every step; exact is 1."""
    dt = 2 / steps  # in units of length over wave speed
    gain = weights(lambda s: 1 / (s * np.tanh(s)), scheme, dt, 2 * steps)[:, -1, :].sum(axis=1)
    force = np.zeros(2 * steps)
    for n in range(2 * steps):
        free = -(n + 1) * dt + gain[n:0:-1] @ force[:n]
        force[n] = max(0.0, -free / gain[0])
    return float(force.sum() * dt - 1)

