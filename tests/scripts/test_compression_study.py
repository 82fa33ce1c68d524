"""scripts/compression_study.py: its own transform, and a smoke test of all parts on small meshes."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
from compression import orders  # noqa: E402


class Orders(unittest.TestCase):
    def test_the_transform_is_orthonormal_and_finds_what_is_constant(self):
        for parts, size in [(1, 8), (3, 7)]:
            rows = np.eye(parts * size, dtype=np.float32)
            orders.haar(rows, parts)
            np.testing.assert_allclose(rows @ rows.T, np.eye(len(rows)), atol=1e-6)
            constant = np.ones((parts * size, 1), dtype=np.float32)
            orders.haar(constant, parts)
            self.assertEqual(np.count_nonzero(np.abs(constant) > 1e-5), parts)

    def test_the_nonstandard_form_is_orthonormal(self):
        for parts in (1, 3):
            matrix = np.random.default_rng(1).normal(size=(parts * 5, parts * 5)).astype(np.float32)
            full = orders.padded(matrix, parts)
            self.assertEqual(full.shape, (parts * 8, parts * 8))
            norm = np.linalg.norm(full)
            self.assertAlmostEqual(norm, np.linalg.norm(matrix), 4)
            orders.haar_nonstandard(full, parts)
            self.assertAlmostEqual(np.linalg.norm(full), norm, 4)
            constant = np.ones((parts * 8, parts * 8), dtype=np.float32)
            orders.haar_nonstandard(constant, parts)
            self.assertEqual(np.count_nonzero(np.abs(constant) > 1e-5), parts**2)

    def test_a_hilbert_curve_goes_from_neighbour_to_neighbour(self):
        grid = np.stack(np.meshgrid(*[np.arange(8.0)] * 3), axis=-1).reshape(-1, 3)
        steps = np.diff(grid[orders.hilbert_order(grid)], axis=0)
        self.assertEqual(np.abs(steps).sum(axis=1).max(), 1)

    def test_errors_of_pruning(self):
        errors = orders.pruning_errors(np.array([3, 4, 12, 0]), [1, 2, 4])
        np.testing.assert_allclose(errors, [0, 3 / 13, 5 / 13], rtol=1e-6)


class Study(unittest.TestCase):
    def run_script(self, *arguments):
        return subprocess.run([sys.executable, SCRIPTS / "compression_study.py", *arguments], text=True,
                              capture_output=True)

    def test_small_study(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_script("--small", "--binaries", os.environ["BEM_BIN"], "-o", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            out = pathlib.Path(folder)
            results = {name: json.loads((out / f"{name}.json").read_text())
                       for name in ["orders", "products-cube", "tolerances", "simulation"]}
            self.assertEqual(done.stdout, (out / "summary.md").read_text() + "\n")
            self.assertGreater((out / "compression.png").stat().st_size, 10000)
        errors = results["orders"]["errors"]
        best = errors.pop("Haar, bisection, axes apart")
        for name, others in errors.items():
            self.assertLess(best[1], others[1], name)
        for family in results["products-cube"]["families"]:
            for size in family["sizes"]:
                low, haar = size["lowrank"], size["haar"]
                self.assertLess(abs(haar["bytes"] / low["bytes"] - 1), 0.02)
                self.assertLess(low["error"], 1.5 * size["tolerance"])
                self.assertEqual(len(haar["rough"]), family["matrices"])
                self.assertLess(max(low["rough"]), max(haar["rough"]))
        for run in results["tolerances"]["runs"]:
            self.assertLess(max(run["errors"].values()), 1.5 * run["tolerance"])
            self.assertGreater(run["step"], 0)
        rough, fine = results["simulation"]["runs"]
        self.assertLess(fine["rms"], rough["rms"])

    def test_wrong_usage(self):
        done = self.run_script("everything")
        self.assertEqual(done.returncode, 2)
        self.assertIn("unknown part 'everything'", done.stderr)


if __name__ == "__main__":
    unittest.main()
