"""tests/regression/run.py: what counts as a difference."""
import pathlib
import sys
import tempfile
import unittest

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests/regression"))
import run  # noqa: E402
from paper.catalogue import SCENES  # noqa: E402

FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
TETRAHEDRON = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)


class Motion:
    def __init__(self, shift=0.0, growth=1.0):
        self.times = np.arange(3)
        moved = TETRAHEDRON * growth + [shift, 0, 0]
        self.positions, self.faces = {"body": np.stack([TETRAHEDRON, TETRAHEDRON, moved])}, {"body": FACES}


class Regression(unittest.TestCase):
    def off(self, motion, reference):
        found, size = run.summary(motion)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "reference.txt"
            run.write(path, run.summary(reference)[0])
            return run.deviation(found, run.read(path), size)

    def test_the_same_run_is_the_same(self):
        self.assertLess(self.off(Motion(0.5), Motion(0.5))[0], 1e-8)

    def test_a_shift_is_a_share_of_the_size_and_growth_one_of_the_volume(self):
        self.assertAlmostEqual(self.off(Motion(0.03), Motion())[0], 0.03 / np.sqrt(3), 8)
        worst, line = self.off(Motion(growth=1.1), Motion())
        self.assertAlmostEqual(worst, 1.1**3 - 1, 8)
        self.assertEqual(line, "frame 2 body volume")
        self.assertEqual(self.off(Motion(np.nan), Motion())[0], np.inf)

    def test_missing_and_other_lines_are_differences(self):
        found, size = run.summary(Motion())
        self.assertEqual(run.deviation(found, {**found, "frame 9 body volume": np.ones(1)}, size)[0], np.inf)
        self.assertEqual(run.deviation({}, found, size)[0], np.inf)

    def test_the_centre_is_that_of_the_volume(self):
        np.testing.assert_allclose(run.centre(TETRAHEDRON + 5, FACES), [5.25] * 3, atol=1e-12)

    def test_every_run_of_the_list_has_a_reference(self):
        runs = run.runs()
        for one in runs:
            self.assertIn(one.scene, SCENES)
            self.assertGreater(one.steps, 0)
            self.assertLess(one.tolerance, 0.2)
            self.assertTrue((ROOT / f"tests/regression/{one.name}.txt").exists(), one.name)
        self.assertEqual({one.discretisation for one in runs}, {"collocation", "galerkin"})


if __name__ == "__main__":
    unittest.main()
