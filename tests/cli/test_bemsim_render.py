"""Trajectories of render meshes: textured meshes that go with a coarse simulated surface."""
import json
import unittest

import h5py
import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOGeometry import vtkOBJReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from simulation_case import SimulationCase, falling_ball, held_ball, models, program

RADIUS = 0.1  # of the simulated ball
RINGS, AROUND = 12, 24


def textured_ball():
    """A sphere of quads and, at its poles, triangles; its seam has vertices twice, with UVs 0 and 1."""
    lines = ["# a textured ball", "mtllib ball.mtl", "o ball"]
    for i in range(RINGS + 1):
        for j in range(AROUND + 1):
            a, b = np.pi * i / RINGS, 2 * np.pi * (j % AROUND) / AROUND
            n = np.array([np.sin(a) * np.cos(b), np.sin(a) * np.sin(b), np.cos(a)])
            lines += ["v %r %r %r" % tuple(float(x) for x in RADIUS * n), "vn %.6f %.6f %.6f" % tuple(n),
                      f"vt {j / AROUND} {1 - i / RINGS}"]
    lines += ["g all", "usemtl checkers", "s 1"]
    for i in range(RINGS):
        for j in range(AROUND):
            corner = [i * (AROUND + 1) + j, (i + 1) * (AROUND + 1) + j, (i + 1) * (AROUND + 1) + j + 1,
                      i * (AROUND + 1) + j + 1]
            corner = corner[1:] if i == 0 and j % 2 else corner[:2] + corner[3:] if i == RINGS - 1 else corner
            lines.append("f " + " ".join(f"{v + 1}/{v + 1}/{v + 1}" for v in corner))
    return "\n".join(lines) + "\n"


def statements(text, *keywords):
    return [line for line in text.splitlines() if line.split()[:1] and line.split()[0] in keywords]


def faces_of(text):
    """Corners with the numbers of vertices and texture coordinates."""
    return [[corner.split("/")[:2] for corner in line.split()[1:]] for line in statements(text, "f")]


def coordinates(text, keyword="v"):
    return np.array([[float(x) for x in line.split()[1:4]] for line in statements(text, keyword)])


class RenderMeshes(SimulationCase):
    def setUp(self):
        super().setUp()
        self.textured = textured_ball()
        (self.folder / "ball.obj").write_text(self.textured)
        (self.folder / "ball.mtl").write_text("newmtl checkers\nKd 1 0 0\n")
        pulled = {**held_ball(), "render_mesh": "ball.obj"}
        spinning = {**falling_ball(), "render_mesh": "ball.obj", "angular_velocity": [0, 5, 0]}
        self.scene["bodies"] = [pulled, spinning, {**falling_ball(), "name": "plain"}]
        self.scene["output"] = {"fields": ["positions", "tractions"], "every": 5}

    def test_obj_frames_keep_faces_and_uvs(self):
        self.simulate("--format", "obj,hdf5")
        files = {path.name for path in (self.out / "obj").iterdir()}
        self.assertEqual(files, {f"{name}_{k:06}.obj" for name in ("ball", "held", "plain") for k in range(5)})
        for name in ("held", "ball"):
            for k in range(5):
                text = (self.out / "obj" / f"{name}_{k:06}.obj").read_text()
                self.assertEqual(faces_of(text), faces_of(self.textured))
                for keyword in ("vt", "g", "o", "usemtl", "s", "#"):
                    self.assertEqual(statements(text, keyword), statements(self.textured, keyword))
                library = statements(text, "mtllib")[0].split(maxsplit=1)[1]
                self.assertTrue((self.out / "obj" / library).samefile(self.folder / "ball.mtl"))
                with self.trajectory() as file:
                    np.testing.assert_array_equal(coordinates(text), file[f"bodies/{name}/positions"][k])
        self.check_motion()
        self.check_with_another_reader()

    def check_motion(self):
        """The render mesh is where the ball is, in one piece, and its normals stand on it."""
        with self.trajectory() as file:
            body = file["bodies/ball"]
            self.assertEqual(body.attrs["surface"], "render")
            self.assertNotIn("surface", file["bodies/plain"].attrs)
            rest = coordinates(self.textured)
            for k in range(5):
                placed = body["frame/translation"][k] + rest @ body["frame/rotation"][k].T
                np.testing.assert_allclose(body["positions"][k], placed, atol=0.01 * RADIUS)
            held = file["bodies/held/positions"][:]
            self.assertGreater(np.abs(held[-1] - held[0]).max(), 0.01 * RADIUS)
            seam = np.arange(RINGS + 1) * (AROUND + 1)
            np.testing.assert_array_equal(held[:, seam], held[:, seam + AROUND])
            left = rest[:, 0] < -0.07
            np.testing.assert_allclose(held[-1][left], held[0][left], atol=0.02 * RADIUS)
            tractions = file["bodies/held/tractions"][-1]
            self.assertGreater(tractions[:, 0].max(), 800)  # 900 Pa pull at the right
        text = (self.out / "obj" / "ball_000004.obj").read_text()
        points = coordinates(text)
        normals = coordinates(text, "vn")
        outward = points - points.mean(axis=0)
        outward /= np.linalg.norm(outward, axis=1)[:, None]
        corners = np.array([[int(x) for x in corner.split("/")] for line in statements(text, "f")
                            for corner in line.split()[1:]])
        agreement = np.einsum("ij,ij->i", outward[corners[:, 0] - 1], normals[corners[:, 2] - 1])
        self.assertGreater(agreement.min(), 0.99)

    def check_with_another_reader(self):
        reader = vtkOBJReader()
        for path in (self.folder / "ball.obj", self.out / "obj" / "held_000004.obj"):
            reader.SetFileName(str(path))
            reader.Update()
            surface = reader.GetOutput()
            found = (surface.GetNumberOfPoints(),
                     vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).tolist(),
                     vtk_to_numpy(surface.GetPolys().GetOffsetsArray()).tolist(),
                     vtk_to_numpy(surface.GetPointData().GetTCoords()).tolist())
            if path.parent == self.folder:
                expected = found
        self.assertEqual(found, expected)

    def test_other_formats_show_the_same(self):
        self.simulate("--format", "hdf5,vtp,pc2")
        with self.trajectory() as file:
            body = file["bodies/held"]
            self.assertEqual(body["positions"].shape, (5, (RINGS + 1) * (AROUND + 1), 3))
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(str(self.out / "vtp" / "held_000004.vtp"))
            reader.Update()
            surface = reader.GetOutput()
            np.testing.assert_array_equal(vtk_to_numpy(surface.GetPoints().GetData()), body["positions"][4])
            np.testing.assert_array_equal(vtk_to_numpy(surface.GetPointData().GetArray("tractions")),
                                          body["tractions"][4])
            sizes = np.diff(vtk_to_numpy(surface.GetPolys().GetOffsetsArray()))
            self.assertEqual(sizes.tolist(), [len(f) for f in faces_of(self.textured)])
            samples = np.frombuffer((self.out / "pc2" / "held.pc2").read_bytes()[32:], "<f4").reshape(5, -1, 3)
            np.testing.assert_array_equal(samples, body["positions"][:].astype(np.float32))
        mesh = (self.out / "pc2" / "held.obj").read_text()
        self.assertEqual(faces_of(mesh), faces_of(self.textured))
        np.testing.assert_allclose(coordinates(mesh), samples[0], atol=1e-7)

    def test_both_surfaces(self):
        self.simulate()
        with self.trajectory() as file:
            render = {name: body["positions"][:] for name, body in file["bodies"].items()}
        self.assert_error(program("bemmeasure", self.scene_file, self.out / "trajectory.h5", expect=4),
                          "held", "render mesh", '"both"')
        self.scene["output"]["surface"] = "simulation"
        self.simulate("--force")
        with self.trajectory() as file:
            simulated = {name: body["positions"][:] for name, body in file["bodies"].items()}
            self.assertTrue(all("surface" not in body.attrs for body in file["bodies"].values()))
        alone = program("bemmeasure", self.scene_file, self.out / "trajectory.h5").stdout
        self.scene["output"]["surface"] = "both"
        self.simulate("--force", "--format", "hdf5,obj")
        with self.trajectory() as file:
            self.assertEqual(set(file["bodies"]), {"held", "held-simulation", "ball", "ball-simulation", "plain"})
            self.assertEqual(file["bodies/held-simulation"].attrs["surface"], "simulation")
            for name in ("held", "ball"):
                np.testing.assert_array_equal(file[f"bodies/{name}/positions"], render[name])
                np.testing.assert_array_equal(file[f"bodies/{name}-simulation/positions"], simulated[name])
        self.assertTrue((self.out / "obj" / "held-simulation_000004.obj").exists())
        self.assertEqual(program("bemmeasure", self.scene_file, self.out / "trajectory.h5").stdout, alone)
        self.scene["bodies"][2]["name"] = "held-simulation"
        self.assert_error(self.simulate("--force", expect=3), "held-simulation", "/bodies/2/name")

    def test_resume(self):
        self.scene["output"]["surface"] = "both"
        options = ["--format", "hdf5,obj,vtp,pc2", "--every", 2]

        def run(name, *more, expect=0):
            self.out = self.folder / name
            return self.simulate(*options, *more, expect=expect)

        run("whole")
        run("parts", "--checkpoint-every", 3, "--steps", 8)
        run("parts", "--resume", "--threads", 1)
        whole, parts = ({path.relative_to(self.folder / name): path.read_bytes()
                         for path in (self.folder / name).rglob("*") if path.is_file() and path.suffix != ".bin"}
                        for name in ("whole", "parts"))
        self.assertEqual(set(whole), set(parts))
        for path, data in whole.items():
            self.assertTrue(data == parts[path], path)
        (self.folder / "ball.obj").write_text(self.textured.replace("s 1", "s 2"))
        self.assert_error(run("parts", "--resume", expect=4), "checkpoint.bin", "render meshes")

    def test_check_and_mistakes(self):
        text = self.check().stdout
        self.assertIn(f"render mesh ball.obj: {(RINGS + 1) * (AROUND + 1)} vertices, up to 0.0", text)
        self.assertIn("% of the size", text)
        self.assertEqual(text.count("render mesh"), 2)
        self.scene["output"]["surface"] = "simulation"
        self.assertNotIn("render mesh", self.check().stdout)
        self.scene["output"]["surface"] = "render"
        program("bemshape", "icosphere", "--subdivisions", 2, "--radius", 100, "-o", self.folder / "in-mm.obj")
        self.scene["bodies"] = [{**falling_ball(), "render_mesh": "in-mm.obj"}]
        self.assertIn("/bodies/0/render_mesh: vertices of the render mesh", self.check().stderr)
        for name, problem in (("gone.obj", "no such mesh file"), ("rubber.json", "rubber.json")):
            self.scene["bodies"][0]["render_mesh"] = name
            self.assert_error(self.check(expect=3), "/bodies/0/render_mesh", problem)
        (self.folder / "out" / "obj").mkdir(parents=True)
        (self.folder / "out" / "obj" / "a_000000.obj").write_text(self.textured)
        self.scene["bodies"][0]["render_mesh"] = "out/obj/a_000000.obj"
        self.assert_error(self.simulate("--format", "obj", "--force", expect=2), "a_000000.obj")

    def test_scale_of_the_archive(self):
        program("bemshape", "icosphere", "--subdivisions", 1, "--radius", 100, "-o", self.folder / "mm.obj")
        program("bemprecomp", self.folder / "mm.obj", models / "rubber.json", "-o", self.folder / "mm.bem", "--dt", 0.01,
                "--mesh-scale", 0.001, "--quiet")
        program("bemshape", "icosphere", "--subdivisions", 2, "--radius", 100, "-o", self.folder / "fine-mm.obj")
        self.scene["bodies"] = [{"name": "ball", "archive": "mm.bem", "render_mesh": "fine-mm.obj"}]
        self.simulate("--steps", 1)
        with self.trajectory() as file:
            self.assertAlmostEqual(np.linalg.norm(file["bodies/ball/positions"][0], axis=1).max(), RADIUS)


if __name__ == "__main__":
    unittest.main()
