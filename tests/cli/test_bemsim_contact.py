"""Contact cases that are easy to get wrong: features that meet exactly, extreme masses, units, friction."""
import json
import math
import unittest

from simulation_case import SimulationCase, program

CORNER_DOWN = {"axis": [1, -1, 0], "angle_deg": math.degrees(math.acos(1 / math.sqrt(3)))}
EDGE_DOWN = {"axis": [1, 0, 0], "angle_deg": 45}
SIDE = 0.2


class OddContacts(SimulationCase):
    def cube(self, name, density=1000, unit=1.0):
        """Makes the archive of a rigid cube."""
        size = SIDE * unit
        (self.folder / "m.json").write_text(json.dumps(
            {"name": "m", "density": density, "shear_modulus": 1e5, "poisson_ratio": 0.3}))
        program("bemshape", "box", "--size", size, size, size, "--divisions", 2, 2, 2, "-o", self.folder / "c.obj")
        program("bemprecomp", self.folder / "c.obj", self.folder / "m.json", "-o", self.folder / f"{name}.bem",
                "--dt", 0.004, "--model", "rigid", "--quiet", "--force")

    def run_bodies(self, *bodies, unit=1.0, friction=0.5, tolerance=1e-6):
        floor = {"name": "floor", "friction": friction, "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}
        named = [{"name": f"b{i}", "friction": friction, **body} for i, body in enumerate(bodies)]
        scene = {"version": 1, "time_step": 0.004 * math.sqrt(unit), "duration": 0.6 * math.sqrt(unit),
                 "gravity": [0, 0, -9.81], "contact": {"tolerance": tolerance * unit}, "obstacles": [floor], "bodies": named}
        stats = self.folder / "stats.json"
        done = self.simulate("--stats", stats, "--force", scene=scene)
        self.assertNotIn("warning", done.stderr)
        constraints = json.loads(stats.read_text())["constraints"]
        self.assertGreater(constraints["steps_with_contact"], 20)
        self.assertLess(constraints["largest_penetration"], 5e-5 * SIDE * unit)

    def test_cubes_that_meet_exactly(self):
        self.cube("cube")
        h = SIDE * math.sqrt(3) / 2
        cases = {
            "edge": [{"position": [0, 0, SIDE / math.sqrt(2)], "rotation": EDGE_DOWN}],
            "corner on corner": [{"position": [0, 0, h], "rotation": CORNER_DOWN},
                                 {"position": [0, 0, 3 * h + 0.001], "rotation": CORNER_DOWN, "velocity": [0, 0, -1]}],
            "face on face": [{"position": [0, 0, SIDE / 2]},
                             {"position": [0, 0, 1.5 * SIDE], "velocity": [0, 0, -1]}],
            "side by side": [{"position": [0, 0, SIDE / 2]},
                             {"position": [SIDE, 0, SIDE / 2], "velocity": [-0.5, 0, 0]}]}
        for name, bodies in cases.items():
            with self.subTest(name):
                self.run_bodies(*({"archive": "cube.bem", **body} for body in bodies))

    def test_friction_of_none_and_of_two(self):
        self.cube("cube")
        for friction in (0, 2):
            with self.subTest(friction):
                self.run_bodies({"archive": "cube.bem", "position": [0, 0, 0.1], "velocity": [2, 0, 0]},
                                {"archive": "cube.bem", "position": [0.05, 0.02, 0.31], "velocity": [-2, 0, -1]},
                                friction=friction)

    def test_a_tolerance_near_rounding(self):
        self.cube("cube")
        self.run_bodies({"archive": "cube.bem", "position": [0, 0, 0.2], "rotation": CORNER_DOWN},
                        {"archive": "cube.bem", "position": [0.5, 0, 0.2], "velocity": [0.5, -2, -3]}, tolerance=1e-12)

    def test_a_thousand_times_the_mass_on_top(self):
        self.cube("light")
        self.cube("heavy", density=1e6)
        self.run_bodies({"archive": "light.bem", "position": [0, 0, 0.1]},
                        {"archive": "heavy.bem", "position": [0.03, 0.02, 0.301]})

    def test_millimetres_and_kilometres(self):
        for unit in (1e-3, 1e3):
            with self.subTest(unit):
                self.cube("cube", unit=unit)
                self.run_bodies({"archive": "cube.bem", "position": [0, 0, 0.1 * unit]},
                                {"archive": "cube.bem", "position": [0.03 * unit, 0.02 * unit, 0.31 * unit],
                                 "velocity": [0, 0, -0.5 * math.sqrt(unit)]}, unit=unit)


if __name__ == "__main__":
    unittest.main()
