"""scripts/hard: its meshes, its figures, and that its bounds can be missed."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from common import meshes, obj  # noqa: E402
from hard import figures, report  # noqa: E402
from hard.catalogue import CASES, Case, Trial, renumbered_mesh, turned_mesh  # noqa: E402
from hard.laboratory import SOURCES, Outcome, misses  # noqa: E402

TURN = figures.rotation({"axis": [1, 2, 3], "angle_deg": 50})


def edges_are_paired(triangles):
    edges = [(t[k], t[(k + 1) % 3]) for t in np.asarray(triangles).tolist() for k in range(3)]
    return len(set(edges)) == len(edges) and {(b, a) for a, b in edges} == set(edges)


class Meshes(unittest.TestCase):
    def check(self, mesh, volume):
        self.assertTrue(edges_are_paired(mesh[1]))
        self.assertAlmostEqual(meshes.volume(mesh), volume, 12)

    def test_all_are_closed_and_have_their_volumes(self):
        self.check(meshes.box((1, 2, 3), (2, 1, 3)), 6)
        self.check(meshes.slotted(0.01), 0.3 * (1 - 0.01 * 2 / 3))
        self.check(meshes.angle(), 5 / 27)
        self.check(meshes.cross(), 7 / 27)
        self.check(meshes.tetrahedron(), 1 / (6 * np.sqrt(2)))
        for mesh in (meshes.needles(), meshes.slivers(), meshes.abrupt(), meshes.graded()):
            self.check(mesh, 1)
        self.assertTrue(edges_are_paired(meshes.top()[1]))

    def test_they_are_as_bad_as_they_are_meant_to_be(self):
        aspect, angle, _ = meshes.aspects(meshes.needles())
        self.assertGreater(aspect.max(), 1000)
        self.assertLess(angle.min(), 0.1)
        self.assertGreater(meshes.aspects(meshes.slivers())[0].max(), 5000)
        for mesh in (meshes.abrupt(), meshes.graded()):
            longest = meshes.aspects(mesh)[2]
            self.assertGreaterEqual(longest.max() / longest.min(), 99.9)

    def test_turned_and_renumbered_meshes_are_the_same_body(self):
        mesh = meshes.box((1, 2, 3), (2, 1, 3))
        order = np.random.default_rng(5).permutation(len(mesh[0]))
        other = renumbered_mesh(order)(turned_mesh(TURN)(mesh))
        self.check(other, 6)
        np.testing.assert_allclose(other[0], mesh[0][order] @ TURN.T)

    def test_files_keep_all_digits(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "a.obj"
            mesh = turned_mesh(TURN)(meshes.tetrahedron())
            obj.write(path, *mesh)
            read = obj.read(path)
            np.testing.assert_array_equal(read[0], mesh[0])
            np.testing.assert_array_equal(read[1], mesh[1])


class Figures(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.place = pathlib.Path(folder.name)

    def run_of(self, name, positions, turn=None):
        """A trajectory whose frame stays where it is."""
        place = self.place / name
        (place / "run").mkdir(parents=True)
        count = len(positions)
        with h5py.File(place / "run/trajectory.h5", "w") as file:
            file["time"] = 0.1 * np.arange(count)
            file["bodies/body/positions"] = positions
            file["bodies/body/frame/rotation"] = np.broadcast_to(np.eye(3) if turn is None else turn, (count, 3, 3))
            file["bodies/body/frame/translation"] = np.zeros((count, 3))
        return place

    @staticmethod
    def shaking(growth):
        rest = meshes.tetrahedron()[0]
        return np.stack([rest] + [rest * (1 + 1e-3 * growth**k * (-1)**k) for k in range(40)])

    def test_growth_is_seen(self):
        for growth, low, high in ((0.9, 0.0, 0.5), (1.1, 10, 100)):
            place = self.run_of(f"g{growth}", self.shaking(growth))
            found = figures.deformations(figures.Frames(place / "run/trajectory.h5"))
            self.assertTrue(low < found["later/early"] < high, found)

    def test_images(self):
        x = self.shaking(0.9)
        order = np.array([2, 0, 3, 1])
        first = self.run_of("first", x)
        second = self.run_of("second", 10 * x[:, order] @ TURN.T)
        found = figures.Image(10, TURN, order).difference(second, first)
        self.assertLess(max(found.values()), 1e-12)
        found = figures.Image(10, TURN).difference(second, first)
        self.assertGreater(found["positions differ"], 0.1)
        self.assertGreater(found["deformations differ"], 0.1)

    def test_numbers_that_are_not_finite_are_found_everywhere(self):
        self.assertEqual(figures.not_finite(self.place), [])
        with h5py.File(self.place / "a.bem", "w") as file:
            file["x/y"] = [1.0, np.inf]
        (self.place / "b.json").write_text(json.dumps({"a": [1, {"b": None}]}))
        (self.place / "c.csv").write_text("time,body,x\n0.1,body,nan\n")
        self.assertEqual(len(figures.not_finite(self.place)), 3)

    def test_misses(self):
        bounds = {"a": ("<=", 1), "b": (">=", 2)}
        self.assertEqual(misses({"a": 1.0, "b": 2.0}, bounds), [])
        self.assertEqual(len(misses({"a": 1.1, "b": float("nan")}, bounds)), 2)
        self.assertEqual(len(misses({}, bounds)), 2)


class Catalogue(unittest.TestCase):
    def test_files_and_words_are_there(self):
        for name, case in CASES.items():
            self.assertTrue(case.expected, name)
            self.assertTrue(any(t.short for t in case.trials), name)
            names = [t.name for t in case.trials]
            self.assertEqual(len(set(names)), len(names), name)
            for trial in case.trials:
                self.assertTrue((SOURCES / f"{trial.scene}.json").exists(), trial.scene)
                self.assertTrue(trial.bounds or trial.ends == "refused" or trial.image_of, f"{name}/{trial.name}")
                for body in trial.bodies.values():
                    self.assertTrue((SOURCES / f"material-{body.material}.json").exists(), body.material)

    def test_trials_are_compared_with_earlier_ones_of_the_same_variant(self):
        for case in CASES.values():
            seen = {}
            for trial in case.trials:
                if trial.image_of:
                    self.assertIn(trial.image_of[0], seen)
                    self.assertTrue(seen[trial.image_of[0]] or not trial.short, trial.name)
                seen[trial.name] = trial.short

    def test_the_table(self):
        trial = Trial("t", {}, bounds={"a": ("<=", 1)})
        case = Case("words", (trial,), "group")
        good, bad = ({"c": {"t": Outcome({"a": a}, faults, [], 1.0)}} for a, faults in ((0.5, []), (2.0, ["a is 2"])))
        self.assertIn("| c (1 run) | words | a 0.5 | ≤ 1 | pass | 1 |", report.markdown({"c": case}, good, False))
        self.assertIn("FAIL: t", report.markdown({"c": case}, bad, False))
        self.assertFalse(report.results({"c": case}, bad, False)["c"]["passed"])


class CommandLine(unittest.TestCase):
    def test_unknown_cases(self):
        done = subprocess.run([ROOT / "scripts/hard_cases.py", "no-such-case"], capture_output=True, text=True,
                              env=os.environ, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("unknown case 'no-such-case'", done.stderr)


if __name__ == "__main__":
    unittest.main()
