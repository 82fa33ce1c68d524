"""Kinetic and elastic energies: who has them, what they are, and who is told that there are none."""
import json
import os
import subprocess
import unittest

import h5py
import numpy as np

from cli_case import BEMSHAPE, CliCase

RADIUS, PRESSURE, DT = 0.1, 100.0, 0.01
NAMES = ["kinetic_energy", "elastic_energy", "potential_energy"]


class Energies(CliCase):
    def simulate(self, steps, **scene):
        scene = {"version": 1, "time_step": DT, "duration": 1, **scene}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        subprocess.run([os.environ["BEMSIM"], "scene.json", "-o", "out", "--force", "--quiet", "--steps", str(steps)],
                       cwd=self.folder, check=True, timeout=60)

    def energies(self, body):
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            series = file[f"bodies/{body}/series"]
            return [series[name][:] for name in NAMES]

    def inertia(self, archive):
        with h5py.File(self.folder / archive) as file:
            return file["body/inertia"][1, 1]

    def test_who_has_them(self):
        self.precompute("--energies")
        self.precompute(output="plain.bem")
        self.run_tool("sphere.obj", "rubber.json", "--model", "rigid", "-o", "rigid.bem")
        self.simulate(2, bodies=[{"name": name, "archive": f"{name}.bem", "position": [i, 0, 0]}
                                 for i, name in enumerate(["a", "plain", "rigid"])])
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            have = {name: "elastic_energy" in body["series"] for name, body in file["bodies"].items()}
            self.assertEqual(have, {"a": True, "plain": False, "rigid": True})
            self.assertEqual(file["bodies/a/series/elastic_energy"].attrs["units"], "J")
        info = json.loads(self.run_tool("--info", "a.bem", "--json").stdout)
        self.assertTrue(info["matrices"]["energies"])
        self.assertIn("energies:", self.run_tool("--info", "a.bem").stdout)
        self.assertNotIn("energies", json.loads(self.run_tool("--info", "plain.bem", "--json").stdout)["matrices"])
        self.assertIn("only in a.bem", self.run_tool("--diff", "a.bem", "plain.bem", code=1).stdout)

    def test_free_fall_keeps_the_sum(self):
        self.precompute("--energies")
        self.run_tool("sphere.obj", "rubber.json", "--model", "rigid", "-o", "rigid.bem")
        self.simulate(50, bodies=[{"name": name, "archive": f"{archive}.bem", "position": [i, 0, 0],
                                   "velocity": [0, 3, 1], "angular_velocity": [0, spin, 0]}
                                  for i, (name, archive, spin) in enumerate([("soft", "a", 0), ("rigid", "rigid", 4)])])
        info = json.loads(self.run_tool("--info", "a.bem", "--json").stdout)
        mass = info["body"]["mass"]
        for body, spin in ("soft", 0), ("rigid", 4):
            kinetic, elastic, potential = self.energies(body)
            inertia = self.inertia("rigid.bem") if spin else 0
            np.testing.assert_allclose(kinetic[0], mass * 5 + inertia * spin**2 / 2, rtol=1e-9)
            np.testing.assert_allclose(kinetic + elastic + potential, kinetic[0] + potential[0], rtol=1e-9)
            np.testing.assert_allclose(elastic, 0, atol=1e-9 * kinetic[0])

    def test_a_pressed_ball(self):
        """A pressure p leaves the energy p^2 V/(2 K) in the ball; a static model does not vibrate."""
        self.sphere(2)
        self.run_tool("sphere.obj", "rubber.json", "-o", "static.bem", "--model", "static", "--energies")
        self.simulate(2, gravity=[0, 0, 0], bodies=[{"name": "ball", "archive": "static.bem",
                                                     "tractions": [{"select": "all", "pressure": PRESSURE}]}])
        info = json.loads(self.run_tool("--info", "static.bem", "--json").stdout)
        mu, nu = 1e5, 0.3
        bulk = 2 * mu * (1 + nu) / (3 * (1 - 2 * nu))
        kinetic, elastic, _ = self.energies("ball")
        self.assertAlmostEqual(elastic[-1] / (PRESSURE**2 * info["body"]["volume"] / (2 * bulk)), 1, delta=3e-5)
        np.testing.assert_allclose(kinetic, 0, atol=1e-20)

    def test_a_held_beam_keeps_its_energy(self):
        """Bent slowly and let go: the energy goes to and fro, and its sum stays what it was."""
        subprocess.run([BEMSHAPE, "box", "--size", "1", "0.1", "0.1", "--divisions", "20", "2", "2", "-o",
                        self.folder / "beam.obj"], check=True)
        self.run_tool("beam.obj", "rubber.json", "-o", "beam.bem", "--energies", "--dt", "0.02")
        ends = [{"box": {"min": [-1, -1, -1], "max": [-0.49, 1, 1]}}, {"box": {"min": [0.49, -1, -1], "max": [1, 1, 1]}}]
        pull = {"select": ends[1], "traction": [0, 30, 0], "profile": [[0, 0], [4, 1], [4.02, 0]]}
        self.simulate(600, gravity=[0, 0, 0], time_step=0.02, duration=20,
                      bodies=[{"name": "beam", "archive": "beam.bem", "fixed": ends[:1], "tractions": [pull]}])
        kinetic, elastic, _ = self.energies("beam")
        before, after = slice(0, 200), slice(205, None)
        self.assertLess(kinetic[before].max(), 0.2 * elastic[before].max())
        total = (kinetic + elastic)[after]
        self.assertAlmostEqual(total.mean() / elastic[200], 1, delta=0.01)
        self.assertLess(total.std(), 0.015 * total.mean())
        for energy in kinetic[after], elastic[after]:
            self.assertGreater(energy.max(), 0.97 * total.mean())
            self.assertLess(energy.min(), 0.03 * total.mean())

    def test_recoded_archives_keep_them(self):
        self.precompute("--energies", "--codec", "none", output="dense.bem")
        subprocess.run([os.environ["BEMRECODE"], "dense.bem", "-o", "small.bem"], cwd=self.folder, check=True)
        lines = self.run_tool("--diff", "dense.bem", "small.bem", code=1).stdout.splitlines()
        errors = [float(line.split("relative error ")[1]) for line in lines if line.startswith("matrices/energy")]
        self.assertLess(max(errors, default=0), 1e-5)
        self.assertTrue(json.loads(self.run_tool("--info", "small.bem", "--json").stdout)["matrices"]["energies"])

    def test_who_has_none(self):
        for options, parts in [(["--discretisation", "collocation"], ["--energies", "galerkin"]),
                               (["--inverse", "iterative"], ["--energies", "--inverse dense"])]:
            self.assert_error(self.precompute("--energies", *options, code=2), *parts)
        self.material(poisson_ratio=0.5)
        self.assert_error(self.precompute("--energies", code=3), "rubber.json", "Poisson ratio of 0.5", "0.499")


if __name__ == "__main__":
    unittest.main()
