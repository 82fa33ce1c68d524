"""Quasi-static models, double nodes and the paper's correction, as a user meets them."""
import json
import shutil
import unittest

import numpy as np

from simulation_case import SimulationCase, models, program

END = {"box": {"min": [-0.201, -1, -1], "max": [-0.199, 1, 1]}}
OTHER_END = {"box": {"min": [0.199, -1, -1], "max": [0.201, 1, 1]}}


class Models(SimulationCase):
    def archive(self, name, *options, dt=None):
        """An archive of a bar that is not squeezed sideways when it is pulled."""
        material = {"name": "cork", "density": 1000, "youngs_modulus": 1e5, "poisson_ratio": 0}
        (self.folder / "cork.json").write_text(json.dumps(material))
        program("bemshape", "box", "--size", "0.4", "0.2", "0.2", "--divisions", "4", "2", "2",
                "-o", self.folder / "bar.obj")
        step = [] if dt is None else ["--dt", dt]
        program("bemprecomp", self.folder / "bar.obj", self.folder / "cork.json", "-o",
                self.folder / name, "--quiet", *step, *options)
        return json.loads(program("bemprecomp", "--info", self.folder / name, "--json").stdout)

    def bar(self, archive, **more):
        return {"name": "bar", "archive": archive, "frame": "static", "fixed": [END], "gravity": False,
                "tractions": [{"select": OTHER_END, "traction": [1000, 0, 0]}], **more}

    def pulled_by(self, body):
        """How far the pulled end is after each step, over what it is stretched by in theory."""
        self.simulate(scene={**self.scene, "bodies": [body]})
        with self.trajectory() as file:
            x = np.array(file["bodies/bar/positions"])[:, :, 0]
        shutil.rmtree(self.out)
        return (x - x[0])[:, x[0] > 0.19].mean(axis=1) / (1000 / 1e5 * 0.4)

    def test_static_archives_have_no_time_step(self):
        info = self.archive("bar.bem", "--model", "static")
        self.assertEqual(info["model"], "static")
        self.assertNotIn("dt", info["scheme"])
        self.assertEqual(info["scheme"]["history_length"], 0)
        self.assertEqual(info["matrices"]["count"], 2)
        program("bemprecomp", "--verify", self.folder / "bar.bem")
        self.assertIn("any time step", program("bemprecomp", "--info", self.folder / "bar.bem").stdout)
        for step in (0.01, 0.07):
            self.scene.update(time_step=step, duration=5 * step, bodies=[self.bar("bar.bem")])
            self.assertIn("static", self.check().stdout)
            pulled = self.pulled_by(self.bar("bar.bem"))
            self.assertLess(np.abs(pulled[1:] - pulled[1]).max(), 1e-4)  # at once, and no vibration
            self.assertLess(abs(pulled[1] - 1), 0.05)

    def test_double_nodes(self):
        """By default galerkin has them and collocation has not."""
        for method, sharp, blunt in (("galerkin", [], ["--corner-angle-deg", "none"]),
                                     ("collocation", ["--corner-angle-deg", "40"], [])):
            with self.subTest(method):
                static = ["--model", "static", "--discretisation", method]
                info = self.archive("sharp.bem", *static, "--force", *sharp)
                self.assertEqual(info["body"]["corner_angle_deg"], 40)
                self.assertIn("--corner-angle-deg 40", info["provenance"]["options"])
                info = self.archive("bar.bem", *static, "--force", *blunt)
                self.assertNotIn("corner_angle_deg", info["body"])
                self.assertIn("--corner-angle-deg none", info["provenance"]["options"])
                with_double, without = (self.pulled_by(self.bar(a)) for a in ("sharp.bem", "bar.bem"))
                self.assertLess(abs(with_double[-1] - 1), 1e-3)
                self.assertGreater(abs(without[-1] - 1), 3e-3)

    def test_moving_static_bodies_touch_others(self):
        self.archive("bar.bem", "--model", "static")
        bar = {"name": "bar", "archive": "bar.bem", "position": [0, 0, 0.105], "friction": 0.4}
        self.scene.update(gravity=[0, 0, -9.81], contact={}, duration=0.5, bodies=[bar],
                          obstacles=[{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}])
        self.simulate()
        with self.trajectory() as file:
            z = np.array(file["bodies/bar/positions"])[:, :, 2]
        self.assertGreater(z.min(), -1e-4)
        self.assertLess(np.abs(z[-1] - z[-5]).max(), 1e-4)

    def test_corrections(self):
        """They share out differently what is left of forces and torques: of collocation a part, of galerkin the codec's."""
        moving = {"frame": "moving", "correction": "least_squares"}
        for method, least, most in (("collocation", 1e-6, 0.2), ("galerkin", 1e-9, 1e-4)):
            self.archive("bdf1.bem", "--scheme", "bdf1", "--discretisation", method, "--force", dt=0.01)
            ways = [self.pulled_by(self.bar("bdf1.bem", **{**moving, "correction": c}))[-1]
                    for c in ("projection", "least_squares")]
            self.assertTrue(least < abs(ways[0] - ways[1]) < most, (method, ways))
        self.archive("radau2.bem", dt=0.01)
        self.archive("static.bem", "--model", "static")
        for archive, part in (("radau2.bem", "radau2"), ("static.bem", "another model")):
            self.scene["bodies"] = [self.bar(archive, **moving)]
            self.assert_error(self.check(expect=4), "scene.json:", "/bodies/0/archive", part)
            self.assert_error(self.simulate(expect=4), "scene.json:", part)
        self.scene["bodies"] = [self.bar("bdf1.bem", correction="least_squares")]
        self.assert_error(self.check(expect=3), "/bodies/0/correction", "projection")
        self.scene["bodies"] = [self.bar("bdf1.bem", correction="least squares")]
        self.assert_error(self.check(expect=3), "/bodies/0/correction", "least_squares")


if __name__ == "__main__":
    unittest.main()
