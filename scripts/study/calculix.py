"""The beam and the rod with CalculiX (ccx), a volume finite element program, to compare with: input files, runs
on one thread, and what the .dat files say."""
import math
import pathlib
import re
import shutil
import sys

import numpy as np

from common.machine import OtherLoad
from common.programs import ROOT, Failed, Programs, visible
from common.results import Results

from . import measures
from .closed_forms import Beam, Rod

ALPHA = -0.05  # of the Hilber-Hughes-Taylor method, the default of ccx
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1", "CCX_NPROC_STIFFNESS": "1",
               "NUMBER_OF_CPUS": "1"}
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
PARTS = {8: (tuple(range(8)),),  # of a cell: itself, or tetrahedra about a diagonal
         4: ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))}
EDGES = {8: ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)),
         4: ((0, 1), (1, 2), (2, 0), (0, 3), (1, 3), (2, 3))}
FACES = {8: ((0, 1, 2, 3), (4, 7, 6, 5), (0, 4, 5, 1), (1, 5, 6, 2), (2, 6, 7, 3), (3, 7, 4, 0)),
         4: ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))}  # P1, P2, ... of ccx


def corner_count(element):
    """Of an element type by its name: C3D4 and C3D10 have 4, the other ones 8."""
    return 4 if element in ("C3D4", "C3D10") else 8


def block(size, cells, element):
    """Nodes {number: (x, y, z)}, elements (lists of node numbers in the order of ccx), of a box from the origin."""
    count = corner_count(element)
    quadratic = element.startswith(("C3D20", "C3D10"))
    cells, index, nodes = np.array(cells), {}, {}

    def node(twice):
        key = tuple(int(c) for c in twice)
        if key not in index:
            index[key] = len(index) + 1
            nodes[index[key]] = tuple(s * k / (2 * n) for s, k, n in zip(size, key, cells))
        return index[key]

    elements = []
    for cell in np.ndindex(*cells):
        for part in PARTS[count]:
            corners = [2 * np.array(cell) + 2 * np.array(CORNERS[c]) for c in part]
            middles = [(corners[a] + corners[b]) // 2 for a, b in EDGES[count]] if quadratic else []
            elements.append([node(k) for k in [*corners, *middles]])
    return nodes, elements


def faces_at(nodes, elements, element, x):
    """(number of the element, number of its face), from 1, of the faces in a plane across the box."""
    return [(e, f) for e, corners in enumerate(elements, 1) for f, face in enumerate(FACES[corner_count(element)], 1)
            if all(abs(nodes[corners[k]][0] - x) < 1e-9 for k in face)]


def lines_of(numbers, width=8):
    numbers = [str(n) for n in numbers]
    return [", ".join(numbers[i:i + width]) + ("," if i + width < len(numbers) else "")
            for i in range(0, len(numbers), width)]


def model(body, element, cells, poisson, held=True):
    """The part of an input file before its steps, and the mesh; the end x = L is the set END, the other one, which
    may be held, ROOT."""
    length, width = body.LENGTH, body.WIDTH
    nodes, elements = block((length, width, width), cells, element)
    text = ["*NODE, NSET=NALL", *(f"{n}, {x:.10g}, {y:.10g}, {z:.10g}" for n, (x, y, z) in nodes.items()),
            f"*ELEMENT, TYPE={element}, ELSET=EALL"]
    for n, corners in enumerate(elements, 1):
        text += lines_of([n, *corners])
    for name, at in (("ROOT", 0), ("END", length)):
        text += [f"*NSET, NSET={name}", *lines_of(n for n, p in nodes.items() if abs(p[0] - at) < 1e-9)]
    text += ["*MATERIAL, NAME=M", "*ELASTIC", f"{body.YOUNG:.10g}, {poisson}",
             "*DENSITY", f"{body.DENSITY:g}", "*SOLID SECTION, ELSET=EALL, MATERIAL=M"]
    return text + (["*BOUNDARY", "ROOT, 1, 3"] if held else []), nodes, elements


def gravity(nodes, elements, element):
    return ["*DLOAD", "EALL, GRAV, 1., 0., 0., -1."]


def pull(nodes, elements, element):
    """Of the end x = L."""
    return ["*DLOAD", *(f"{e}, P{f}, {-Rod.LOAD:g}" for e, f in faces_at(nodes, elements, element, Rod.LENGTH))]


MODAL = "modes"  # of C3D20 elements, superposed: exact in time, for what is linear and vibrates
CASES = {"beam": (Beam(), Beam.POISSON, gravity, 2), "rod-fixed": (Rod(), 0.0, pull, 0)}


def dynamic_input(case, element, cells, dt, duration):
    body, poisson, load, _ = CASES[case]
    text, nodes, elements = model(body, element, cells, poisson)
    text += [f"*STEP, INC={round(duration / dt) + 10}", f"*DYNAMIC, DIRECT, ALPHA={ALPHA}", f"{dt:.12g}, {duration:.12g}",
             *load(nodes, elements, element), "*NODE PRINT, NSET=END, FREQUENCY=1", "U", "*END STEP"]
    return "\n".join(text) + "\n", len(nodes)


def modes_input(element, cells, count, held=True):
    """Of the beam."""
    text = model(Beam(), element, cells, Beam.POISSON, held)[0]
    return "\n".join([*text, "*STEP", "*FREQUENCY", str(count), "*NODE PRINT, NSET=END", "U", "*END STEP"]) + "\n"


def displacements(text):
    """[(time, mean displacement of the printed nodes (3))] of a .dat file."""
    found = []
    for head, rows in re.findall(r"displacements \(vx,vy,vz\) for set END and time\s+(\S+)\n\n((?:\s+\d+(?:\s+\S+){3}\n)+)", text):
        values = np.array([row.split()[1:] for row in rows.splitlines()], dtype=float)
        found.append((float(head), values.mean(axis=0)))
    return found


def rows_of(text, length):
    """The rows of numbers in a part of a .dat file."""
    lines = [line.split() for line in text.splitlines()]
    return [[float(x) for x in line] for line in lines if len(line) == length and line[0].isdigit()]


def frequencies(text):
    """[Hz] of the modes in a .dat file."""
    return [row[3] for row in rows_of(text.split("P A R T I C I P A T I O N")[0], 5)]


def participations(text):
    """[(frequency [Hz], factors along x, y, z)] of a .dat file."""
    factors = text.split("P A R T I C I P A T I O N")[1].split("E F F E C T I V E")[0]
    return [(hertz, f[1:4]) for hertz, f in zip(frequencies(text), rows_of(factors, 7))]


def extrapolated(runs):
    """Limit of what runs with 2, 4 and 8 cells across have found (Aitken)."""
    first, second = runs[1] - runs[0], runs[2] - runs[1]
    return runs[2] + second**2 / (first - second)


class CalculiX:
    def __init__(self, out, force=False):
        self.folder, self.force = pathlib.Path(out) / "calculix", force
        self.folder.mkdir(parents=True, exist_ok=True)
        if not shutil.which("ccx"):
            visible(ROOT / "scripts/setup.sh", "--calculix")
        self.programs = Programs("", self.folder / "log.txt", place=self.folder)

    def run(self, name, content):
        """{"cpu": seconds, "memory": bytes} and the .dat file of an input file."""
        (self.folder / f"{name}.inp").write_text(content)
        done = self.programs.run("ccx", "-i", name, environment=ENVIRONMENT)
        path = self.folder / f"{name}.dat"
        if not path.exists():
            raise Failed(f"ccx -i {name} has written no {path}: {done.output[-400:]}")
        text = path.read_text()
        for leftover in self.folder.glob(f"{name}.*"):
            leftover.unlink()
        return {"cpu": done.cpu, "memory": done.memory}, text

    def study(self, settings):
        """Runs (case, element, cells across, steps per period) that are not there yet."""
        results = Results(self.folder.parent / "calculix.json")
        for case, element, across, steps in settings:
            key = f"{case}: {element} {across} {steps} steps"
            if key in results.records and not self.force:
                continue
            print(f"calculix: {key}", file=sys.stderr, flush=True)
            body = CASES[case][0]
            period = body.period() if case == "beam" else body.PERIOD
            dt, others = period / steps, OtherLoad()
            measured = self.superposed if element == MODAL else self.integrated
            record = {"case": case, "element": element, "mesh": across, "steps": steps, "simulated": 2 * period,
                      **measured(case, element, across, dt, 2 * period)}
            results.add(key, {**record, "cores_of_others": others.cores()})
        return results

    def integrated(self, case, element, across, dt, duration):
        """Nodes, cost and error of a run step by step."""
        content, nodes = dynamic_input(case, element, (5 * across, across, across), dt, duration)
        cost, text = self.run("run", content)
        body, _, _, axis = CASES[case]
        times, motion = (np.array(x) for x in zip(*displacements(text)))
        if case == "beam":
            scale, exact = body.static(), -body.tip(times)
        else:
            scale, exact = body.STATIC, body.end(times, True)
        return {"nodes": nodes, **cost, "error": measures.rms((motion[:, axis] - exact) / scale)}

    def superposed(self, case, element, across, dt, duration):
        """The same from the modes of the beam; what their sum over time costs is nothing to speak of."""
        cost, modes = self.modes(across)
        times, body = dt * np.arange(1, round(duration / dt) + 1), CASES[case][0]
        tip = sum(a * (1 - np.cos(2 * math.pi * f * times)) for f, a in modes)
        nodes = len(block((1, 1, 1), (5 * across, across, across), "C3D20")[0])
        return {"nodes": nodes, **cost, "error": measures.rms((tip - body.tip(times)) / body.static())}

    def modes(self, across, count=12):
        """Cost and [(frequency [Hz], deflection of the tip at rest [m])] of the modes that gravity excites."""
        cost, text = self.run("modes", modes_input("C3D20", (5 * across, across, across), count))
        shapes = [u for _, u in displacements(text)]
        found = []  # bending modes come in pairs of one frequency, turned by any angle: added up
        for (hertz, factors), u in zip(participations(text), shapes):
            part = factors[2] * u[2] / (2 * math.pi * hertz)**2 * Beam.GRAVITY
            if found and abs(found[-1][0] / hertz - 1) < 1e-5:
                part += found.pop()[1]
            found.append((hertz, part))
        return cost, [mode for mode in found if abs(mode[1]) > 1e-6 * found[0][1]]

    def free_bending(self, across, count=16):
        """Frequencies [Hz] of the first and third bending mode of the beam that nothing holds. Modes of bending
        are those that come in pairs."""
        _, text = self.run("modes", modes_input("C3D20", (5 * across, across, across), count, held=False))
        hertz = [f for f in frequencies(text) if f > 1]
        pairs = [f for f, g in zip(hertz, hertz[1:]) if abs(f / g - 1) < 1e-5]
        return pairs[0], pairs[2]

    def reference(self):
        """The numbers of closed_forms.Beam."""
        return {"MODES": extrapolated([np.array(self.modes(n)[1]) for n in (2, 4, 8)]).tolist(),
                "FREE": extrapolated([np.array(self.free_bending(n)) for n in (2, 4, 8)]).tolist()}


GRIDS = (("C3D20R", (1, 2), (20, 40, 80, 160)), ("C3D20R", (4,), (20, 40, 80)), ("C3D8I", (2, 4), (40, 80)),
         ("C3D10", (1, 2), (20, 40, 80)), ("C3D10", (4,), (40,)))
SETTINGS = [(case, element, n, steps) for case in CASES for element, meshes, counts in GRIDS for n in meshes
            for steps in counts] + [("beam", MODAL, n, 80) for n in (1, 2, 4)]
SMALL = [("beam", "C3D20R", 1, 20), ("beam", MODAL, 1, 20), ("rod-fixed", "C3D8I", 2, 20)]
