"""Files of glTF, read back by three.js in headless Chromium and compared with the trajectory."""
import base64
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here.parent / "viewer"), str(here.parent.parent / "scripts")]
from common import browser  # noqa: E402
from trajectories import FRAMES, GRAVITY, STEP, add, write_layout_1, write_layout_2  # noqa: E402


class Glb(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="bem_glb_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        subprocess.run([os.environ["BEM_NODE"], here / "bundle.mjs", os.environ["BEM_NODE_MODULES"], here / "glb_page.js", cls.folder / "page.js"],
                       check=True)
        cls.chromium = browser.Browser(300, 200)
        cls.addClassCleanup(cls.chromium.close)

    def tearDown(self):
        self.assertEqual(self.chromium.errors, [])

    def make(self, write, *options):
        """Opens the file that bemview makes of a trajectory; returns its bytes."""
        write(self.folder / "t.h5")
        subprocess.run([os.environ["BEMVIEW"], self.folder / "t.h5", "-o", self.folder / "t.glb", "-q", "--force", *options], check=True)
        content = (self.folder / "t.glb").read_bytes()
        (self.folder / "t.html").write_text(
            f'<meta charset="utf-8"><body><script>var data = "{base64.b64encode(content).decode()}";</script><script src="page.js"></script>')
        self.chromium.open(self.folder / "t.html")
        self.assertEqual(self.chromium.evaluate("document.body.dataset.state"), "ready", self.chromium.errors)
        return content

    def ask(self, call):
        return self.chromium.evaluate(f"glb.{call}")

    def at(self, name, time):
        found = self.ask(f"at({json.dumps(name)}, {time})")
        return (np.reshape(found[part], (-1, 3)) for part in ("points", "normals"))

    def turned(self, points):
        """From the axes of the trajectory to those of glTF."""
        return points

    def check_body(self, file, name):
        body = file[f"bodies/{name}"]
        x = body["positions"][:]
        first, _ = self.at(name, 0)
        distances = np.linalg.norm(first[:, None] - self.turned(x[0])[None], axis=2)
        vertex = distances.argmin(1)  # of the body, by vertex of the file
        self.assertEqual(set(vertex), set(range(8)))
        corners = np.reshape(self.ask(f"describe('{name}')")["corners"], (-1, 3))
        expected = body["faces"][:]
        least_first = lambda faces: sorted(tuple(np.roll(f, -np.argmin(f))) for f in faces)
        self.assertEqual(least_first(vertex[corners]), least_first(expected))
        for k in (0, 1, 17, 35, 50, FRAMES - 1):
            points, normals = self.at(name, k * STEP)
            np.testing.assert_allclose(points, self.turned(x[k])[vertex], atol=3e-7)
            a, b, c = (points[corners[:, i]] for i in range(3))
            flat = np.cross(b - a, c - a)
            flat /= np.linalg.norm(flat, axis=1)[:, None]
            for i in range(3):  # every edge of a cube is a crease
                np.testing.assert_allclose(normals[corners[:, i]], flat, atol=2e-6)

    def test_bodies_and_obstacles_move_as_in_the_trajectory(self):
        self.make(write_layout_2)
        self.assertEqual(self.ask("names"), ["right", "left", "slab", "floor"])
        self.assertAlmostEqual(self.ask("duration"), (FRAMES - 1) * STEP, places=6)
        with h5py.File(self.folder / "t.h5") as file:
            self.check_body(file, "right")
            self.check_body(file, "left")
            slab = file["obstacles/slab"]
            for k in (0, 40, FRAMES - 1):
                points, _ = self.at("slab", k * STEP)
                expected = slab["vertices"][:] + slab["translation"][k]
                np.testing.assert_allclose(points.min(0), expected.min(0), atol=1e-7)
                np.testing.assert_allclose(points.max(0), expected.max(0), atol=1e-7)
        floor, normals = self.at("floor", 0.3)
        np.testing.assert_allclose(floor[:, 1], 0, atol=1e-9)
        np.testing.assert_allclose(normals, [[0, 1, 0]] * len(normals), atol=1e-7)
        look = self.ask("describe('right')")
        self.assertEqual((look["targets"], look["roughness"], look["metalness"]), (FRAMES - 1, 0.5, 0))
        np.testing.assert_allclose(look["colour"], [1, 0.205, 0.147], atol=1e-3)
        self.assertEqual(self.ask("describe('slab')")["targets"], 0)

    def test_up_becomes_y(self):
        def write(path):
            write_layout_2(path)
            with h5py.File(path, "a") as file:
                file.attrs["scene"] = json.dumps({"gravity": [0, 0, -GRAVITY]})

        self.make(write, "--every", "10")
        self.turned = lambda points: np.stack([points[..., 0], points[..., 2], -points[..., 1]], axis=-1)
        with h5py.File(self.folder / "t.h5") as file:
            expected = self.turned(file["bodies/left/positions"][40])
            points, _ = self.at("left", 40 * STEP)
        np.testing.assert_allclose(points.min(0), expected.min(0), atol=3e-7)
        np.testing.assert_allclose(points.max(0), expected.max(0), atol=3e-7)

    def test_bodies_that_keep_their_shape_have_no_targets(self):
        def write(path):
            write_layout_1(path)
            with h5py.File(path, "a") as file:
                body = file["bodies/cube"]
                x = body["positions"][0]
                moved, turned = body["frame/translation"][:], body["frame/rotation"][:]
                del body["positions"]
                add(body, "positions", moved[:, None] + np.einsum("kij,nj->kni", turned, x - moved[0]), "m")

        self.assertLess(len(self.make(write)), 10000)
        self.assertEqual(self.ask("describe('cube')")["targets"], 0)
        with h5py.File(self.folder / "t.h5") as file:
            self.check_body(file, "cube")

    def test_layout_1(self):
        self.make(write_layout_1)
        with h5py.File(self.folder / "t.h5") as file:
            self.check_body(file, "cube")


if __name__ == "__main__":
    if not browser.program():
        print("skipped: Chromium is missing; scripts/setup.sh --test installs it")
        sys.exit(77)
    unittest.main()
