"""What the tests of bemsim share.

The environment variables BEMSHAPE, BEMPRECOMP and BEMSIM are the built programs.
"""
import json
import math
import os
import pathlib
import subprocess
import tempfile
import unittest

import h5py
import numpy as np

DT = 0.01
DENSITY = 1000.0
GRAVITY = np.array([0, -9.81, 0])
LIMIT = 30  # seconds that no run here may take

shared = tempfile.TemporaryDirectory()
models = pathlib.Path(shared.name)  # of the archives


def make_models():
    material = {"name": "rubber", "density": DENSITY, "shear_modulus": 40000, "poisson_ratio": 0.45}
    (models / "rubber.json").write_text(json.dumps(material))
    make_model("ball", "icosphere", 1)


def make_model(name, shape, subdivisions):
    program("bemshape", shape, "--subdivisions", subdivisions, "--radius", "0.1", "-o", models / f"{name}.obj")
    program("bemprecomp", models / f"{name}.obj", models / "rubber.json", "-o", models / f"{name}.bem", "--dt", DT,
            "--quiet")


def program(name, *arguments, expect=0):
    done = subprocess.run([os.environ[name.upper()], *map(str, arguments)], capture_output=True, text=True, timeout=LIMIT)
    if done.returncode != expect:
        raise AssertionError(f"{name} {arguments}: exit code {done.returncode}, not {expect}\n"
                             f"{done.stdout}\n{done.stderr}")
    return done


def read_obj(path):
    vertices, faces = [], []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            vertices.append([float(w) for w in words[1:4]])
        elif words and words[0] == "f":
            faces.append([int(w.split("/")[0]) - 1 for w in words[1:4]])
    return np.array(vertices), np.array(faces)


def volume(vertices, faces):
    a, b, c = (vertices[faces[:, i]] for i in range(3))
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


def rotation(axis, degrees):
    x, y, z = np.array(axis) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    a = math.radians(degrees)
    return np.eye(3) + math.sin(a) * k + (1 - math.cos(a)) * k @ k


def falling_ball():
    return {"name": "ball", "archive": str(models / "ball.bem"), "position": [0.2, 1, -3],
            "rotation": {"axis": [0, 1, 1], "angle_deg": 40}, "velocity": [1.5, 0.5, 0]}


def held_ball():
    return {"name": "held", "archive": str(models / "ball.bem"),
            "fixed": [{"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}}],
            "tractions": [{"select": {"box": {"min": [0.05, -1, -1], "max": [1, 1, 1]}},
                           "traction": [900, 0, 0]}]}


class SimulationCase(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not (models / "ball.bem").exists():
            make_models()

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out = self.folder / "out"
        self.scene_file = self.folder / "scene.json"
        self.scene = {"version": 1, "time_step": DT, "duration": 0.2, "gravity": list(GRAVITY),
                      "bodies": [falling_ball()]}

    def simulate(self, *options, expect=0, scene=None):
        self.scene_file.write_text(json.dumps(scene or self.scene, indent=1))
        return program("bemsim", self.scene_file, "-o", self.out, *options, expect=expect)

    def check(self, *options, expect=0):
        self.scene_file.write_text(json.dumps(self.scene, indent=1))
        done = program("bemsim", self.scene_file, "--check", *options, expect=expect)
        self.assertFalse(self.out.exists())
        return done

    def touching_scene(self):
        """A ball falls on another one on the floor, a third one hangs on a joint."""
        ball = {"archive": str(models / "ball.bem"), "friction": 0.5}
        self.scene.update(
            gravity=[0, 0, -9.81], contact={"enabled": True},
            bodies=[{"name": "low", "position": [0, 0, 0.1], **ball},
                    {"name": "high", "position": [0.02, 0.01, 0.31], "velocity": [0, 0, -1], **ball},
                    {"name": "hung", "position": [1, 0, 1], **ball}],
            obstacles=[{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}, "friction": 0.5}],
            joints=[{"type": "point", "a": {"body": "hung", "point": [1.1, 0, 1]}}])

    def trajectory(self):
        return h5py.File(self.out / "trajectory.h5", "r")

    def assert_error(self, done, *parts):
        """One line, without output on stdout, that names all `parts`."""
        self.assertEqual(done.stdout, "")
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertTrue(done.stderr.startswith("error: "), done.stderr)
        for part in parts:
            self.assertIn(part, done.stderr)
