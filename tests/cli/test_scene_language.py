"""Scenes as people write them: units, other files, defaults, copies, groups, places and named materials."""
import json
import unittest

import h5py
import numpy as np

from simulation_case import DT, SimulationCase, models, program

FLOOR = {"name": "floor", "plane": {"point": [0, 0, "-20 cm"], "normal": [0, 0, 1]}}


class SceneLanguage(SimulationCase):
    def write(self, name, contents):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_text(json.dumps(contents))

    def refused(self, *parts, **changes):
        self.scene.update(changes)
        self.assert_error(self.check(expect=3), *parts)

    def start(self, name):
        with self.trajectory() as f:
            return f[f"bodies/{name}/positions"][0]

    def test_a_scene_that_uses_all_of_it(self):
        self.write("studio/base.json", {
            "version": 1, "time_step": "10 ms", "gravity": [0, 0, "-981 cm/s^2"], "contact": {"tolerance": "1 um"},
            "obstacles": [FLOOR], "output": {"every": 2, "formats": ["hdf5"]},
            "defaults": {"body": {"include": "ball.json"}, "obstacle": {"friction": "40 %"}}})
        self.write("studio/ball.json", {"archive": str(models / "ball.bem"), "friction": 0.1})
        scene = {"include": "studio/base.json", "duration": "100 ms",
                 "bodies": [
                     {"name": "row", "place": {"on": "floor", "center": ["1 m", 0, 0]},
                      "repeat": {"count": [2, 1, 2], "spacing": ["30 cm", 0, "30 cm"],
                                 "jitter": {"position": "2 cm", "rotation_deg": 40, "seed": 5}}},
                     {"name": "pushed", "position": [0, "2 m", 0], "gravity": False,
                      "groups": {"right": {"plane": {"point": ["5 cm", 0, 0], "normal": [1, 0, 0]}}},
                      "tractions": [{"select": {"group": "right"}, "traction": ["1 kPa", 0, 0]}]}]}
        self.simulate(scene=scene)
        low, high, second = (self.start(f"row-{name}") for name in ("0-0-0", "0-0-1", "1-0-0"))
        gap = low[:, 2].min() + 0.2
        self.assertLess(gap, 0.02 + 1e-5)  # the jitter's part away from the floor
        self.assertGreater(gap, -0.02)
        self.assertAlmostEqual(high[:, 2].min() - low[:, 2].min(), 0.3, delta=0.04)
        self.assertAlmostEqual(second.mean(0)[0] - low.mean(0)[0], 0.3, delta=0.04)
        with self.trajectory() as f:
            np.testing.assert_allclose(f["time"][:], np.arange(0, 11, 2) * DT)
            pushed = f["bodies/pushed/positions"][:]
            self.assertGreater(pushed[-1].mean(0)[0], 0.001)
            self.assertLess(abs(pushed[-1].mean(0)[2]), 1e-6)
            fallen = f["bodies/row-0-0-1/positions"][:]
            self.assertLess(fallen[-1].mean(0)[2], fallen[0].mean(0)[2] - 0.01)

    def test_places(self):
        mesh = [(-2, -2, 0), (2, -2, 0), (2, 2, 1), (-2, 2, 1)]  # a slope without thickness
        lines = [f"v {x} {y} {z}" for x, y, z in mesh] + ["f 1 2 3", "f 1 3 4"]
        (self.folder / "slope.obj").write_text("\n".join(lines) + "\n")
        ball = {"archive": str(models / "ball.bem"), "rotation": {"axis": [1, 2, 3], "angle_deg": 50}}
        self.scene.update(gravity=[0, 0, -9.81], duration=0.1, contact={}, obstacles=[
            FLOOR, {"name": "slope", "mesh": "slope.obj"}], bodies=[
                {"name": "free", "place": {"center": [5, 6, 7]}, **ball},
                {"name": "lying", "place": {"on": "floor", "center": [9, 0, 3], "gap": "1 mm"}, **ball},
                {"name": "down", "place": {"on": "slope", "center": [0, 0, -8]}, **ball},
                {"name": "side", "place": {"on": "slope", "center": [1, 9, 0.2], "direction": [0, -1, 0]}, **ball}])
        self.simulate()
        free, lying, down, side = (self.start(name) for name in ("free", "lying", "down", "side"))
        np.testing.assert_allclose((free.min(0) + free.max(0)) / 2, [5, 6, 7], atol=1e-12)
        self.assertAlmostEqual(lying[:, 2].min(), -0.199, delta=1e-12)
        above = down[:, 2] - (down[:, 1] + 2) / 4
        self.assertAlmostEqual(above.min(), 1e-6, delta=1e-9)
        beside = side[:, 1] - (4 * side[:, 2] - 2)
        self.assertAlmostEqual(beside.min(), 1e-6, delta=1e-9)
        with self.trajectory() as f:  # none of them is pushed out of anything
            for name in ("free", "lying", "down", "side"):
                self.assertLess(np.abs(f[f"bodies/{name}/positions"][1] - self.start(name)).max(), 0.003)
        self.assertEqual(program("bemsim", self.scene_file, "--check").stderr, "")

    def test_errors(self):
        ball = {"name": "ball", "archive": str(models / "ball.bem")}
        for parts, body in [
                (["/bodies/0/position/1: expected a length, found a time, \"3 s\""], {"position": [0, "3 s", 0]}),
                (["/bodies/0/position/1: unknown unit \"mmm\"", "did you mean \"mm\"?"], {"position": [0, "3 mmm", 0]}),
                (["/bodies/0/fixed/0: there is no group \"tip\""], {"fixed": [{"group": "tip"}]}),
                (["/bodies/0/place/on: expected the name of an obstacle of this scene, found \"flor\"",
                  "did you mean \"floor\"?"], {"place": {"on": "flor"}}),
                (["would fall past the obstacle \"wall\""],
                 {"place": {"on": "wall", "center": [9, 0, 0], "direction": [0, 1, 0]}}),
                (["/bodies/0/repeat/count: expected an integer from 1 to 10000, found the number 0"],
                 {"repeat": {"count": 0, "spacing": [1, 0, 0]}}),
                (["found the number 1e+09"], {"repeat": {"count": 1000000000, "spacing": [1, 0, 0]}}),
                (["the name \"floor\" is already used at /bodies/0/name"], {"name": "floor"}),
                (["the file \"no.json\" to include does not exist"], {"include": "no.json"}),
                (["scene.json\" includes itself: scene.json -> scene.json"], {"include": "scene.json"})]:
            with self.subTest(parts=parts):
                (self.folder / "wall.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n")
                self.refused(*parts, bodies=[{**ball, **body}],
                             obstacles=[FLOOR, {"name": "wall", "mesh": "wall.obj"}])

    def test_included_files_are_inputs(self):
        self.write("base.json", {"duration": 0.02})
        del self.scene["duration"]
        self.scene["include"] = "base.json"
        self.simulate("--checkpoint-every", 1)
        done = self.simulate("--force", "--stats", self.folder / "base.json", expect=2)
        self.assertIn("base.json", done.stderr)
        self.assertEqual(json.loads((self.folder / "base.json").read_text()), {"duration": 0.02})
        self.write("base.json", {"duration": 0.02, "gravity": [0, 0, 0]})
        self.assertIn("of another scene", self.simulate("--resume", "--checkpoint-every", 1, expect=3).stderr)

    def test_a_material_by_its_name(self):
        ball = models / "ball.obj"
        program("bemprecomp", ball, "rubber", "-o", self.folder / "r.bem", "--model", "rigid", "--dt", DT, "--quiet")
        with h5py.File(self.folder / "r.bem") as f:
            self.assertIn("rubber", str(dict(f["material"].attrs)) if "material" in f else "rubber")
        info = program("bemprecomp", "--info", self.folder / "r.bem", "--json").stdout
        self.assertEqual(json.loads(info)["material"]["density"], 925)
        done = program("bemprecomp", ball, "ruber", "-o", self.folder / "x.bem", "--dt", DT, expect=3)
        self.assert_error(done, "there is no material \"ruber\"; did you mean \"rubber\"?", "steel")

    def test_loads_on_a_group_of_the_mesh(self):
        text = (models / "ball.obj").read_text().splitlines()
        first = next(i for i, line in enumerate(text) if line.startswith("f "))
        text[first + 1:first + 1] = ["g rest"]
        (self.folder / "named.obj").write_text("\n".join(text[:first] + ["g foot"] + text[first:]) + "\n")
        for group, code in [("foot", 0), ("fot", 3)]:
            self.write("loads.json", [{"group": group}])
            done = program("bemprecomp", self.folder / "named.obj", models / "rubber.json", "-o", self.folder / f"{group}.bem",
                           "--dt", DT, "--loads", self.folder / "loads.json", "--quiet", expect=code)
        self.assert_error(done, "there is no group \"fot\"; did you mean \"foot\"?", "\"rest\"")


if __name__ == "__main__":
    unittest.main()
