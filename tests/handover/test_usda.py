"""--format usda, read back by TinyUSDZ and compared with the trajectory."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import time
import unittest

import numpy as np

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent / "cli"))
from simulation_case import SimulationCase, falling_ball, held_ball, program, rotation  # noqa: E402
from usda_text import Layer  # noqa: E402

# Six faces with four corners, the texture coordinates of a square each.
CUBE = "".join(f"v {x} {y} {z}\n" for x in (-.05, .05) for y in (-.05, .05) for z in (-.05, .05)) + "vt 0 0\nvt 1 0\nvt 1 0.75\nvt 0 1\n" + "".join(
    "f " + " ".join(f"{v}/{k + 1}" for k, v in enumerate(face)) + "\n"
    for face in ((1, 2, 4, 3), (5, 7, 8, 6), (1, 5, 6, 2), (3, 4, 8, 7), (1, 3, 7, 5), (2, 6, 8, 4)))
FACES = [[int(word.split("/")[0]) - 1 for word in line.split()[1:]] for line in CUBE.splitlines() if line.startswith("f")]
WALL = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"


def read(path):
    """The layer as it is in the file and as TinyUSDZ has read it, and the meshes at the first time by their paths."""
    done = subprocess.run([os.environ["BEM_NODE"], here / "read_usda.mjs", os.environ["BEM_NODE_MODULES"], path],
                          capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr[-2000:]
    found = json.loads(done.stdout)
    return Layer(path.read_text()), Layer(found["text"]), found["meshes"]


class Usda(SimulationCase):
    def setUp(self):
        super().setUp()
        (self.folder / "cube.obj").write_text(CUBE)
        (self.folder / "wall.obj").write_text(WALL)
        self.scene.update(gravity=[0, 0, -9.81], contact={"enabled": True})
        self.scene["bodies"] = [{**falling_ball(), "name": "two words", "render_mesh": "cube.obj"}, {**held_ball(), "name": "two_words"},
                                {**held_ball(), "name": "2 käse \"", "position": [0, 5, 0]}]
        self.scene["obstacles"] = [
            {"name": "floor", "plane": {"point": [0, 0, -9], "normal": [0, 0, 1]}},
            {"name": "wall", "mesh": "wall.obj", "position": [0, 9, 0], "motion": [
                {"time": 0, "translate": [0, 0, 0]},
                {"time": 0.2, "translate": [0, 0, 1], "rotate": {"axis": [1, 0, 0], "angle_deg": 90}, "about": [0, 9, 0]}]}]
        self.scene["output"] = {"formats": ["usda"], "every": 4, "fields": ["positions", "velocities", "stress"]}


    def test_everything_of_a_run(self):
        self.simulate()
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), ["trajectory.h5", "trajectory.usda"])
        own, layer, meshes = read(self.out / "trajectory.usda")
        self.check_run(own, meshes, np.float32)
        # TinyUSDZ prints seven to eight digits.
        self.check_run(layer, meshes, lambda expected: expected, rtol=2e-7)

    def check_run(self, layer, meshes, rounded, rtol=0):
        self.assert_close = lambda found, expected: np.testing.assert_allclose(rounded(found), rounded(expected), rtol=rtol, atol=1e-44)
        names = ["two_words", "two_words_2", "_2_k__se__", "floor", "wall"]
        self.assertEqual(list(layer.meshes), names)
        self.assertEqual(sorted(meshes), sorted(f"/World/{name}" for name in names))
        self.assertEqual(layer.metadata, {"metersPerUnit": 1, "upAxis": "Z", "timeCodesPerSecond": 25, "framesPerSecond": 25,
                                          "startTimeCode": 0, "endTimeCode": 5, "defaultPrim": "World"})
        with self.trajectory() as file:
            for body, name in zip(["two words", "two_words", "2 käse \""], names):
                self.check_body(file[f"bodies/{body}"], layer.meshes[name], meshes[f"/World/{name}"])
            self.check_wall(file["obstacles/wall"], layer.meshes["wall"])
        self.check_quads(layer.meshes["two_words"], meshes["/World/two_words"])
        floor = layer.meshes["floor"]
        self.assertEqual(set(floor["points"][:, 2]), {-9})
        self.assertEqual(len(layer.meshes["wall"]["faceVertexIndices"]), 3)

    def check_body(self, body, mesh, first):
        times = list(range(6))  # of time codes
        for name, dataset in [("points", "positions"), ("primvars:velocities", "velocities"), ("primvars:von_mises", "von_mises"),
                              ("primvars:stress", "stress")]:
            self.assertEqual(list(mesh[name]), times, name)
            expected = body[dataset][:]
            self.assert_close(np.array(list(mesh[name].values())).reshape(expected.shape), expected)
        x = body["positions"][:]
        self.assert_close(np.array(list(mesh["extent"].values())), np.stack([x.min(1), x.max(1)], axis=1))
        if set(mesh["faceVertexCounts"]) == {3}:
            np.testing.assert_allclose(np.reshape(first["points"], (-1, 3)), x[0], rtol=2e-7)
            np.testing.assert_array_equal(mesh["faceVertexIndices"].reshape(-1, 3), body["faces"])

    def check_quads(self, mesh, first):
        """TinyUSDZ cuts quads from the first corner in its scene, not in the layer."""
        self.assertEqual(mesh["subdivisionScheme"], "none")
        np.testing.assert_array_equal(mesh["faceVertexCounts"], [4] * 6)
        np.testing.assert_array_equal(mesh["faceVertexIndices"].reshape(-1, 4), FACES)
        np.testing.assert_array_equal(mesh["primvars:st"], [[0, 0], [1, 0], [1, 0.75], [0, 1]])
        np.testing.assert_array_equal(mesh["primvars:st:indices"].reshape(-1, 4), [[0, 1, 2, 3]] * 6)
        points, uvs = (np.reshape(first[name], (-1, n))[first["faceVertexIndices"]].reshape(6, 6, n) for name, n in [("points", 3), ("texcoords", 2)])
        cut = [0, 1, 2, 0, 2, 3]
        np.testing.assert_allclose(points, list(mesh["points"].values())[0][FACES][:, cut], rtol=2e-7)
        np.testing.assert_array_equal(uvs, [mesh["primvars:st"][cut]] * 6)

    def check_wall(self, wall, mesh):
        np.testing.assert_array_equal(mesh["points"], wall["vertices"])
        for k, matrix in mesh["xformOp:transform"].items():
            turned = rotation([1, 0, 0], 90 * k / 5)
            np.testing.assert_allclose(matrix, np.block([[turned.T, np.zeros((3, 1))], [wall["translation"][int(k)], 1]]), atol=1e-12)

    def test_times_that_are_no_multiples(self):
        self.simulate("--fps", 30)
        layer, _, _ = read(self.out / "trajectory.usda")
        with self.trajectory() as file:
            codes = np.array(list(layer.meshes["two_words"]["points"]))
            np.testing.assert_allclose(codes / layer.metadata["timeCodesPerSecond"], file["time"][:], atol=1e-9)

    def test_beside_an_earlier_run(self):
        self.scene["output"]["fields"] = ["positions"]
        self.simulate("--format", "usda,glb", "--steps", 4)
        self.assert_error(self.simulate("--format", "usda", expect=2), "--force")
        (self.out / "mine.usda").write_text("mine")
        self.simulate("--format", "obj", "--force", "--steps", 1)
        self.assertEqual(sorted(path.name for path in self.out.iterdir()), ["mine.usda", "obj"])

    def test_a_run_that_goes_on_makes_the_same_files(self):
        self.scene["output"]["formats"] = ["glb", "usda"]
        self.simulate()
        expected = {name: (self.out / name).read_bytes() for name in ("trajectory.h5", "trajectory.usda", "trajectory.glb")}
        self.simulate("--force", "--checkpoint-every", 6, "--steps", 14)
        self.assertNotEqual((self.out / "trajectory.usda").read_bytes(), expected["trajectory.usda"])
        self.simulate("--resume", "--checkpoint-every", 6)
        for name, content in expected.items():
            self.assertEqual((self.out / name).read_bytes(), content, name)

    def test_an_interrupted_run_has_its_frames(self):
        self.scene["duration"] = 1000
        self.scene_file.write_text(json.dumps(self.scene))
        with subprocess.Popen([os.environ["BEMSIM"], self.scene_file, "-o", self.out, "--format", "usda,glb"], stderr=subprocess.PIPE, text=True) as run:
            while not (self.out / "trajectory.h5").exists():
                self.assertIsNone(run.poll())
                time.sleep(0.05)
            time.sleep(0.3)
            run.send_signal(signal.SIGINT)
            message = run.communicate(timeout=60)[1]
        self.assertEqual(run.returncode, 130, message)
        self.assertIn("frames", message)
        self.assertTrue((self.out / "trajectory.glb").exists())
        layer, _, _ = read(self.out / "trajectory.usda")
        with self.trajectory() as file:
            self.assertEqual(len(layer.meshes["two_words"]["points"]), len(file["time"]))

    def test_the_tool_makes_the_same_file(self):
        """Where there is no render mesh, whose faces the trajectory does not have."""
        del self.scene["bodies"][0]["render_mesh"]
        self.simulate("--format", "usda,glb")
        for kind in ("usda", "glb"):
            made = self.folder / f"made.{kind}"
            program("bemview", self.out / "trajectory.h5", "-o", made)
            self.assertEqual(made.read_bytes(), (self.out / f"trajectory.{kind}").read_bytes())
        program("bemview", self.out / "trajectory.h5", "-o", self.folder / "part.usda", "--bodies", "two_words", "--fields", "speed", "--every", 2)
        layer, _, _ = read(self.folder / "part.usda")
        self.assertEqual(list(layer.meshes), ["two_words", "floor", "wall"])
        mesh = layer.meshes["two_words"]
        self.assertEqual(len(mesh["points"]), 3)
        self.assertEqual([name for name in mesh if name.startswith("primvars:")], ["primvars:displayColor", "primvars:velocities"])
        self.assert_error(program("bemview", self.out / "trajectory.h5", "-o", self.folder / "x.glb", "--title", "t", expect=2), "--title")


if __name__ == "__main__":
    unittest.main()
