"""scripts/blender_import.py in Debian's Blender, compared with the trajectory."""
import json
import pathlib
import shutil
import subprocess
import sys
import unittest

import numpy as np

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "cli"))
from simulation_case import SimulationCase, falling_ball, held_ball  # noqa: E402

SCRIPT = here.parent.parent / "scripts" / "blender_import.py"
# Two quads that share an edge, below an object and a group each, and a vertex of no face.
SHEET = """mtllib sheet.mtl
o one
v -.05 -.05 0
v .05 -.05 0
v .05 .05 0
v -.05 .05 0
v 0 0 .05
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl red
f 1/1 2/2 3/3 4/4
o two
v .05 -.05 .05
v .05 .05 .05
usemtl plain
f 2/1 6/2 7/3 3/4
"""
LIBRARY = "newmtl red\nKd 1 0 0\nnewmtl plain\n"
FRAME = 3


def blender(*arguments, code=0):
    done = subprocess.run(["blender", "-b", "-noaudio", *map(str, arguments)], capture_output=True, text=True, timeout=300)
    assert done.returncode == code, f"exit code {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout + done.stderr


class Blender(SimulationCase):
    def setUp(self):
        super().setUp()
        (self.folder / "sheet.obj").write_text(SHEET)
        (self.folder / "sheet.mtl").write_text(LIBRARY)
        (self.folder / "wall.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
        self.scene["contact"] = {"enabled": True}
        self.scene["bodies"] = [{**falling_ball(), "angular_velocity": [0, 3, 0]}, {**held_ball(), "render_mesh": "sheet.obj"}]
        self.scene["obstacles"] = [
            {"name": "floor", "plane": {"point": [0, -9, 0], "normal": [0, 1, 0]}},
            {"name": "wall", "mesh": "wall.obj", "position": [0, 9, 0], "motion": [
                {"time": 0, "translate": [0, 0, 0]},
                {"time": 0.2, "translate": [0, 0, 1], "rotate": {"axis": [1, 0, 0], "angle_deg": 90}, "about": [0, 9, 0]}]}]

    def build(self):
        """What is in the scene that the script makes of a run."""
        self.simulate("--format", "pc2,hdf5", "--every", 4, "--force")
        blender("-P", SCRIPT, "--", self.out, "--save", self.folder / "run.blend")
        blender(self.folder / "run.blend", "-P", here / "inspect_blender.py", "--", FRAME, self.folder / "found.json", self.out / "pc2", "ball")
        return json.loads((self.folder / "found.json").read_text())

    def check(self, found, turn):
        """`turn` goes from the axes of the run to those of Blender."""
        self.assertEqual(sorted(found["meshes"]), ["ball", "floor", "held", "wall"])
        self.assertEqual(found["range"], [0, 5])
        self.assertAlmostEqual(found["rate"], 25, places=4)
        with self.trajectory() as file:
            for name in ("ball", "held"):
                expected = turn(file[f"bodies/{name}/positions"][FRAME])
                np.testing.assert_allclose(found["meshes"][name]["points"], expected, atol=1e-6)
            np.testing.assert_allclose(found["by_hand"], turn(file["bodies/ball/positions"][FRAME]), atol=1e-6)
            wall = file["obstacles/wall"]
            expected = wall["vertices"][:] @ wall["rotation"][FRAME].T + wall["translation"][FRAME]
            np.testing.assert_allclose(found["meshes"]["wall"]["points"], turn(expected), atol=1e-6)

    def test_y_upwards(self):
        found = self.build()
        self.check(found, lambda x: np.stack([x[:, 0], -x[:, 2], x[:, 1]], axis=1))
        np.testing.assert_allclose(np.array(found["meshes"]["floor"]["points"])[:, 2], -9, atol=1e-5)
        sheet = found["meshes"]["held"]
        self.assertEqual(sheet["faces"], [[0, 1, 2, 3], [1, 5, 6, 2]])
        self.assertEqual(sheet["materials"], ["red", "plain"])
        self.assertEqual(sheet["colour"], [1, 0, 0, 1])
        self.assertEqual(sheet["uvs"], [[0, 0], [1, 0], [1, 1], [0, 1]] * 2)
        self.assertEqual(found["meshes"]["ball"]["materials"], ["ball"])

    def test_z_upwards(self):
        self.scene["gravity"] = [0, 0, -9.81]
        self.scene["obstacles"][0]["plane"] = {"point": [0, 0, -9], "normal": [0, 0, 1]}
        found = self.build()
        found["by_hand"] = np.array(found["by_hand"])[:, [0, 2, 1]] * [1, 1, -1]  # Blender takes y as upwards if it is not told
        self.check(found, lambda x: x)
        np.testing.assert_allclose(np.array(found["meshes"]["floor"]["points"])[:, 2], -9, atol=1e-5)

    def test_a_picture(self):
        self.simulate("--format", "pc2", "--every", 4)
        blender("-P", SCRIPT, "--", self.out, "--render", self.folder / "x.png", "--width", 64, "--samples", 1)
        self.assertEqual((self.folder / "x.png").read_bytes()[:4], b"\x89PNG")

    def test_a_folder_without_caches(self):
        message = blender("-P", SCRIPT, "--", self.folder, code=1)
        self.assertIn("run bemsim with --format pc2", message)


if __name__ == "__main__":
    if not shutil.which("blender"):
        print("skipped: Blender is missing (apt-get install blender)")
        sys.exit(77)
    unittest.main()
