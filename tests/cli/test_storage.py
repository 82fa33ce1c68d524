"""What of the matrices an archive holds (--inverse, --loads), and scenes with such archives."""
import json
import os
import subprocess
import unittest

import h5py
import numpy as np

from cli_case import BEMSHAPE, CliCase

BEMSIM = os.environ["BEMSIM"]


class Storage(CliCase):
    def simulate(self, archive, body=None, scene=None, code=0):
        """Drops a body with an archive on a floor; returns the positions of all frames."""
        (self.folder / "scene.json").write_text(json.dumps({
            "version": 1, "time_step": 0.01, "duration": 0.6, "gravity": [0, -9.81, 0],
            "bodies": [{"name": "ball", "archive": archive, "position": [0, 0.2, 0],
                        "angular_velocity": [0, 0, 5], **(body or {})}],
            "obstacles": [{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]},
                           "friction": 0.3}],
            "contact": {}, **(scene or {})}))
        done = subprocess.run([BEMSIM, "scene.json", "-o", "out", "--force", "--format", "hdf5", "-q"],
                              cwd=self.folder, text=True, capture_output=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stderr)
        if code:
            return done.stderr
        with h5py.File(self.folder / "out" / "trajectory.h5") as file:
            return np.array(file["bodies/ball/positions"])

    def matrices(self, archive):
        return json.loads(self.run_tool("--info", archive, "--json").stdout)["matrices"]

    def names(self, archive):
        with h5py.File(self.folder / archive) as file:
            return set(file["matrices"])

    def test_iterative_archives_move_as_dense_ones(self):
        for codec in ("none", "lowrank"):
            self.precompute("--codec", codec, "--force", output="dense.bem")
            self.precompute("--codec", codec, "--inverse", "iterative", "--force",
                            output="iterative.bem")
            self.assertEqual(self.matrices("dense.bem")["inverse"], "dense")
            self.assertEqual(self.matrices("iterative.bem")["inverse"], "iterative")
            self.assertEqual(self.names("iterative.bem") ^ self.names("dense.bem"),
                             {"inverse", "traction_response", "initial_h", "initial_g"})
            self.run_tool("--verify", "iterative.bem")
            dense, iterative = self.simulate("dense.bem"), self.simulate("iterative.bem")
            motion = np.abs(dense - dense[0]).max()
            self.assertGreater(motion, 0.1)
            self.assertLess(np.abs(dense - iterative).max() / motion,
                            1e-4 if codec == "none" else 1e-3)

    def test_loads_on_some_nodes(self):
        selections = [{"box": {"min": [-1, -1, -1], "max": [1, 0.02, 1]}}, {"vertices": [0]}]
        (self.folder / "bottom.json").write_text(json.dumps(selections))
        self.precompute()
        self.precompute("--loads", "bottom.json", output="bottom.bem")
        self.precompute("--loads", "none", output="none.bem")
        self.assertEqual(self.matrices("bottom.bem")["loads"], "some")
        self.assertTrue(0 < self.matrices("bottom.bem")["loaded_nodes"] < 42)
        self.assertEqual(self.names("a.bem") - self.names("none.bem"), {"g", "traction_response"})
        sizes = [(self.folder / f"{name}.bem").stat().st_size for name in ("a", "bottom", "none")]
        self.assertEqual(sizes, sorted(sizes, reverse=True))
        for name in ("bottom.bem", "none.bem"):
            self.run_tool("--verify", name)
            self.assertIn("loads", self.run_tool("--diff", "a.bem", name, code=1).stdout)

        upright = {"angular_velocity": [0, 0, 0]}
        self.assertLess(np.abs(self.simulate("a.bem", upright) -
                               self.simulate("bottom.bem", upright)).max(), 1e-4)
        # turned over, it is touched where nothing is stored
        over = {"angular_velocity": [0, 0, 0], "rotation": {"axis": [1, 0, 0], "angle_deg": 180}}
        for name in ("bottom.bem", "none.bem"):
            error = self.simulate(name, over, code=4)
            self.assertIn('error: the body "ball" is touched at vertex', error)
            self.assertIn("--loads all", error)

        free = {"contact": {"enabled": False}, "gravity": [0, 0, 0]}
        np.testing.assert_array_equal(self.simulate("a.bem", scene=free),
                                      self.simulate("none.bem", scene=free))
        held = {"fixed": [{"vertices": [3]}]}
        self.assertIn("made without loads on a vertex",
                      self.simulate("none.bem", held, scene=free, code=4))

    def test_thin_held_sheet_under_coarse_compression(self):
        """Its bending compliance is 50,000 times that of pairs of nodes across the thickness. (Collocation, because
        galerkin takes minutes for bodies so thin.)"""
        subprocess.run([BEMSHAPE, "box", "--size", "0.005", "0.6", "0.6", "--divisions", "1", "8", "8",
                        "-o", str(self.folder / "sheet.obj")], check=True)
        self.material("plastic.json", shear_modulus=3e8)
        edges = [{"box": {"min": [-1, side - 0.001, -1], "max": [1, side + 0.001, 1]}} for side in (-0.3, 0.3)]
        push = {"select": {"box": {"min": [0.002, -0.16, -0.16], "max": [1, 0.16, 0.16]}},
                "traction": [100, 0, 0], "profile": [[0, 0], [0.01, 1], [0.02, 0]]}
        ends = []
        for storage in (["--codec", "none"], ["--codec-tol", "1e-4"], ["--codec-tol", "1e-3"]):
            self.run_tool("sheet.obj", "plastic.json", "-o", "sheet.bem", "--force", "--scheme", "bdf1",
                          "--dt", "0.002", "--discretisation", "collocation", *storage)
            frames = self.simulate("sheet.bem", {"position": [0, 0, 0], "angular_velocity": [0, 0, 0],
                                                 "fixed": edges, "tractions": [push]},
                                   {"gravity": [0, 0, 0], "contact": {"enabled": False}, "time_step": 0.002, "duration": 0.3})
            motion = np.abs(frames - frames[0]).max(axis=(1, 2))
            self.assertLess(motion[-1], 1e-3 * motion.max())
            ends.append(motion.max())
        self.assertLess(abs(ends[1] / ends[0] - 1), 1e-3)
        self.assertLess(abs(ends[2] / ends[0] - 1), 0.02)

    def test_bad_loads(self):
        (self.folder / "bad.json").write_text('[{"vertices": [99]}]')
        self.assert_error(self.precompute("--loads", "bad.json", code=3), "bad.json:1", "99")
        self.assert_error(self.precompute("--loads", "missing.json", code=3), "missing.json")
        self.assert_error(self.precompute("--loads", "bad.json", "--codec", "none", code=2), "--loads")
        self.assert_error(self.precompute("--inverse", "some", code=2), "--inverse")
        self.assertEqual([name for name in self.files() if name.endswith(".bem")], [])


if __name__ == "__main__":
    unittest.main()
