"""What the tests of the command-line tools share."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

DATA = pathlib.Path(os.environ["BEM_DATA"])
BEMPRECOMP = os.environ["BEMPRECOMP"]
BEMSHAPE = os.environ["BEMSHAPE"]
RUBBER = {"name": "rubber", "density": 1000, "poisson_ratio": 0.3, "shear_modulus": 1e5}


class CliCase(unittest.TestCase):
    """Runs every test in a folder of its own that holds sphere.obj and rubber.json."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="bem_cli_"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.sphere(1)
        self.material()

    def sphere(self, subdivisions, name="sphere.obj"):
        subprocess.run([BEMSHAPE, "icosphere", "--subdivisions", str(subdivisions), "--radius",
                        "0.1", "-o", str(self.folder / name)], check=True)

    def material(self, name="rubber.json", **changes):
        (self.folder / name).write_text(json.dumps({**RUBBER, **changes}))

    def run_tool(self, *arguments, code=0, **options):
        """Runs bemprecomp in the folder and checks its exit code."""
        done = subprocess.run([BEMPRECOMP, *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True, timeout=60, **options)
        self.assertEqual(done.returncode, code, f"{arguments}\n{done.stdout}\n{done.stderr}")
        return done

    def precompute(self, *arguments, output="a.bem", code=0, **options):
        """Computes a small archive, quickly."""
        scheme = [] if "--scheme" in arguments else ["--scheme", "bdf1"]
        return self.run_tool("sphere.obj", "rubber.json", "-o", output, "--dt", "0.01", *scheme,
                             *arguments, code=code, **options)

    def assert_error(self, done, *parts):
        """One `error:` line, the first and only one of stderr, that contains all parts."""
        lines = done.stderr.splitlines()
        errors = [line for line in lines if line.startswith("error: ")]
        self.assertEqual(len(errors), 1, done.stderr)
        self.assertEqual(done.stdout, "")
        for part in parts:
            self.assertIn(part, errors[0])

    def files(self):
        return sorted(path.name for path in self.folder.iterdir())
