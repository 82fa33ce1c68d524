"""The problems of the study: body, scene and error of each. A `Problem` has the scenes that share an archive; a
`measure` turns a run into {"error": ..., "series": ...}, the error as rms over two periods relative to `scale`."""
import dataclasses
import math
import typing

import numpy as np

from common import meshes

from . import measures
from .closed_forms import Beam, Drop, Hertz, Plate, Rod, Slide, Sphere, Tumbling
from .settings import BASE, COLLOCATION, Plan, Setting, in_both

ROD, SPHERE, BEAM, TUMBLING, SLIDE, DROP, HERTZ = Rod(), Sphere(), Beam(), Tumbling(), Slide(), Drop(), Hertz()
PLATE = Plate()
SOFT, HARD = Sphere(1e6, 0.0), Sphere(3e5, 0.45)  # the sphere with other Poisson ratios


@dataclasses.dataclass(frozen=True)
class Run:
    """What a scene has left: times (n), positions (n, N, 3), triangles, rotations and translations of the frame."""
    times: np.ndarray
    positions: np.ndarray
    triangles: np.ndarray
    rotations: np.ndarray
    translations: np.ndarray
    steps: int  # per period


@dataclasses.dataclass(frozen=True)
class Problem:
    title: str
    period: float  # [s]
    unit: str  # what a mesh number says
    scale: str  # of the error
    shape: typing.Callable  # mesh number -> arguments of bemshape, or (vertices, triangles)
    material: dict
    scenes: dict  # name -> (scene without time step and archive, measure)
    plan: Plan
    small: tuple  # settings of --small
    periods: float = 2

    def duration(self, steps):
        return self.periods * steps


def box(size, divisions):
    return ("box", "--size", *size, "--divisions", *divisions)


def material(density, shear, poisson):
    return {"name": "study", "density": density, "shear_modulus": shear, "poisson_ratio": poisson}


def slab(axis, at, width=1e-4):
    """The part of a mesh with one coordinate near a value."""
    low, high = [-9.0] * 3, [9.0] * 3
    low[axis], high[axis] = at - width, at + width
    return {"box": {"min": low, "max": high}}


def mean_motion(run, axis, at):
    """Mean displacement along an axis of the vertices with x = `at` at first."""
    chosen = np.abs(run.positions[0, :, 0] - at) < 1e-6
    return (run.positions[:, chosen, :] - run.positions[0, chosen, :]).mean(axis=1)[:, axis]


def compared(series, exact):
    """Of series and exact values per step after the start, in units of the scale."""
    return {"error": measures.rms(series[1:] - exact[1:]), "series": series.tolist()}


def measure_rod(fixed):
    def measure(run):
        return compared(mean_motion(run, 0, ROD.LENGTH / 2) / ROD.STATIC, ROD.end(run.times, fixed) / ROD.STATIC)
    return measure


def rod_scene(fixed):
    load = {"select": {**slab(0, ROD.LENGTH / 2), "normal": [1, 0, 0], "normal_tolerance_deg": 10},
            "traction": [ROD.LOAD, 0, 0]}
    body = {"tractions": [load]}
    if fixed:
        body["fixed"] = [slab(0, -ROD.LENGTH / 2)]
    return {"body": body}


def measure_sphere(sphere):
    """Radius of the sphere of the body's volume: vertices stand out of it, the more the coarser the mesh is."""
    def measure(run):
        corners = run.positions[:, run.triangles]
        volumes = np.einsum("fti,fti->f", corners[:, :, 0], np.cross(corners[:, :, 1], corners[:, :, 2])) / 6
        radii = np.cbrt(3 * volumes / (4 * math.pi))
        return compared((radii - radii[0]) / sphere.static, sphere.pressed(run.times) / sphere.static)
    return measure


def hann(length):
    """Profile of a pulse; it does not excite vibrations with the period length/2."""
    return [[length * k / 64, 0.5 - 0.5 * math.cos(2 * math.pi * k / 64)] for k in range(65)]


@dataclasses.dataclass(frozen=True)
class FreeMode:
    """A mode of vibration of a body that a pulse has set ringing: its angular frequency, the length of the pulse,
    and the weights of the displacements (N, 3) of vertices at rest positions (N, 3) that it is observed with."""
    frequency: float
    pulse: float
    weights: typing.Callable

    @property
    def period(self):
        return 2 * math.pi / self.frequency

    def periods(self):
        """Of the mode that a run takes: the pulse, three to fit and some to spare."""
        return self.pulse / self.period + 3.5

    def series(self, run):
        """What is observed after the pulse, and the time step."""
        rest = (run.positions[0] - run.translations[0]) @ run.rotations[0]
        body = np.einsum("nji,nkj->nki", run.rotations, run.positions - run.translations[:, None, :])
        dt = run.times[1] - run.times[0]
        return np.einsum("nki,ki->n", body - rest, self.weights(rest))[int(math.ceil(self.pulse / dt)) + 1:], dt

    def measure_long(self, run):
        """Energy left after a hundred periods: of vibrations over three periods, then and at first."""
        series, _ = self.series(run)
        ends = [series[k * run.steps:(k + 3) * run.steps] for k in (0, 100)]
        energies = [np.mean((values - np.mean(values))**2) for values in ends]
        return {"error": abs(1 - energies[1] / energies[0]), "energy_100": float(energies[1] / energies[0]),
                "series": series[::run.steps].tolist()}

    def measure(self, run):
        """Error of the free motion exp((i w - d) t) over two periods, relative to its amplitude."""
        series, dt = self.series(run)
        series = series[:3 * run.steps]
        z = measures.factor_of_ringing(series)
        t = np.arange(2 * run.steps + 1)
        off = np.abs(np.exp((np.log(z) - 1j * self.frequency * dt) * t) - 1)
        return {"error": measures.rms(off), "frequency": float(np.angle(z) / dt / self.frequency - 1),
                "energy": float(abs(z)**(2 * self.period / dt)), "series": (series / np.max(np.abs(series))).tolist()}


def quadrupole_weights(rest):
    radii = np.linalg.norm(rest, axis=1)
    return (1.5 * (rest[:, 2] / radii)**2 - 0.5)[:, None] * rest / radii[:, None]


def bending_weights(rest):
    """Like the first bending mode of a free beam: a polynomial that rigid motions are orthogonal to."""
    return np.stack([0 * rest[:, 0], 0 * rest[:, 0], 12 * rest[:, 0]**2 - 1], axis=1)


def torsion_weights(rest):
    return rest[:, 2:] * np.stack([-rest[:, 1], rest[:, 0], 0 * rest[:, 0]], axis=1)


def twist_weights(rest):
    return np.stack([0 * rest[:, 0], 0 * rest[:, 0], rest[:, 0] * rest[:, 1]], axis=1)


def saddle_weights(rest):
    return np.stack([0 * rest[:, 0], 0 * rest[:, 0], rest[:, 0]**2 - rest[:, 1]**2], axis=1)


TORSION = FreeMode(SPHERE.torsion(), 4 * math.pi / SPHERE.torsion(1), torsion_weights)
TWIST = FreeMode(PLATE.TWIST, 0.8 * math.pi / PLATE.TWIST, twist_weights)  # the next such modes are five and three
SADDLE = FreeMode(PLATE.SADDLE, 1.2 * math.pi / PLATE.SADDLE, saddle_weights)  # times as high
QUADRUPOLE = FreeMode(SPHERE.quadrupole(), 4 * math.pi / SPHERE.quadrupole(1), quadrupole_weights)
BENDING = FreeMode(2 * math.pi * BEAM.FREE[0], 2 / BEAM.FREE[1], bending_weights)


def pulled_poles():
    cap = 0.55 * SPHERE.RADIUS
    return {"body": {"tractions": [
        {"select": {"box": {"min": [-9, -9, low], "max": [9, 9, high]}}, "pressure": -1000,
         "profile": hann(QUADRUPOLE.pulse)} for low, high in ((cap, 9), (-9, -cap))]}}


def turned_halves():
    """The upper half of the sphere is turned about z, the lower one against it."""
    low, high = 0.3 * SPHERE.RADIUS, 9
    loads = []
    for x, z in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
        box = {"min": [min(x * low, x * high), -9, min(z * low, z * high)], "max": [max(x * low, x * high), 9, max(z * low, z * high)]}
        loads.append({"select": {"box": box}, "traction": [0, 1000 * x * z, 0], "profile": hann(TORSION.pulse)})
    return {"body": {"tractions": loads}}


def bent_plate(mode, parts):
    """Forces on parts of its upper face, each (x from, to, y from, to, sign)."""
    top = PLATE.THICKNESS / 2
    return {"body": {"tractions": [
        {"select": {"box": {"min": [x0, y0, top - 1e-4], "max": [x1, y1, 9]}, "normal": [0, 0, 1], "normal_tolerance_deg": 10},
         "traction": [0, 0, 100 * sign], "profile": hann(mode.pulse)} for x0, x1, y0, y1, sign in parts]}}


QUADRANTS = ((0.09, 9, 0.09, 9, 1), (-9, -0.09, -9, -0.09, 1), (0.09, 9, -9, -0.09, -1), (-9, -0.09, 0.09, 9, -1))
SIDES = ((0.29, 9, -0.11, 0.11, 1), (-9, -0.29, -0.11, 0.11, 1), (-0.11, 0.11, 0.29, 9, -1), (-0.11, 0.11, -9, -0.29, -1))


def bent_beam():
    """The middle half is pushed up, the quarters at the ends down."""
    parts = ((-9, -0.249, -1000), (-0.251, 0.251, 1000), (0.249, 9, -1000))
    return {"body": {"tractions": [
        {"select": {"box": {"min": [low, -9, 0.0999], "max": [high, 9, 9]}, "normal": [0, 0, 1], "normal_tolerance_deg": 10},
         "traction": [0, 0, force], "profile": hann(BENDING.pulse)} for low, high, force in parts]}}


def measure_beam(run):
    tip = -mean_motion(run, 2, BEAM.LENGTH / 2) / BEAM.static()
    two = slice(0, 2 * run.steps + 1)
    found = compared(tip[two], BEAM.tip(run.times[two]) / BEAM.static())
    found["growth"] = measures.growth_per_period(tip[1:], 1.0, run.steps)
    return found


def measure_tumbling(run):
    return {"error": measures.rms(measures.angle_between(TUMBLING.attitudes(run.times), run.rotations)[1:])}


def measure_slide(run):
    x = run.translations[:, 0] - run.translations[0, 0]
    dt = run.times[1] - run.times[0]
    speeds = np.diff(x) / dt
    last = int(np.flatnonzero(speeds > 0.02 * SLIDE.SPEED)[-1])
    stop = (last + 0.5) * dt + speeds[last] / (SLIDE.FRICTION * SLIDE.GRAVITY)
    way, time = x[-1] / SLIDE.WAY - 1, stop / SLIDE.TIME - 1
    t = np.minimum(run.times, SLIDE.TIME)
    exact = SLIDE.SPEED * t - 0.5 * SLIDE.FRICTION * SLIDE.GRAVITY * t**2
    return {**compared(x / SLIDE.WAY, exact / SLIDE.WAY), "way": float(way), "time": float(time)}


FLOOR = {"contact": {"enabled": True},
         "obstacles": [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]}


def impact_scene(impact, height):
    """Begins at the moment of contact."""
    return {**FLOOR, "body": {"position": [0, 0, height], "velocity": [0, 0, -impact.SPEED]}}


def measure_impact(impact):
    """Way of the centre in units of speed times contact time; speed afterwards and duration of the contact
    over the exact ones."""
    def measure(run):
        way = run.translations[:, 2] - run.translations[0, 2]
        dt = run.times[1] - run.times[0]
        speeds = np.diff(way) / dt
        changing = np.flatnonzero(np.abs(speeds - speeds[-1]) > 1e-3 * impact.SPEED)
        scale = impact.SPEED * impact.TIME
        return {**compared(way / scale, impact.centre(run.times) / scale), "rebound": float(speeds[-1] / impact.SPEED),
                "contact_time": float((changing[-1] + 1) * dt / impact.TIME),
                "approach": float(np.min(way) / np.min(impact.centre(run.times)))}
    return measure


def beam_shape(cells):
    return box((BEAM.LENGTH, BEAM.WIDTH, BEAM.WIDTH), (5 * cells, cells, cells))


def damped(mesh, steps, time):
    """With the damping that the programs name against a vibration that grows."""
    return Setting(mesh, steps, extra=("--damping", f"kelvin_voigt:{time}"), discretisation=COLLOCATION)


def windowed(mesh, steps, window):
    return Setting(mesh, steps, window=window, discretisation=COLLOCATION)


def pressed_sphere(sphere, title, scene, plan, small):
    return Problem(
        title, sphere.breathing_period(), "f (10 f^2 + 2 nodes)", "p0 a/(3K)",
        lambda f: meshes.geodesic_sphere(f, sphere.RADIUS), material(sphere.DENSITY, sphere.shear, sphere.poisson),
        {scene: ({"body": {"tractions": [{"select": "all", "pressure": sphere.LOAD}]}}, measure_sphere(sphere))},
        plan, small)


PROBLEMS = {
    "rod": Problem(
        "Rod, nu = 0, sudden end load", ROD.PERIOD, "cells across", "p0 L/E",
        lambda n: box((ROD.LENGTH, ROD.WIDTH, ROD.WIDTH), (5 * n, n, n)), material(ROD.DENSITY, ROD.YOUNG / 2, 0),
        {"rod-fixed": (rod_scene(True), measure_rod(True)), "rod-free": (rod_scene(False), measure_rod(False))},
        Plan((((1, 2), (20, 40, 80)), ((4,), (20, 40))),
             {"codec": (4, 20), "quadrature": (2, 40), "window": (2, 40), "history": (2, 40), "corners": (2, 40)},
             (*in_both(Setting(4, 80), Setting(6, 80), Setting(7, 20)), windowed(4, 80, "1"))),
        (Setting(1, 20), Setting(2, 20), Setting(1, 20, "bdf1"), Setting(1, 20, codec_tol=1e-2))),
    "sphere": pressed_sphere(
        SPHERE, "Sphere, nu = 0.3, sudden pressure", "sphere",
        Plan((((2, 4), (6, 9, 12)),),
             {"codec": (4, 6), "quadrature": (2, 9), "window": (2, 9), "history": (2, 9)},
             (*in_both(Setting(2, 18), Setting(4, 18), Setting(6, 18), Setting(10, 6), Setting(2, 24), Setting(4, 24)),
              damped(2, 9, "3.1e-5"))),
        (Setting(2, 6), Setting(2, 6, "bdf2"))),
    "sphere-0": pressed_sphere(
        SOFT, "Sphere, nu = 0, sudden pressure", "sphere-0",
        Plan((), more=in_both(*(Setting(m, n, s) for m in (2, 4) for n in (9, 18) for s in ("bdf2", BASE)))),
        (Setting(2, 9),)),
    "sphere-45": pressed_sphere(
        HARD, "Sphere, nu = 0.45, sudden pressure", "sphere-45",
        Plan((), more=in_both(*(Setting(m, n, s) for m in (2, 4) for n in (6, 9) for s in ("bdf2", BASE)))),
        (Setting(2, 6),)),
    "mode": Problem(
        "Sphere, free mode S2", QUADRUPOLE.period, "f (10 f^2 + 2 nodes)", "amplitude",
        lambda f: meshes.geodesic_sphere(f, SPHERE.RADIUS), material(SPHERE.DENSITY, SPHERE.shear, SPHERE.poisson),
        {"mode": (pulled_poles(), QUADRUPOLE.measure), "torsion": (turned_halves(), TORSION.measure)},
        Plan((((2,), (10, 20, 40)), ((4,), (10, 20))), {"window": (2, 20), "history": (2, 20)},
             (*in_both(Setting(6, 10), Setting(6, 20)), damped(2, 20, "5.9e-5")), most_steps={"radau3": 20}),
        (Setting(2, 10), Setting(2, 10, "bdf1")), periods=QUADRUPOLE.periods()),
    "beam-free": Problem(
        "Beam that nothing holds, first bending mode", BENDING.period, "cells across", "amplitude",
        beam_shape, material(BEAM.DENSITY, BEAM.SHEAR, BEAM.POISSON), {"beam-free": (bent_beam(), BENDING.measure)},
        Plan((((2,), (20, 40)), ((4,), (20,))), {"window": (4, 40)}, in_both(Setting(4, 40), Setting(6, 20), Setting(6, 40)),
             most_steps={"radau3": 20}),
        (Setting(1, 20),), periods=BENDING.periods()),
    "plate": Problem(
        "Free plate, its first two modes", TWIST.period, "cells along a fifth of a side", "amplitude",
        lambda n: box((PLATE.SIDE, PLATE.SIDE, PLATE.THICKNESS), (5 * n, 5 * n, 1)), material(PLATE.DENSITY, PLATE.SHEAR, PLATE.POISSON),
        {"plate-twist": (bent_plate(TWIST, QUADRANTS), TWIST.measure), "plate-saddle": (bent_plate(SADDLE, SIDES), SADDLE.measure)},
        Plan((), more=in_both(Setting(1, 40), Setting(2, 40))), (Setting(1, 20),), periods=4),
    "ringing": Problem(
        "Beam that nothing holds, a hundred periods", BENDING.period, "cells across", "energy",
        beam_shape, material(BEAM.DENSITY, BEAM.SHEAR, BEAM.POISSON), {"ringing": (bent_beam(), BENDING.measure_long)},
        Plan((), more=(Setting(2, 40), Setting(2, 40, "radau3"))), (Setting(1, 20),), periods=BENDING.pulse / BENDING.period + 104),
    "beam": Problem(
        "Beam held at one end, sudden gravity", BEAM.period(), "cells across", "deflection at rest",
        beam_shape, material(BEAM.DENSITY, BEAM.SHEAR, BEAM.POISSON),
        {"beam": ({"gravity": [0, 0, -BEAM.GRAVITY], "body": {"fixed": [slab(0, -BEAM.LENGTH / 2)]}}, measure_beam)},
        Plan((((2, 4), (20, 40, 80)),),
             {"codec": (4, 40), "quadrature": (2, 40), "window": (4, 40), "history": (2, 40), "corners": (4, 40)},
             (*in_both(*(Setting(6, steps) for steps in (20, 40, 80)), Setting(6, 40, "theta:0.75"), Setting(4, 12), Setting(4, 16)),
              damped(4, 40, "4.5e-4"))),
        (Setting(1, 20), Setting(1, 20, "theta:0.75")), periods=6),
    "tumble": Problem(
        "Tumbling box, 4 s past its first flip", TUMBLING.DURATION / 2, "cells along the shortest edge", "radians",
        lambda n: box(TUMBLING.SIZE, (3 * n, 2 * n, n)), material(1000, 1e7, 0.3),
        {"tumble": ({"body": {"angular_velocity": list(TUMBLING.SPIN)}}, measure_tumbling)},
        Plan((((1,), (150, 300, 600)),), more=(*in_both(Setting(2, 300)), Setting(1, 300, model="rigid"))),
        (Setting(1, 150), Setting(1, 300))),
    "slide": Problem(
        "Block that slides to rest", SLIDE.TIME, "cells over the height", "way",
        lambda n: box(SLIDE.SIZE, (4 * n, 4 * n, n)), material(SLIDE.DENSITY, SLIDE.SHEAR, SLIDE.POISSON),
        {"slide": ({**FLOOR, "gravity": [0, 0, -SLIDE.GRAVITY],
                    "body": {"position": [0, 0, SLIDE.SIZE[2] / 2], "velocity": [SLIDE.SPEED, 0, 0],
                             "friction": SLIDE.FRICTION}}, measure_slide)},
        Plan((((1,), (64, 128, 256)),), more=(*in_both(Setting(2, 128)), Setting(1, 128, model="rigid"))),
        (Setting(1, 32), Setting(1, 32, "bdf2")), periods=1.2),
    "drop": Problem(
        "Cube that falls flat, nu = 0", DROP.TIME, "cells per side", "speed times contact time",
        lambda n: box(3 * (DROP.SIDE,), 3 * (n,)), material(DROP.DENSITY, DROP.SHEAR, 0),
        {"drop": (impact_scene(DROP, DROP.SIDE / 2), measure_impact(DROP))},
        Plan((), more=(*in_both(Setting(4, 40), Setting(8, 40), Setting(4, 80)), windowed(4, 40, "1"),
                       *(Setting(4, 40, s) for s in ("bdf1", "theta:0.75", "bdf2", "radau3")))),
        (Setting(2, 20),)),
    "ball": Problem(
        "Ball that falls on a floor, against Hertz", HERTZ.TIME, "f (10 f^2 + 2 nodes)", "speed times contact time",
        lambda f: meshes.geodesic_sphere(f, HERTZ.RADIUS), material(HERTZ.DENSITY, HERTZ.SHEAR, HERTZ.POISSON),
        {"ball": (impact_scene(HERTZ, HERTZ.RADIUS), measure_impact(HERTZ))},
        Plan((), more=(*in_both(Setting(4, 33), Setting(8, 33)), windowed(8, 33, "1"))),
        (Setting(2, 20),)),
}
