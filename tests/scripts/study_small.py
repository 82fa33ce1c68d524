"""A smoke test of scripts/study.py: all problems, small."""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "scripts"))
from study.problems import PROBLEMS  # noqa: E402


class SmallStudy(unittest.TestCase):
    def run_script(self, *arguments, programs=os.environ.get("BEM_BIN", "")):
        return subprocess.run([sys.executable, ROOT / "scripts/study.py", *arguments], text=True, capture_output=True,
                              env={**os.environ, "BEM_BIN": programs})

    def test_small_study_and_going_on(self):
        with tempfile.TemporaryDirectory() as folder:
            done = self.run_script("--small", "--out", folder)
            self.assertEqual(done.returncode, 0, done.stderr)
            out = pathlib.Path(folder)
            found = {name: json.loads((out / f"{name}.json").read_text()) for name in PROBLEMS}
            self.assertEqual(done.stdout, (out / "summary.md").read_text() + "\n")
            self.assertTrue((out / "rod-fixed.svg").exists())
            before = (out / "rod.json").read_bytes()
            again = self.run_script("rod", "--small", "--out", folder, programs="/nowhere")  # nothing is left to run
            self.assertEqual(again.returncode, 0, again.stderr)
            self.assertEqual((out / "rod.json").read_bytes(), before)
        for name, problem in PROBLEMS.items():
            self.assertEqual(len(found[name]), len(problem.small) * len(problem.scenes), name)
        errors = {key: r["error"] for records in found.values() for key, r in records.items()}
        self.assertLess(errors["rod-fixed: mesh 2 20 steps radau2"], 0.1)
        self.assertGreater(errors["rod-fixed: mesh 1 20 steps bdf1"], 0.3)
        self.assertLess(errors["sphere: mesh 2 6 steps radau2"], errors["sphere: mesh 2 6 steps bdf2"])
        self.assertLess(errors["slide: mesh 1 32 steps radau2"], 1e-3)
        self.assertAlmostEqual(math.log2(errors["tumble: mesh 1 150 steps radau2"] / errors["tumble: mesh 1 300 steps radau2"]),
                               3, 0)
        self.assertLess(found["mode"]["mode: mesh 2 10 steps bdf1"]["energy"], 0.1)
        self.assertLess(abs(found["mode"]["mode: mesh 2 10 steps radau2"]["frequency"]), 0.03)
        for records in found.values():
            for r in records.values():
                self.assertGreater(r["precompute_cpu"], 0)
                self.assertGreater(r["simulate_cpu"], 0)


if __name__ == "__main__":
    unittest.main()
