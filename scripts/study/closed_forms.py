"""The exact solutions that runs are compared with: functions of numpy arrays of times [s]."""
import math

import numpy as np


class Rod:
    """1 x 0.2 x 0.2 m, nu = 0, a traction p0 along x on the end x = L from t = 0 on: d'Alembert's waves.
    fixed-free: u(L,t) = (p0 c/E) sum (-1)^k [s(t - 2kL/c) - s(t - 2(k+1)L/c)], a triangle wave of period 4L/c;
    free-free: the same with plus signs throughout. s(t) = max(t, 0)."""
    LENGTH, WIDTH, DENSITY, YOUNG, LOAD = 1.0, 0.2, 1000.0, 9e5, 900.0
    SPEED = math.sqrt(YOUNG / DENSITY)
    PERIOD = 4 * LENGTH / SPEED
    STATIC = LOAD * LENGTH / YOUNG  # p0 L/E [m]

    def end(self, times, fixed):
        """Displacement [m] of the loaded end."""
        total = np.zeros_like(times)
        for k in range(int(np.max(times) / (2 * self.LENGTH / self.SPEED)) + 2):
            sign = (-1)**k if fixed else 1
            late = [np.maximum(times - 2 * (k + j) * self.LENGTH / self.SPEED, 0) for j in (0, 1)]
            total += sign * (late[0] - late[1] if fixed else late[0] + late[1])
        return self.LOAD * self.SPEED / self.YOUNG * total


def bessel(n, x):
    """Spherical Bessel function j_n by recursion upwards (x not much smaller than n)."""
    below, here = np.cos(x) / x, np.sin(x) / x
    for k in range(n):
        below, here = here, (2 * k + 1) / x * here - below
    return here


def bisect(function, low, high):
    negative = function(low) < 0
    for _ in range(80):
        middle = 0.5 * (low + high)
        if (function(middle) < 0) == negative:
            low = middle
        else:
            high = middle
    return 0.5 * (low + high)


class Sphere:
    """Solid sphere of radius 0.5 m, 1000 kg/m^3."""
    RADIUS, DENSITY, LOAD = 0.5, 1000.0, 1000.0

    def __init__(self, shear=1e6, poisson=0.3):
        self.shear, self.poisson = shear, poisson
        self.lame = 2 * shear * poisson / (1 - 2 * poisson)
        self.c1 = math.sqrt((self.lame + 2 * shear) / self.DENSITY)
        self.c2 = math.sqrt(shear / self.DENSITY)
        self.static = -self.LOAD * self.RADIUS / (3 * self.lame + 2 * shear)  # -p0 a/(3K) [m]

    def breathing_roots(self, count):
        """Roots x of (lame + 2 shear) x j0(x) = 4 shear j1(x); frequencies are c1 x/a."""
        def f(x):
            return (self.lame + 2 * self.shear) * x * bessel(0, x) - 4 * self.shear * bessel(1, x)
        grid = 0.5 + 0.05 * np.arange(int(20 * math.pi * (count + 2)))
        values = f(grid)
        starts = grid[:-1][values[:-1] * values[1:] < 0][:count]
        return np.array([bisect(f, x, x + 0.05) for x in starts])

    def pressed(self, times, modes=300):
        """Radial displacement [m] of the surface under a pressure p0 from t = 0 on:
        -p0 a/(3K) + sum 2 p0/(rho a w^2) j1^2/(j1^2 - j0 j2) cos(w t)."""
        x = self.breathing_roots(modes)
        w = self.c1 * x / self.RADIUS
        j0, j1, j2 = (bessel(n, x) for n in (0, 1, 2))
        shape = 2 * self.LOAD / (self.DENSITY * self.RADIUS * w**2) * j1**2 / (j1**2 - j0 * j2)
        return self.static + np.cos(np.outer(times, w)) @ shape

    def breathing_period(self):
        return 2 * math.pi * self.RADIUS / (self.c1 * self.breathing_roots(1)[0])

    def torsion(self, overtone=0):
        """Frequency [1/s] of the free mode T2 and its overtones: (n - 1) j_n(x) = x j_(n+1)(x), x = w a/c2."""
        root = (2.5011, 7.1360)[overtone]
        return bisect(lambda x: bessel(2, x) - x * bessel(3, x), root - 0.1, root + 0.1) * self.c2 / self.RADIUS

    def quadrupole(self, overtone=0):
        """Frequency [1/s] of the free mode S2 and its overtones (Lamb): T11 T43 = T41 T13 with n = 2,
        x = w a/c2, xi = w a/c1."""
        def f(x, n=2):
            xi = x * self.c2 / self.c1
            t11 = (n * n - n - x * x / 2) * bessel(n, xi) + 2 * xi * bessel(n + 1, xi)
            t13 = n * (n + 1) * ((n - 1) * bessel(n, x) - x * bessel(n + 1, x))
            t41 = (n - 1) * bessel(n, xi) - xi * bessel(n + 1, xi)
            t43 = (n * n - 1 - x * x / 2) * bessel(n, x) + x * bessel(n + 1, x)
            return t11 * t43 - t41 * t13
        grid = np.arange(1.5, 12, 0.05)
        values = np.array([f(x) for x in grid])
        start = grid[:-1][values[:-1] * values[1:] < 0][overtone]
        return bisect(f, start, start + 0.05) * self.c2 / self.RADIUS


class Plate:
    """1 x 1 x 0.05 m, 1000 kg/m^3, shear modulus 1e7 Pa, nu 0.3, free. `TWIST` and `SADDLE` are the angular frequencies
    [1/s] of its first two modes, like x y and x^2 - y^2, of fine volume finite element meshes (thin plates: 0.3291 and
    0.478 c2/L)."""
    SIDE, THICKNESS, DENSITY, SHEAR, POISSON = 1.0, 0.05, 1000.0, 1e7, 0.3
    SPEED = math.sqrt(SHEAR / DENSITY)
    TWIST, SADDLE = 0.32202 * SPEED / SIDE, 0.47428 * SPEED / SIDE


class Beam:
    """1 x 0.2 x 0.2 m, 1000 kg/m^3, shear modulus 1e7 Pa, nu 0.3, held at x = 0, gravity of 1 m/s^2 sideways
    from t = 0 on. There is no closed form in three dimensions. `MODES` are the frequencies [Hz] and the
    deflections at rest [m] of the free end in the modes of a volume finite element model, extrapolated to fine
    meshes (scripts/study.py calculix --reference), so that w(t) = sum a (1 - cos(2 pi f t)); `FREE` are the
    frequencies [Hz] of the first and third bending mode of the beam that nothing holds, found in the same way."""
    LENGTH, WIDTH, DENSITY, SHEAR, POISSON, GRAVITY = 1.0, 0.2, 1000.0, 1e7, 0.3, 1.0
    YOUNG = 2 * SHEAR * (1 + POISSON)
    MODES = ((5.0969, 1.50141e-3), (27.4826, -2.7078e-5), (65.527, 2.566e-6), (108.98, -5.98e-7))
    FREE = (29.3933, 114.93)  # Timoshenko's theory: 29.36

    def tip(self, times):
        """Deflection [m] of the free end."""
        return sum(a * (1 - np.cos(2 * math.pi * f * times)) for f, a in self.MODES)

    def static(self):
        return sum(a for _, a in self.MODES)

    def period(self):
        return 1 / self.MODES[0][0]

    def timoshenko(self):
        """Static deflection of the tip in beam theory: rho A g L^4/(8EI) + rho g L^2/(2 kappa mu)."""
        weight = self.DENSITY * self.GRAVITY
        kappa = 10 * (1 + self.POISSON) / (12 + 11 * self.POISSON)
        return (12 * weight * self.LENGTH**4 / (8 * self.YOUNG * self.WIDTH**2)
                + weight * self.LENGTH**2 / (2 * kappa * self.SHEAR))


class Tumbling:
    """A box of 0.3 x 0.2 x 0.1 m that turns freely, at first with (0.05, 5, 0.05) rad/s: it flips."""
    SIZE, SPIN, DURATION = (0.3, 0.2, 0.1), (0.05, 5.0, 0.05), 4.0

    def attitudes(self, times):
        """Rotations (n, 3, 3) at increasing times, by Runge-Kutta: I w' = -w x I w in the body, R' = R [w]."""
        x, y, z = self.SIZE
        inertia = np.array([y * y + z * z, x * x + z * z, x * x + y * y])

        def rate(state):
            w, rotation = state[:3], state[3:].reshape(3, 3)
            cross = np.array([[0, -w[2], w[1]], [w[2], 0, -w[0]], [-w[1], w[0], 0]])
            return np.concatenate([-np.cross(w, inertia * w) / inertia, (rotation @ cross).ravel()])

        state, now, found = np.concatenate([self.SPIN, np.eye(3).ravel()]), 0.0, []
        for time in times:
            steps = max(1, math.ceil((time - now) / 2e-3))
            h = (time - now) / steps
            for _ in range(steps if h > 0 else 0):
                k1 = rate(state)
                k2 = rate(state + h / 2 * k1)
                k3 = rate(state + h / 2 * k2)
                state = state + h / 6 * (k1 + 2 * k2 + 2 * k3 + rate(state + h * k3))
            now = time
            found.append(state[3:].reshape(3, 3))
        return np.array(found)


class Slide:
    """A block of 0.4 x 0.4 x 0.1 m with 1 m/s on a floor with friction 0.4: t = v/(mu g), d = v^2/(2 mu g)."""
    SIZE, DENSITY, SHEAR, POISSON = (0.4, 0.4, 0.1), 1000.0, 1e7, 0.3
    SPEED, FRICTION, GRAVITY = 1.0, 0.4, 9.81
    TIME = SPEED / (FRICTION * GRAVITY)
    WAY = 0.5 * SPEED * TIME


class Drop:
    """A cube of 0.2 m with nu = 0 falls flat on a floor with 1 m/s, without gravity: a wave runs up and back
    while the centre turns round with a constant force, then the cube leaves with the same speed."""
    SIDE, DENSITY, SHEAR, SPEED = 0.2, 1000.0, 1e6, 1.0
    TIME = 2 * SIDE / math.sqrt(2 * SHEAR / DENSITY)  # of the contact

    def centre(self, times):
        """Way of the centre from the moment of contact on, upwards."""
        t = np.minimum(times, self.TIME)
        return self.SPEED * (t * t / self.TIME - t + np.maximum(times - self.TIME, 0))


class Hertz:
    """A ball of 0.05 m falls on a floor with 2 m/s, without gravity: m x'' = -(4/3) E* sqrt(R) x^1.5."""
    RADIUS, DENSITY, SHEAR, POISSON, SPEED = 0.05, 1000.0, 1e6, 0.3, 2.0
    MASS = DENSITY * 4 / 3 * math.pi * RADIUS**3
    MODULUS = 2 * SHEAR / (1 - POISSON)  # E / (1 - nu^2)
    DEPTH = (15 * MASS * SPEED**2 / (16 * math.sqrt(RADIUS) * MODULUS))**0.4  # largest approach
    TIME = 2.9432 * DEPTH / SPEED  # of the contact

    def centre(self, times):
        """Way of the centre from the moment of contact on, upwards; times in equal steps."""
        substeps = 200
        h = (times[1] - times[0]) / substeps
        x, v, found = 0.0, self.SPEED, []
        k = 4 / 3 * self.MODULUS * math.sqrt(self.RADIUS) / self.MASS
        for _ in times:
            found.append(-x)
            for _ in range(substeps):  # leapfrog
                v -= h / 2 * k * max(x, 0)**1.5
                x += h * v
                v -= h / 2 * k * max(x, 0)**1.5
        return np.array(found)
