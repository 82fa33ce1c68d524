"""bemrecode: archives with another codec, and the comparison of codecs."""
import json
import os
import subprocess
import unittest

import h5py
import numpy as np

from cli_case import CliCase


class Recode(CliCase):
    def recode(self, *arguments, code=0):
        done = subprocess.run([os.environ["BEMRECODE"], *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True, timeout=60)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def test_recoded_archives_are_those_of_bemprecomp(self):
        self.sphere(2)
        self.precompute("--codec", "none", "--window", "1", output="dense.bem")
        for options in (["--codec", "haar", "--compression-ratio", 8], ["--codec", "haar", "--codec-tol", 1e-3],
                        ["--codec", "lowrank", "--codec-tol", 1e-3]):
            self.recode("dense.bem", "-o", "recoded.bem", *options, "--force")
            self.assertEqual(self.run_tool("--verify", "recoded.bem").stdout, "recoded.bem: intact\n")
            self.precompute(*options, "--window", "1", "--force", output="direct.bem")
            if "haar" in options:  # of the same numbers in single precision
                self.assertEqual(self.run_tool("--diff", "direct.bem", "recoded.bem").stdout, "identical\n")
                continue
            lines = self.run_tool("--diff", "direct.bem", "recoded.bem", code=1).stdout.splitlines()
            different = [line for line in lines if line.startswith("matrices/") and "balance" not in line]
            with h5py.File(self.folder / "recoded.bem") as archive:
                self.assertIn("stiffness", archive["matrices"])
            # bemprecomp relates errors of G to all lags, of which the archive lacks lag 0
            known = [line for line in different if not line.startswith("matrices/g/")]
            errors = {line.split(":")[0]: float(line.split("relative error ")[1]) for line in known}
            lags = {name: errors.pop(name) for name in list(errors) if name.startswith("matrices/h/")}
            self.assertLess(max(errors.values()), 1e-2)
            # the tolerance is that of all lags of H together, of which the last ones are small
            with h5py.File(self.folder / "dense.bem") as archive:
                norms = {name: np.linalg.norm(archive[name][:].astype(float)) for name in lags}
            difference = np.linalg.norm([lags[name] * norms[name] for name in lags])
            self.assertLess(difference, 1e-3 * np.linalg.norm(list(norms.values())))
            self.assertFalse([line for line in lines if line.startswith("provenance")], lines)

    def test_archives_of_collocation_have_no_stiffness(self):
        self.precompute("--codec", "none", "--discretisation", "collocation", output="dense.bem")
        self.recode("dense.bem", "-o", "recoded.bem", "--codec-tol", 1e-3)
        self.precompute("--codec-tol", "1e-3", "--discretisation", "collocation", output="direct.bem")
        for name in ("recoded.bem", "direct.bem"):
            with h5py.File(self.folder / name) as archive:
                self.assertNotIn("stiffness", archive["matrices"])
                self.assertNotIn("discretisation", archive["scheme"].attrs)
        lines = self.run_tool("--diff", "direct.bem", "recoded.bem", code=1).stdout.splitlines()
        self.assertFalse([line for line in lines if line.startswith(("provenance", "scheme"))], lines)

    def test_comparison(self):
        self.sphere(2)
        self.precompute("--codec", "none", output="dense.bem")
        found = json.loads(self.recode("dense.bem", "--compare", 1e-2, 1e-3).stdout)
        self.assertEqual([f["name"] for f in found["families"]], ["h", "g", "stiffness", "inverse", "traction_response"])
        for family in found["families"]:
            self.assertEqual(family["dense_bytes"], 4 * family["matrices"] * (3 * found["nodes"])**2)
            coarse, fine = family["sizes"]
            for codec in ("lowrank", "haar"):
                self.assertLess(fine[codec]["error"], 0.7 * coarse[codec]["error"])
                self.assertLess(max(fine[codec]["rough"]), max(coarse[codec]["rough"]))

    def test_refusals(self):
        self.precompute(output="compressed.bem")
        self.precompute("--codec", "none", output="dense.bem")
        for arguments, code, part in [
                (["dense.bem"], 2, "-o"), (["dense.bem", "-o", "compressed.bem"], 2, "--force"),
                (["dense.bem", "-o", "dense.bem", "--force"], 2, "is an input"),
                (["dense.bem", "-o", "b.bem", "--codec", "zip"], 2, "zip"),
                (["dense.bem", "-o", "b.bem", "--compression-ratio", "4"], 2, "--codec haar"),
                (["dense.bem", "-o", "b.bem", "--codec-tol", "1"], 2, "1e-06"),
                (["compressed.bem", "-o", "b.bem"], 4, "--codec none"), (["none.bem", "-o", "b.bem"], 4, "none.bem")]:
            with self.subTest(arguments=arguments):
                self.assert_error(self.recode(*arguments, code=code), part)
                self.assertFalse((self.folder / "b.bem").exists())


if __name__ == "__main__":
    unittest.main()
