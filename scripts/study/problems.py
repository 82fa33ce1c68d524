"""The problems of the study: body, scene and error of each. A `Problem` has the scenes that share an archive; a
`measure` turns a run into {"error": ..., "series": ...}, the error as rms over two periods relative to `scale`."""
import dataclasses
import math
import typing

import numpy as np

from . import measures, meshes
from .closed_forms import Beam, Rod, Slide, Sphere, Tumbling
from .settings import Plan, Setting

ROD, SPHERE, BEAM, TUMBLING, SLIDE = Rod(), Sphere(), Beam(), Tumbling(), Slide()


@dataclasses.dataclass(frozen=True)
class Run:
    """What a scene has left: times (n), positions (n, N, 3), rotations and translations of the frame."""
    times: np.ndarray
    positions: np.ndarray
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


def measure_sphere(run):
    radii = np.linalg.norm(run.positions, axis=2)
    return compared((radii - radii[0]).mean(axis=1) / SPHERE.static, SPHERE.pressed(run.times) / SPHERE.static)


MODE_PERIOD = 2 * math.pi / SPHERE.quadrupole()
PULSE = 4 * math.pi / SPHERE.quadrupole(1)  # a Hann pulse as long as this does not excite the overtone


def mode_scene():
    pulse = [[PULSE * k / 64, 0.5 - 0.5 * math.cos(2 * math.pi * k / 64)] for k in range(65)]
    cap = 0.55 * SPHERE.RADIUS
    return {"body": {"tractions": [
        {"select": {"box": {"min": [-9, -9, low], "max": [9, 9, high]}}, "pressure": -1000, "profile": pulse}
        for low, high in ((cap, 9), (-9, -cap))]}}


def measure_mode(run):
    """Error of the free motion exp((i w - d) t) over two periods, relative to its amplitude."""
    rest = np.array([run.rotations[0].T @ x for x in run.positions[0] - run.translations[0]])
    body = np.einsum("nji,nkj->nki", run.rotations, run.positions - run.translations[:, None, :])
    radial = np.einsum("nki,ki->nk", body - rest, rest / np.linalg.norm(rest, axis=1)[:, None])
    weights = 1.5 * (rest[:, 2] / np.linalg.norm(rest, axis=1))**2 - 0.5
    dt = run.times[1] - run.times[0]
    series = (radial @ weights / np.sum(weights**2))[int(math.ceil(PULSE / dt)) + 1:][:3 * run.steps]
    z = measures.factor_of_ringing(series)
    exact, t = SPHERE.quadrupole(), np.arange(2 * run.steps + 1)
    off = np.abs(np.exp((np.log(z) - 1j * exact * dt) * t) - 1)
    return {"error": measures.rms(off), "frequency": float(np.angle(z) / dt / exact - 1),
            "energy": float(abs(z)**(2 * MODE_PERIOD / dt)), "series": (series / np.max(np.abs(series))).tolist()}


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


PROBLEMS = {
    "rod": Problem(
        "Rod, nu = 0, sudden end load", ROD.PERIOD, "cells across", "p0 L/E",
        lambda n: box((ROD.LENGTH, ROD.WIDTH, ROD.WIDTH), (5 * n, n, n)), material(ROD.DENSITY, ROD.YOUNG / 2, 0),
        {"rod-fixed": (rod_scene(True), measure_rod(True)), "rod-free": (rod_scene(False), measure_rod(False))},
        Plan((((1, 2), (20, 40, 80)), ((4,), (20, 40))),
             {"codec": (4, 20), "quadrature": (2, 40), "window": (2, 40), "history": (2, 40), "corners": (2, 40)},
             (Setting(4, 80), Setting(4, 80, window="1"), Setting(7, 20))),
        (Setting(1, 20), Setting(2, 20), Setting(1, 20, "bdf1"), Setting(1, 20, codec_tol=1e-2))),
    "sphere": Problem(
        "Sphere, nu = 0.3, sudden pressure", SPHERE.breathing_period(), "f (10 f^2 + 2 nodes)", "p0 a/(3K)",
        lambda f: meshes.geodesic_sphere(f, SPHERE.RADIUS), material(SPHERE.DENSITY, SPHERE.shear, SPHERE.poisson),
        {"sphere": ({"body": {"tractions": [{"select": "all", "pressure": SPHERE.LOAD}]}}, measure_sphere)},
        Plan((((2, 4), (6, 9, 12)),),
             {"codec": (4, 6), "quadrature": (2, 9), "window": (2, 9), "history": (2, 9)},
             (Setting(2, 18), Setting(4, 18), Setting(6, 18), Setting(10, 6))),
        (Setting(2, 6), Setting(2, 6, "bdf2"))),
    "mode": Problem(
        "Sphere, free mode S2", MODE_PERIOD, "f (10 f^2 + 2 nodes)", "amplitude",
        lambda f: meshes.geodesic_sphere(f, SPHERE.RADIUS), material(SPHERE.DENSITY, SPHERE.shear, SPHERE.poisson),
        {"mode": (mode_scene(), measure_mode)},
        Plan((((2,), (10, 20, 40)), ((4,), (10, 20))), {"window": (2, 20), "history": (2, 20)}),
        (Setting(2, 10), Setting(2, 10, "bdf1")), periods=PULSE / MODE_PERIOD + 3.5),
    "beam": Problem(
        "Beam held at one end, sudden gravity", BEAM.period(), "cells across", "deflection at rest",
        lambda n: box((BEAM.LENGTH, BEAM.WIDTH, BEAM.WIDTH), (5 * n, n, n)),
        material(BEAM.DENSITY, BEAM.SHEAR, BEAM.POISSON),
        {"beam": ({"gravity": [0, 0, -BEAM.GRAVITY], "body": {"fixed": [slab(0, -BEAM.LENGTH / 2)]}}, measure_beam)},
        Plan((((2, 4), (20, 40, 80)),),
             {"codec": (4, 40), "quadrature": (2, 40), "window": (4, 40), "history": (2, 40), "corners": (4, 40)},
             (*(Setting(6, steps) for steps in (20, 40, 80)), Setting(6, 40, "theta:0.75"))),
        (Setting(1, 20), Setting(1, 20, "theta:0.75")), periods=6),
    "tumble": Problem(
        "Tumbling box, 4 s past its first flip", TUMBLING.DURATION / 2, "cells along the shortest edge", "radians",
        lambda n: box(TUMBLING.SIZE, (3 * n, 2 * n, n)), material(1000, 1e7, 0.3),
        {"tumble": ({"body": {"angular_velocity": list(TUMBLING.SPIN)}}, measure_tumbling)},
        Plan((((1,), (150, 300, 600)),), more=(Setting(2, 300), Setting(1, 300, model="rigid"))),
        (Setting(1, 150), Setting(1, 300))),
    "slide": Problem(
        "Block that slides to rest", SLIDE.TIME, "cells over the height", "way",
        lambda n: box(SLIDE.SIZE, (4 * n, 4 * n, n)), material(SLIDE.DENSITY, SLIDE.SHEAR, SLIDE.POISSON),
        {"slide": ({"gravity": [0, 0, -SLIDE.GRAVITY],
                    "body": {"position": [0, 0, SLIDE.SIZE[2] / 2], "velocity": [SLIDE.SPEED, 0, 0],
                             "friction": SLIDE.FRICTION},
                    "obstacles": [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}],
                    "contact": {"enabled": True}}, measure_slide)},
        Plan((((1,), (64, 128, 256)),), more=(Setting(2, 128), Setting(1, 128, model="rigid"))),
        (Setting(1, 32), Setting(1, 32, "bdf2")), periods=1.2),
}
