"""The hard cases: what is run (meshes, materials, options of bemprecomp, scenes of scenes/hard), what is expected
in words, and the bounds that what is measured (figures.py) has to keep."""
import dataclasses

import numpy as np

from common import meshes

from . import figures
from .figures import Image


@dataclasses.dataclass(frozen=True)
class Body:
    """A mesh, `mesh`: a function of meshes.py or a shape of bemshape with its arguments, and how its archive is
    made: with the time step `dt` [s], or one of which a shear wave takes `lam` across the body."""
    mesh: tuple
    material: str = "rubber"  # of scenes/hard/material-NAME.json
    changes: dict = dataclasses.field(default_factory=dict)  # of the material
    lam: float = 6
    dt: float | None = None
    options: tuple = ()  # of bemprecomp
    moved: tuple = ()  # functions mesh -> mesh
    scale: float = 1.0  # --mesh-scale


@dataclasses.dataclass(frozen=True)
class Trial:
    """A run: `scene` (of scenes/hard) with `changes` {JSON path: value or function of the time step}, how it has to
    end ("complete"; "refused": bemprecomp with exit code 5; "complete or stopped": bemsim with it), what has to be said (regular
    expressions), and bounds {figure: ("<=" or ">=", value)}."""
    name: str
    bodies: dict
    scene: str = "pushed"
    changes: dict = dataclasses.field(default_factory=dict)
    obstacles: dict = dataclasses.field(default_factory=dict)  # name: function of meshes.py with its arguments
    steps: int = 1000
    short_steps: int = 0  # of the short variant (0: as many)
    short: bool = False  # whether it is part of the short variant
    frames: int = 500  # about as many are written; 0: all
    measured: tuple | None = None  # options of bemmeasure, where it runs
    also: tuple = ()  # further functions of figures.py
    ends: str = "complete"
    says: tuple = ()
    bounds: dict = dataclasses.field(default_factory=dict)
    short_bounds: dict = dataclasses.field(default_factory=dict)  # instead of those, in the short variant
    image_of: tuple | None = None  # (name of another trial, Image): compared with it


@dataclasses.dataclass(frozen=True)
class Case:
    expected: str
    trials: tuple
    group: str  # of the tests


# Nothing takes from slow vibrations, so that two of them may meet later at a little more than before.
STEADY = {"moved": (">=", 1e-6), "later/early": ("<=", 1.05)}
# A free body that was pushed: bounded, moving at all, momentum exact.
FREE = {**STEADY, "displacement": ("<=", 0.01), "momentum defect": ("<=", 1e-14)}
TOUCHING = {"penetration": ("<=", 2e-5), "energy gain": ("<=", 1e-4), "not met": ("<=", 0)}


def push(dt):
    """For five steps."""
    return [[0, 1], [4 * dt, 1], [5 * dt, 0]]


PUSH = {"/bodies/0/tractions/0/profile": push}


def pushed(name, body, **more):
    bounds = {**FREE, **more.pop("bounds", {})}
    changes = {**PUSH, **more.pop("changes", {})}
    return Trial(name, {"body": body}, changes=changes, bounds=bounds, **more)


def dropped(name, body, **more):
    """Onto the floor, askew."""
    bounds = {**TOUCHING, **more.pop("bounds", {})}
    changes = {"/bodies/0/rotation": {"axis": [1, 0, 1], "angle_deg": 30}, **more.pop("changes", {})}
    return Trial(name, {"body": body}, "drop", changes, measured=(), frames=0, bounds=bounds, **more)


def nu(value):
    return {"poisson_ratio": value}


COLLOCATION = ("--discretisation", "collocation")


def refused(name, body, **more):
    """With the paper's discretisation, which the message names the default against."""
    return Trial(f"{name}-collocation", {"body": dataclasses.replace(body, options=COLLOCATION)}, ends="refused",
                 says=("use --discretisation galerkin or a larger --dt",), **more)


# Their shear waves go a fifth to a half of an edge in a step.
REFUSED_PLATES = ("20-0.48-25", "20-0.4999-10", "20-0.4999-25", "50-0.4999-25")


def bending_period(ratio, lam):
    """Of a free square plate, about [steps]."""
    return lam * ratio / 1.5


def plates():
    trials = []
    for ratio in (20, 50):
        for poisson in (0.3, 0.48, 0.4999):
            for lam in (3.5, 10, 25):
                body = Body(("box", (1, 1, 1 / ratio), (5, 5, 1)), changes=nu(poisson), lam=lam)
                name = f"{ratio}-{poisson}-{lam}"
                steps = round(5 * bending_period(ratio, lam))  # a quarter of them is more than one period
                trials.append(pushed(name, body, steps=max(2000, steps), short_steps=steps,
                                     short=name in ("20-0.3-3.5", "20-0.4999-3.5"),
                                     bounds={"displacement": ("<=", 0.01 if ratio == 20 else 0.1)}))
                if name in REFUSED_PLATES:
                    trials.append(refused(name, body, short=name == "20-0.4999-10"))
    return tuple(trials)


def held_plates():
    """A plate that is held has a fifth of the frequency of a free one."""
    trials = []
    for ratio in (20, 50):
        for poisson in (0.3, 0.4999):
            for lam in (3.5, 10):
                body = Body(("box", (1, 1, 1 / ratio), (5, 5, 1)), changes=nu(poisson), lam=lam)
                steps = round(25 * bending_period(ratio, lam))
                trials.append(Trial(f"{ratio}-{poisson}-{lam:g}", {"body": body}, "held", PUSH, steps=max(2000, steps),
                                    short_steps=steps, short=(ratio, poisson, lam) == (20, 0.3, 3.5), bounds=STEADY))
    return tuple(trials)


def odd_meshes():
    thin = ("very thin triangles",)
    trials = []
    for name, says in (("needles", thin), ("slivers", thin), ("abrupt", thin), ("graded", ())):
        trials.append(pushed(f"{name}-free", Body((name,), lam=3.5), says=says, steps=1000, short_steps=200, short=True))
        trials.append(dropped(f"{name}-falls", Body((name,), lam=6), says=says, steps=400, short_steps=80,
                              short=name == "slivers"))
    return tuple(trials)


def gaps():
    """The closer faces are for their size, the longer the default takes: a minute for 0.01, where edges are 30 times as
    long."""
    trials = [pushed(f"gap-{gap:g}", Body(("slotted", gap), lam=6, options=options), steps=1000, short_steps=200,
                     short=gap == 0.05) for gap, options in ((0.05, ()), (0.01, ()), (0.001, COLLOCATION))]
    trials.append(Trial("closed", {"body": Body(("slotted", 0.01), lam=20, options=COLLOCATION)}, "closing",
                        measured=("--self",), also=(figures.shut,), steps=200, short_steps=50, short=True, frames=25,
                        bounds={"penetration": ("<=", 2e-5), "not met": ("<=", 0), "gap left": (">=", -1e-3)}))
    return tuple(trials)


def corners():
    trials = []
    for name in ("angle", "cross"):
        for poisson in (0.3, 0.49):
            body = Body((name,), changes=nu(poisson), lam=6)
            if (name, poisson) == ("cross", 0.49):
                trials.append(refused("cross-0.49-free", body, short=True))
            trials.append(pushed(f"{name}-{poisson}-free", body, steps=1000, short_steps=200, short=poisson == 0.49))
        trials.append(dropped(f"{name}-falls", Body((name,), lam=6), steps=400, short_steps=80, short=name == "cross"))
    return tuple(trials)


def poisson_ratios():
    trials = []
    for name, mesh in (("ball", ("icosphere", "--subdivisions", 1, "--radius", 0.5)),
                       ("cube", ("box", (1, 1, 1), (2, 2, 2)))):
        for poisson in (0, 0.49, 0.4999, 0.5):
            trials.append(pushed(f"{name}-{poisson}", Body(mesh, changes=nu(poisson), lam=3), steps=2000,
                                 short_steps=200, short=True))
    fine = Body(("box", (1, 1, 1), (2, 2, 2)), changes=nu(0.5), lam=30)
    return (*trials, pushed("cube-0.5-fine-steps", fine, steps=2000, short_steps=400, short=True),
            refused("cube-0.5-fine-steps", fine, short=True))


def time_steps():
    mesh = ("icosphere", "--subdivisions", 0, "--radius", 0.5)
    trials = []
    for lam, history in ((0.1, 2), (0.3, 3), (1, 5), (3, 7), (6, 11), (12, 17), (25, 38), (50, 67), (80, 100)):
        options = ("--history", 2) if history == 2 else ()
        trials.append(pushed(f"history-{history}", Body(mesh, lam=lam, options=options), steps=max(300, 40 * round(lam)),
                             short_steps=150, short=history in (2, 5, 17, 38),
                             bounds={"history": (">=", history)}))
    return tuple(trials)


EXACT = ("--codec", "none", "--precision", "float64", "--window", 0.98, "--quadrature-tol", 1e-10)
BLOCK, COARSE_BLOCK = (("box", (1, 0.8, 0.6), cells) for cells in ((3, 2, 2), (2, 1, 1)))


def scaled(length):
    """The pushed block and the falling one in other units of length: same times, same strains."""
    shear = {"shear_modulus": 1e6 * length**2}
    push_changes = {"/bodies/0/tractions/0/select/box": {"min": [0.05 * length, -2 * length, -2 * length],
                                                         "max": [2 * length, 2 * length, 2 * length]},
                    "/bodies/0/tractions/0/traction": [1000 * length**2, 300 * length**2, 200 * length**2]}
    drop_changes = {"/gravity": [0, -9.81 * length, 0], "/bodies/0/position": [0, length, 0],
                    "/bodies/0/velocity": [0.5 * length, -length, 0], "/contact": {"tolerance": 1e-6 * length}}
    return shear, push_changes, drop_changes


def units():
    trials = []
    for codec, mesh, options, bound in (("exact", COARSE_BLOCK, EXACT, 1e-9), ("lowrank", BLOCK, (), 1e-3)):
        for name, length in (("metres", 1), ("millimetres", 1e-3), ("kilometres", 1e3)):
            shear, push_changes, drop_changes = scaled(length)
            body = Body(mesh, changes=shear, dt=0.005, options=options, scale=length)
            short = {"short": codec == "exact", "short_steps": 100}
            for kind, make, changes in (("free", pushed, push_changes), ("falls", dropped, drop_changes)):
                allowed = max(bound, 1e-2) if (kind, codec) == ("falls", "lowrank") else bound  # tumbling makes more of it
                same = {} if length == 1 else {"bounds": {"positions differ": ("<=", allowed)}}
                first = f"{kind}-metres-{codec}"
                trials.append(make(f"{kind}-{name}-{codec}", body, changes=changes, steps=300, **short, **same,
                                   image_of=None if length == 1 else (first, Image(length))))
    return tuple(trials)


def turned_mesh(turn):
    return lambda mesh: (mesh[0] @ turn.T, mesh[1])


def renumbered_mesh(order):
    """Vertices in another order, triangles, too, and starting at other corners."""
    place = np.argsort(order)

    def change(mesh):
        triangles = place[np.asarray(mesh[1])]
        triangles = np.array([np.roll(t, k % 3) for k, t in enumerate(triangles)])
        return np.asarray(mesh[0])[order], triangles[np.random.default_rng(2).permutation(len(triangles))]
    return change


def motions():
    turn = figures.rotation({"axis": [3, 1, 2], "angle_deg": 77})
    trials = []
    # points on triangles that touch depend on the numbering of their corners
    for codec, mesh, options, bound in (("exact", COARSE_BLOCK, EXACT, 1e-7), ("lowrank", BLOCK, (), 1e-3)):
        block = getattr(meshes, mesh[0])(*mesh[1:])
        count = len(block[0])
        pulled = np.flatnonzero(block[0][:, 0] > 0.05)
        order = np.random.default_rng(1).permutation(count)
        place = np.argsort(order)
        ways = {"plain": (np.eye(3), np.arange(count), ()), "turned": (turn, np.arange(count), (turned_mesh(turn),)),
                "renumbered": (np.eye(3), order, (renumbered_mesh(order),)),
                "both": (turn, order, (turned_mesh(turn), renumbered_mesh(order)))}
        for way, (r, o, moved) in ways.items():
            body = Body(mesh, dt=0.005, options=options, moved=moved)
            chosen = pulled if o is not order else place[pulled]
            changes = {"/bodies/0/tractions/0/select": {"vertices": sorted(int(v) for v in chosen)},
                       "/bodies/0/tractions/0/traction": list(r @ [1000, 300, 200]),
                       "/bodies/0/angular_velocity": list(r @ [0.02, 0.03, 0.05])}
            # the mesh is turned, the body is placed as before in the turned world
            axis = figures.rotation({"axis": [1, 0, 1], "angle_deg": 30})
            falls = {"/gravity": list(r @ [0, -9.81, 0]), "/bodies/0/position": list(r @ [0, 1, 0]),
                     "/bodies/0/velocity": list(r @ [0.5, -1, 0]),
                     "/bodies/0/rotation": axis_and_angle(r @ axis @ r.T),
                     "/obstacles/0/plane/normal": list(r @ [0, 1, 0])}
            short = {"short": codec == "exact" and way in ("plain", "both"), "short_steps": 100}
            if codec == "exact":
                falls["/contact/tolerance"] = 1e-12
            for kind, make, change in (("free", pushed, changes), ("falls", dropped, falls)):
                # contacts are solved for in other axes and orders; edges that land make more of what that leaves
                allowed = {"exact": 1e-5, "lowrank": 1e-2}[codec] if kind == "falls" else bound
                same = {} if way == "plain" else {"bounds": {"positions differ": ("<=", allowed)}}
                # while it tumbles, a difference of two motions grows tenfold in 40 steps
                steps = 150 if kind == "falls" else 300
                trials.append(make(f"{kind}-{way}-{codec}", body, changes=change, steps=steps, **short, **same, image_of=None
                                   if way == "plain" else (f"{kind}-plain-{codec}", Image(1, r, o))))
    return tuple(trials)


def axis_and_angle(turn):
    axis = np.array([turn[2, 1] - turn[1, 2], turn[0, 2] - turn[2, 0], turn[1, 0] - turn[0, 1]])
    angle = np.arctan2(np.linalg.norm(axis), np.trace(turn) - 1)
    return {"axis": list(axis), "angle_deg": float(np.degrees(angle))}


def minimal():
    trials = []
    for name, mesh in (("cube", ("box", (1, 1, 1), (1, 1, 1))), ("tetrahedron", ("tetrahedron",))):
        for lam in (2, 6):
            side = {"/bodies/0/tractions/0/select": {"triangles": [0]}}
            trials.append(pushed(f"{name}-{lam}-free", Body(mesh, lam=lam), changes=side, steps=2000, short_steps=300, short=True))
        trials.append(dropped(f"{name}-falls", Body(mesh, lam=2), steps=600, short_steps=150, short=True))
    return tuple(trials)


def stacks():
    cube = ("box", (0.2, 0.2, 0.2), (2, 2, 2))
    trials = []
    for name, options in (("elastic", ()), ("rigid", ("--model", "rigid"))):
        bodies = {"light": Body(cube, "light", dt=0.002, options=options),
                  "heavy": Body(cube, "heavy", dt=0.002, options=options)}
        trials.append(Trial(name, bodies, "stack", steps=2500, short_steps=250, short=True, measured=(),
                            bounds={**TOUCHING, "drift": ("<=", 1e-3)}, short_bounds={"drift": ("<=", 1e-2)}))
    return tuple(trials)


def impacts():
    """Balls of 0.2 m whose shear waves have 32 m/s, at a half space, a plate of 20 mm and another ball."""
    ball = ("icosphere", "--subdivisions", 1, "--radius", 0.1)
    strict = {"passed through": ("<=", 0), "pushed on": (">=", 0.4), "energy gain": ("<=", 1e-4),
              "penetration": ("<=", 2e-5), "not met": ("<=", 0)}
    loose = {"passed through": ("<=", 0), "pushed on": (">=", 0.4), "energy gain": ("<=", 1e-4), "penetration": ("<=", 5e-3)}
    chance = {**loose, "penetration": ("<=", 0.1)}  # of a step whose contacts are not met, which the warning says
    broken = {"energy gain": ("<=", 1e-4)}  # balls are flattened to nothing: a warning is what can be expected
    unmet = {"passed through": ("<=", 0), "energy gain": ("<=", 1e-4)}  # where the ball goes is left to chance
    rigid = ("--model", "rigid")
    trials = []
    for name, speed, dt, options, bounds in (
            ("c2", 30, 0.002, (), strict), ("c2-in-3-sizes", 30, 0.02, (), chance),
            ("c2-in-3-sizes-off-centre", 30, 0.02, (), unmet),
            ("rigid-in-3-sizes", 30, 0.02, rigid, loose), ("10-c2-in-3-sizes", 300, 0.002, (), broken),
            ("10-c2-in-30-sizes", 300, 0.02, (), broken)):
        changes = {f"/bodies/{k}/velocity": v for k, v in enumerate(([-speed, 0, 0], [0, -speed, 0], [0, -speed, 0]))}
        if "off-centre" in name:
            changes["/bodies/3"] = {"name": "target", "archive": "ball.bem", "position": [6.02, 0, 0.01]}
        trials.append(Trial(name, {"ball": Body(ball, dt=dt, options=options)}, "impact", changes,
                            {"plate": ("box", (0.6, 0.02, 0.6), (6, 1, 6))}, steps=20, short=bounds in (strict, loose, chance), frames=0,
                            measured=(), also=(figures.impact,), bounds=bounds,
                            ends="complete or stopped" if bounds is broken else "complete",
                            says=("use a shorter time step",) if bounds in (broken, chance) else ()))
    return tuple(trials)


def rests():
    still = {"/bodies/0/velocity": [0, 0, 0]}
    slope = {**still, "/gravity": [2.5, -9.5, 0]}
    at = {"/bodies/0/position": [0, 0.1, 0], "/bodies/0/rotation": {"axis": [0, 1, 0], "angle_deg": 20}}
    cube = ("box", (0.2, 0.2, 0.2), (2, 2, 2))
    plate = ("box", (1, 0.05, 1), (4, 1, 4))
    lie = {"/bodies/0/position": [0, 0.025, 0], "/bodies/0/rotation": {"axis": [0, 1, 0], "angle_deg": 20}}
    bounds = {"drift": ("<=", 1e-5), "end speed": ("<=", 1e-5)}
    soon = {"end speed": ("<=", 1e-3), "drift": ("<=", 1e-4)}  # they still vibrate
    trials = []
    for name, mesh, changes in (("cube", cube, {**still, **at}), ("cube-on-slope", cube, {**slope, **at}),
                                ("plate", plate, {**still, **lie})):
        trials.append(dropped(name, Body(mesh, dt=0.005), changes=changes, steps=12000, short_steps=600,
                              short=name != "plate", bounds=bounds, short_bounds=soon))
    return tuple(dataclasses.replace(t, frames=600) for t in trials)


def tops():
    trials = []
    for name, options in (("elastic", ()), ("rigid", ("--model", "rigid"))):
        trials.append(Trial(name, {"top": Body(("top",), "hard", dt=0.0005, options=options)}, "top", steps=10000,
                            short_steps=1000, short=True, frames=1000, measured=(), also=(figures.tilt,),
                            bounds={**TOUCHING, "tilt": ("<=", 15), "tip lifts": ("<=", 1e-2)}))
    return tuple(trials)


def long_runs():
    mesh = ("icosphere", "--subdivisions", 1, "--radius", 0.5)
    spin = {"/bodies/0/angular_velocity": [1, 2, 3]}
    return (pushed("ball", Body(mesh, lam=3.5), changes=spin, steps=100000, short_steps=4000, short=True),
            pushed("beam", Body(("box", (1, 0.25, 0.25), (4, 1, 1)), lam=3.5), changes=spin, steps=100000,
                   short_steps=4000, short=True))


CASES = {
    "plates": Case("free plates of 1 m, 20:1 and 50:1, one cell thick and 4 to 10 thicknesses long, ν 0.3, 0.48, "
                   "0.4999, pushed: the motion does not grow; with collocation time steps too short for sharp edges with "
                   "ν near 0.5 are refused with the cure", plates(), "shapes"),
    "held-plates": Case("the same plates, held at one edge and pushed: the motion does not grow", held_plates(), "shapes"),
    "odd-meshes": Case("cubes with needles (aspect 2000, 0.03°), slivers (10,000, 0.01°), triangles beside others a "
                       "hundred times as long, triangles graded 256 to 1; pushed, and dropped askew: a warning of thin "
                       "triangles, the motion does not grow, nothing penetrates", odd_meshes(), "shapes"),
    "gaps": Case("a C of 1 m whose arms are 50 mm, 10 mm or 1 mm apart: the motion does not grow; pressed together they touch and do "
                 "not pass through each other", gaps(), "shapes"),
    "re-entrant": Case("an L and three crossed bars, pushed and dropped: as above; with collocation too short a time step for "
                       "ν 0.49 is refused with the cure", corners(), "shapes"),
    "minimal": Case("a cube of 8 vertices and a tetrahedron, pushed and dropped: as above", minimal(), "shapes"),
    "poisson": Case("a ball and a cube with ν 0, 0.49, 0.4999, 0.5: the motion does not grow; with collocation a time step "
                    "much too short for the cube with 0.5 is refused with the cure", poisson_ratios(), "materials"),
    "time-steps": Case("an icosahedron, histories of 2 to 100 steps: the motion does not grow", time_steps(), "materials"),
    "long": Case("100,000 steps of a tumbling ball and beam after a push: the motion does not grow, momentum is exact",
                 long_runs(), "materials"),
    "units": Case("a block in metres, millimetres and kilometres, pushed and dropped: the same but for rounding "
                  "(lowrank: its tolerance)", units(), "invariance"),
    "motions": Case("the block in a turned world and with other numbers of vertices and triangles: the same but for "
                    "the quadrature; falling: but for what tumbling makes of it", motions(), "invariance"),
    "stack": Case("a cube on one a thousandth of its mass, elastic and rigid: they stay", stacks(), "contact"),
    "impact": Case("balls at the speed of shear waves and ten times that, up to thirty of their sizes per step, at a half "
                   "space, a thin plate and a ball: none gets through, or a warning names the cure", impacts(), "contact"),
    "rest": Case("a cube, a cube on a slope and a plate lie on a floor for 60 s: no drift, no energy, no penetration",
                 rests(), "contact"),
    "top": Case("a top with 200 rad/s on its tip for 5 s, elastic and rigid: stays upright, energy does not grow",
                tops(), "contact"),
}
