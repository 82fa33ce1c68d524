"""The beam and the rod with CalculiX (ccx), a volume finite element program, to compare with: input files, runs
on one thread, and what the .dat files say."""
import math
import pathlib
import re
import shutil
import subprocess
import sys

import numpy as np

from paper.workspace import ROOT, OtherLoad

from . import measures
from .closed_forms import Beam, Rod
from .runner import Failed, Results, spent

ALPHA = -0.05  # of the Hilber-Hughes-Taylor method, the default of ccx
ENVIRONMENT = {"OMP_NUM_THREADS": "1", "CCX_NPROC_EQUATION_SOLVER": "1", "CCX_NPROC_STIFFNESS": "1",
               "NUMBER_OF_CPUS": "1"}
CORNERS = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
EDGES = ((0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7))


def block(size, cells, quadratic):
    """Nodes {number: (x, y, z)}, elements (lists of node numbers in the order of ccx), of a box from the origin."""
    cells, index, nodes = np.array(cells), {}, {}

    def node(twice):
        key = tuple(int(c) for c in twice)
        if key not in index:
            index[key] = len(index) + 1
            nodes[index[key]] = tuple(s * k / (2 * n) for s, k, n in zip(size, key, cells))
        return index[key]

    elements = []
    for cell in np.ndindex(*cells):
        corners = [2 * np.array(cell) + 2 * np.array(c) for c in CORNERS]
        twice = [*corners, *((corners[a] + corners[b]) // 2 for a, b in EDGES)] if quadratic else corners
        elements.append([node(k) for k in twice])
    return nodes, elements


def lines_of(numbers, width=8):
    numbers = [str(n) for n in numbers]
    return [", ".join(numbers[i:i + width]) + ("," if i + width < len(numbers) else "")
            for i in range(0, len(numbers), width)]


def model(body, element, cells, poisson):
    """The part of an input file before its steps; the end x = L is the set END, the held one ROOT."""
    length, width = body.LENGTH, body.WIDTH
    nodes, elements = block((length, width, width), cells, element.startswith("C3D20"))
    text = ["*NODE, NSET=NALL", *(f"{n}, {x:.10g}, {y:.10g}, {z:.10g}" for n, (x, y, z) in nodes.items()),
            f"*ELEMENT, TYPE={element}, ELSET=EALL"]
    for n, corners in enumerate(elements, 1):
        text += lines_of([n, *corners])
    for name, at in (("ROOT", 0), ("END", length)):
        text += [f"*NSET, NSET={name}", *lines_of(n for n, p in nodes.items() if abs(p[0] - at) < 1e-9)]
    last = [n for n, c in enumerate(elements, 1) if max(nodes[k][0] for k in c) > length - 1e-9]
    text += ["*ELSET, ELSET=LAST", *lines_of(last), "*MATERIAL, NAME=M", "*ELASTIC", f"{body.YOUNG:.10g}, {poisson}",
             "*DENSITY", f"{body.DENSITY:g}", "*SOLID SECTION, ELSET=EALL, MATERIAL=M", "*BOUNDARY", "ROOT, 1, 3"]
    return text, len(nodes)


GRAVITY = ["*DLOAD", "EALL, GRAV, 1., 0., 0., -1."]
PULL = ["*DLOAD", f"LAST, P4, {-Rod.LOAD:g}"]  # the face x = L of a cell
MODAL = "modes"  # of C3D20 elements, superposed: exact in time, for what is linear and vibrates
CASES = {"beam": (Beam(), Beam.POISSON, GRAVITY, 2), "rod-fixed": (Rod(), 0.0, PULL, 0)}


def dynamic_input(case, element, cells, dt, duration):
    body, poisson, load, _ = CASES[case]
    text, count = model(body, element, cells, poisson)
    text += [f"*STEP, INC={round(duration / dt) + 10}", f"*DYNAMIC, DIRECT, ALPHA={ALPHA}", f"{dt:.12g}, {duration:.12g}",
             *load, "*NODE PRINT, NSET=END, FREQUENCY=1", "U", "*END STEP"]
    return "\n".join(text) + "\n", count


def modes_input(case, element, cells, count):
    body, poisson, _, _ = CASES[case]
    text, _ = model(body, element, cells, poisson)
    return "\n".join([*text, "*STEP", "*FREQUENCY", str(count), "*NODE PRINT, NSET=END", "U", "*END STEP"]) + "\n"


def displacements(text):
    """[(time, mean displacement of the printed nodes (3))] of a .dat file."""
    found = []
    for head, rows in re.findall(r"displacements \(vx,vy,vz\) for set END and time\s+(\S+)\n\n((?:\s+\d+(?:\s+\S+){3}\n)+)", text):
        values = np.array([row.split()[1:] for row in rows.splitlines()], dtype=float)
        found.append((float(head), values.mean(axis=0)))
    return found


def participations(text):
    """[(frequency [Hz], factors along x, y, z)] of a .dat file."""
    head, rest = text.split("P A R T I C I P A T I O N")
    factors = rest.split("E F F E C T I V E")[0]

    def rows(part, length):
        lines = [line.split() for line in part.splitlines()]
        return [[float(x) for x in line] for line in lines if len(line) == length and line[0].isdigit()]

    return [(o[3], f[1:4]) for o, f in zip(rows(head, 5), rows(factors, 7))]


class CalculiX:
    def __init__(self, out, force=False):
        self.folder, self.force = pathlib.Path(out) / "calculix", force
        self.folder.mkdir(parents=True, exist_ok=True)
        if not shutil.which("ccx"):
            subprocess.run([str(ROOT / "scripts/setup.sh"), "--calculix"], check=True)

    def run(self, name, content):
        """CPU seconds and the .dat file of an input file."""
        (self.folder / f"{name}.inp").write_text(content)
        code, cpu = spent(["ccx", "-i", name], self.folder, ENVIRONMENT)
        path = self.folder / f"{name}.dat"
        if code != 0 or not path.exists():
            raise Failed(f"ccx -i {name}: exit code {code}, see {self.folder}/log.txt")
        text = path.read_text()
        for leftover in self.folder.glob(f"{name}.*"):
            leftover.unlink()
        return cpu, text

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
        """Nodes, CPU seconds and error of a run step by step."""
        content, nodes = dynamic_input(case, element, (5 * across, across, across), dt, duration)
        cpu, text = self.run("run", content)
        body, _, _, axis = CASES[case]
        times, motion = (np.array(x) for x in zip(*displacements(text)))
        if case == "beam":
            scale, exact = body.static(), -body.tip(times)
        else:
            scale, exact = body.STATIC, body.end(times, True)
        return {"nodes": nodes, "cpu": cpu, "error": measures.rms((motion[:, axis] - exact) / scale)}

    def superposed(self, case, element, across, dt, duration):
        """The same from the modes of the beam; what their sum over time costs is nothing to speak of."""
        cpu, modes = self.modes(across)
        times, body = dt * np.arange(1, round(duration / dt) + 1), CASES[case][0]
        tip = sum(a * (1 - np.cos(2 * math.pi * f * times)) for f, a in modes)
        nodes = len(block((1, 1, 1), (5 * across, across, across), True)[0])
        return {"nodes": nodes, "cpu": cpu, "error": measures.rms((tip - body.tip(times)) / body.static())}

    def modes(self, across, count=12):
        """CPU seconds and [(frequency [Hz], deflection of the tip at rest [m])] of the modes that gravity excites."""
        cpu, text = self.run("modes", modes_input("beam", "C3D20", (5 * across, across, across), count))
        shapes = [u for _, u in displacements(text)]
        found = []  # bending modes come in pairs of one frequency, turned by any angle: added up
        for (hertz, factors), u in zip(participations(text), shapes):
            part = factors[2] * u[2] / (2 * math.pi * hertz)**2 * Beam.GRAVITY
            if found and abs(found[-1][0] / hertz - 1) < 1e-5:
                part += found.pop()[1]
            found.append((hertz, part))
        return cpu, [mode for mode in found if abs(mode[1]) > 1e-6 * found[0][1]]

    def reference(self):
        """The modes of the beam, extrapolated (Aitken) from 2, 4 and 8 cells across."""
        runs = np.array([self.modes(n)[1] for n in (2, 4, 8)])
        first, second = runs[1] - runs[0], runs[2] - runs[1]
        return (runs[2] + second**2 / (first - second)).tolist()


GRIDS = (("C3D20R", (1, 2), (20, 40, 80, 160)), ("C3D20R", (4,), (20, 40, 80)), ("C3D8I", (2, 4), (40, 80)))
SETTINGS = [(case, element, n, steps) for case in CASES for element, meshes, counts in GRIDS for n in meshes
            for steps in counts] + [("beam", MODAL, n, 80) for n in (1, 2, 4)]
SMALL = [("beam", "C3D20R", 1, 20), ("beam", MODAL, 1, 20), ("rod-fixed", "C3D8I", 2, 20)]
