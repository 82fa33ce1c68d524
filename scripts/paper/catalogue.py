"""What reproduce.py runs: the bodies and scenes of the figures and of Table 1 of the paper (Sugimoto, Batty,
Hachisuka 2022), each in full size and small, and what the paper's Table 1 says of them.

The paper gives no sizes. Bodies are as large as its n_max = floor(extent / (c2 dt) + 2) demands; the beams
are 0.5 m x 0.1 m x 0.1 m, which meets all three of its values (5, 8 and 12)."""
import dataclasses


@dataclasses.dataclass(frozen=True)
class Body:
    """A mesh and how its archive is made. `shape` are the arguments of bemshape, or ("bunny",); `vertices`
    is what the mesh is refined to (scripts/refine_mesh.py), None for the mesh as it is."""
    shape: tuple
    vertices: int | None
    small_shape: tuple
    small_vertices: int | None
    material: str  # of scenes/paper/material-NAME.json
    dt: float
    options: tuple = ()  # of bemprecomp
    scale: float = 1.0
    recode: tuple = ()  # (body, options of bemrecode ...): made from that body's archive
    history: int = 0  # n_max in the paper


def _box(length, width, cells, small_cells):
    """A box along x with square cells in four triangles each, as N in the paper's Table 1 shows:
    770 = 6 * 8 * 8 * 2 + 2 and 2818 = 22 * 8 * 8 * 2 + 2."""
    def shape(c):
        return ("box", "--size", length, width, width, "--divisions", c * round(length / width), c, c)

    def count(c):
        return 4 * c * c * (2 * round(length / width) + 1) + 2
    return shape(cells), count(cells), shape(small_cells), count(small_cells)


BEAM, CUBE = _box(0.5, 0.1, 8, 4), _box(0.1, 0.1, 8, 4)
TORUS = (("torus", "--major", 0.109, "--minor", 0.0435, "--around", 48, "--across", 24), None,
         ("torus", "--major", 0.109, "--minor", 0.0435, "--around", 24, "--across", 12), None)
BUMPY_CUBE = (("bumpy-cube", "--size", 0.5, "--divisions", 22), 3000, ("bumpy-cube", "--size", 0.5, "--divisions", 8), None)
CORNERS = ("--corner-angle-deg", 40)  # double nodes, as in the paper's Fig. 5 and Fig. 9


def _recoded(*options):
    return Body(*BUMPY_CUBE, "bumpy-cube", 0.01, recode=("bumpy-cube", *options), history=5)


BODIES = {
    "fish": Body(("fish", "--length", 0.15, "--segments", 60), 2843, ("fish", "--length", 0.15, "--segments", 16), None,
                 "fish", 0.001, history=3),
    "torus": Body(*TORUS, "torus", 0.001, history=32),
    "torus-static": Body(*TORUS, "torus", 0.001, ("--model", "static"), history=32),
    "beam": Body(*BEAM, "beam", 0.005, CORNERS, history=8),
    "bumpy-cube": Body(*BUMPY_CUBE, "bumpy-cube", 0.01, ("--codec", "none"), history=5),
    "bumpy-cube-haar-8": _recoded("--codec", "haar", "--compression-ratio", 8),
    "bumpy-cube-haar-32": _recoded("--codec", "haar", "--compression-ratio", 32),
    "bumpy-cube-haar-128": _recoded("--codec", "haar", "--compression-ratio", 128),
    "bumpy-cube-lowrank": _recoded("--codec", "lowrank", "--codec-tol", 1e-4),
    "bunny": Body(("bunny",), 3485, ("star", "--subdivisions", 2, "--radius", 0.06), None, "bunny", 0.003,
                  scale=0.0145, history=5),
    "twist-cube": Body(*CUBE, "twist", 0.005, CORNERS, history=5),
    "twist-beam": Body(*BEAM, "twist", 0.005, CORNERS, history=12),
}

OBSTACLES = {
    "bowl": (("bowl", "--radius", 0.25, "--thickness", 0.025, "--segments", 48),
             ("bowl", "--radius", 0.25, "--thickness", 0.025, "--segments", 24)),
}


@dataclasses.dataclass(frozen=True)
class Scene:
    """A run: the scene file it is made from, with `changes` {JSON path: value}."""
    figure: str
    file: str  # in scenes/paper
    body: str  # whose archive it uses
    row: str  # its name in Table 1
    changes: dict = dataclasses.field(default_factory=dict)
    small_steps: int = 50
    small_changes: dict = dataclasses.field(default_factory=dict)
    obstacles: tuple = ()
    touches: bool = False  # measured by bemmeasure, too


def _cube(body, row):
    return Scene("fig6", "fig6-bumpy-cube", body, row, {"/bodies/0/archive": f"{body}.bem"}, small_steps=30)


def _bunny(friction):
    return Scene("fig8", "fig8-bunny", "bunny", f"bunny (friction={friction})", {"/bodies/0/friction": friction},
                 small_steps=100,
                 small_changes={"/bodies/0/position": [0, 0.09, 0]}, touches=True)


SCENES = {
    "fig1-fish": Scene("fig1", "fig1-fish", "fish", "fish", small_steps=150, small_changes={"/bodies": 5},
                       obstacles=("bowl",), touches=True),
    "fig4-torus": Scene("fig4", "fig4-torus", "torus", "torus", small_steps=250),
    "fig4-torus-static": Scene("fig4", "fig4-torus", "torus-static", "torus, elastostatic",
                               {"/bodies/0/archive": "torus-static.bem"}, small_steps=250),
    "fig5-beam-moving": Scene("fig5", "fig5-beam", "beam", "beam (with frame update)", small_steps=60),
    "fig5-beam-static": Scene("fig5", "fig5-beam", "beam", "beam (w/o frame update)",
                              {"/bodies/0/frame": "static"}, small_steps=60),
    "fig6-none": _cube("bumpy-cube", "bumpy cube (uncompressed)"),
    "fig6-haar-8": _cube("bumpy-cube-haar-8", "bumpy cube (8x compressed)"),
    "fig6-haar-32": _cube("bumpy-cube-haar-32", "bumpy cube (32x compressed)"),
    "fig6-haar-128": _cube("bumpy-cube-haar-128", "bumpy cube (128x compressed)"),
    "fig6-lowrank": _cube("bumpy-cube-lowrank", "bumpy cube (lowrank, 1e-4)"),
    "fig8-bunny-0.2": _bunny(0.2),
    "fig8-bunny-0.4": _bunny(0.4),
    "fig8-bunny-0.6": _bunny(0.6),
    "fig9-cubes": Scene("fig9", "fig9-cubes", "twist-cube", "beam (with decomposition)", small_steps=480),
    "fig9-beam": Scene("fig9", "fig9-beam", "twist-beam", "beam (w/o decomposition)", small_steps=480),
}
FIGURES = list(dict.fromkeys(scene.figure for scene in SCENES.values()))


@dataclasses.dataclass(frozen=True)
class PaperRow:
    """A row of the paper's Table 1: sizes in GB, seconds per step."""
    vertices: str
    history: int
    ratio: str
    size: float
    unconstrained: float
    collision: float | None
    constraints: float
    correction: float

    def total(self):
        return self.unconstrained + (self.collision or 0) + self.constraints + self.correction


PAPER = {
    "fish": PaperRow("2843 x 25", 3, "5", 1.4, 4.78e-1, 2.42e-1, 1.82e2, 1.90e-1),
    "torus": PaperRow("1152", 32, "-", 6.3, 2.37e-1, None, 2.03e-2, 3.98e-3),
    "beam (with frame update)": PaperRow("2818", 8, "2", 9.0, 5.28e-1, None, 3.05e0, 9.38e-2),
    "beam (w/o frame update)": PaperRow("2818", 8, "2", 9.0, 5.30e-1, None, 2.51e0, 3.16e-2),
    "bumpy cube (uncompressed)": PaperRow("3000", 5, "-", 7.8, 2.68e-1, None, 1.90e0, 7.41e-2),
    "bumpy cube (8x compressed)": PaperRow("3000", 5, "8", 1.5, 8.55e-2, None, 2.72e0, 2.40e-2),
    "bumpy cube (32x compressed)": PaperRow("3000", 5, "32", 0.4, 2.20e-2, None, 1.71e0, 6.55e-3),
    "bumpy cube (128x compressed)": PaperRow("3000", 5, "128", 0.1, 6.75e-3, None, 1.15e0, 2.49e-3),
    "bunny (friction=0.2)": PaperRow("3485", 5, "10", 1.6, 9.12e-2, 5.23e-2, 1.25e0, 2.52e-2),
    "bunny (friction=0.4)": PaperRow("3485", 5, "10", 1.6, 9.06e-2, 5.55e-2, 6.96e0, 2.50e-2),
    "bunny (friction=0.6)": PaperRow("3485", 5, "10", 1.6, 9.04e-2, 7.50e-2, 1.81e0, 2.50e-2),
    "beam (with decomposition)": PaperRow("770 x 5", 5, "-", 0.6, 1.14e-1, None, 6.64e0, 3.12e-2),
    "beam (w/o decomposition)": PaperRow("2818", 12, "2", 13.0, 7.82e-1, None, 3.05e0, 9.45e-2),
}
