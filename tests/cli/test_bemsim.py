"""The program bemsim from outside: options, exit codes, and the trajectories that it writes.

The environment variables BEMSHAPE, BEMPRECOMP and BEMSIM are the built programs.
"""
import json
import math
import os
import pathlib
import pty
import re
import resource
import signal
import subprocess
import tempfile
import time
import unittest

import h5py
import numpy as np

DT = 0.01
DENSITY = 1000.0
GRAVITY = np.array([0, -9.81, 0])
LIMIT = 30  # seconds that no run here may take

shared = None  # folder of the archives
models = None


def setUpModule():
    global shared, models
    shared = tempfile.TemporaryDirectory()
    models = pathlib.Path(shared.name)
    material = {"name": "rubber", "density": DENSITY, "shear_modulus": 40000, "poisson_ratio": 0.45}
    (models / "rubber.json").write_text(json.dumps(material))
    for name, shape in [("ball", "icosphere"), ("star", "star")]:
        level = "1" if name == "ball" else "2"
        program("bemshape", shape, "--subdivisions", level, "--radius", "0.1", "-o", models / f"{name}.obj")
        program("bemprecomp", models / f"{name}.obj", models / "rubber.json", "-o", models / f"{name}.bem",
                "--dt", DT, "--quiet")


def tearDownModule():
    shared.cleanup()


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


class Case(unittest.TestCase):
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


class Trajectories(Case):
    def test_layout(self):
        self.scene["bodies"].append(held_ball())
        self.scene["output"] = {"fields": ["positions", "tractions"]}
        self.simulate("--steps", 4)
        vertices, faces = read_obj(models / "ball.obj")
        n = len(vertices)
        expected = {"positions": ((5, n, 3), "m"), "tractions": ((5, n, 3), "Pa"),
                    "frame/translation": ((5, 3), "m"), "frame/rotation": ((5, 3, 3), None)}
        with self.trajectory() as file:
            self.assertEqual(set(file), {"time", "bodies"})
            self.assertEqual(list(file["bodies"]), ["ball", "held"])
            self.assertEqual(file["time"].dtype, np.float64)
            self.assertEqual(file["time"].attrs["units"], "s")
            np.testing.assert_allclose(file["time"], DT * np.arange(5), rtol=1e-14)
            for body in file["bodies"].values():
                self.assertEqual(set(body), {"positions", "faces", "frame", "tractions"})
                np.testing.assert_array_equal(body["faces"], faces)
                self.assertEqual(body["faces"].dtype.kind, "i")
                for name, (shape, units) in expected.items():
                    self.assertEqual(body[name].shape, shape, name)
                    self.assertEqual(body[name].dtype, np.float64, name)
                    self.assertIn("units", body[name].attrs, name)
                    if units:
                        self.assertEqual(body[name].attrs["units"], units, name)

    def test_first_frame_is_the_initial_placement(self):
        self.simulate("--steps", 0)
        vertices, _ = read_obj(models / "ball.obj")
        r = rotation([0, 1, 1], 40)
        with self.trajectory() as file:
            body = file["bodies/ball"]
            self.assertEqual(list(file["time"]), [0])
            self.assertNotIn("tractions", body)
            np.testing.assert_allclose(body["positions"][0], [0.2, 1, -3] + vertices @ r.T, atol=1e-14)
            np.testing.assert_allclose(body["frame/translation"][0], [0.2, 1, -3], atol=1e-14)
            np.testing.assert_allclose(body["frame/rotation"][0], r, atol=1e-14)

    def test_free_fall(self):
        self.simulate()
        with self.trajectory() as file:
            t = file["time"][:][:, None, None]
            x = file["bodies/ball/positions"][:]
            self.assertEqual(len(x), 21)
            expected = x[0] + np.array([1.5, 0.5, 0]) * t + GRAVITY * t**2 / 2
            np.testing.assert_allclose(x, expected, atol=1e-9)
            distances = np.linalg.norm(x[:, :, None] - x[:, None], axis=-1)
            np.testing.assert_allclose(distances, np.broadcast_to(distances[0], distances.shape), atol=1e-12)

    def test_body_without_gravity(self):
        self.scene["bodies"][0]["gravity"] = False
        self.simulate()
        with self.trajectory() as file:
            x = file["bodies/ball/positions"]
            np.testing.assert_allclose(x[20] - x[0], np.full(x[0].shape, [0.3, 0.1, 0]), atol=1e-9)

    def test_fixed_vertices_and_deformation(self):
        self.scene["bodies"] = [held_ball()]
        self.simulate()
        fixed = read_obj(models / "ball.obj")[0][:, 0] <= -0.05
        with self.trajectory() as file:
            moved = np.linalg.norm(file["bodies/held/positions"][:] - file["bodies/held/positions"][0], axis=-1)
        self.assertGreater(np.count_nonzero(fixed), 3)
        self.assertLess(moved[:, fixed].max(), 1e-9)
        self.assertGreater(moved[-1, ~fixed].max(), 1e-4)

    def test_static_frame_stays(self):
        self.scene["bodies"] = [{**held_ball(), "frame": "static", "position": [1, 2, 3]}]
        self.simulate()
        with self.trajectory() as file:
            frame = file["bodies/held/frame"]
            np.testing.assert_allclose(frame["translation"], np.full((21, 3), [1, 2, 3]), atol=1e-14)
            np.testing.assert_allclose(frame["rotation"], np.broadcast_to(np.eye(3), (21, 3, 3)), atol=1e-14)

    def test_moving_frame_follows(self):
        self.scene["bodies"][0]["angular_velocity"] = [0, 5, 0]
        self.scene["gravity"] = [0, 0, 0]
        self.simulate()
        vertices, _ = read_obj(models / "ball.obj")
        with self.trajectory() as file:
            body = file["bodies/ball"]
            rigid = (body["frame/translation"][:][:, None, :] +
                     np.einsum("fij,vj->fvi", body["frame/rotation"][:], vertices))
            np.testing.assert_allclose(body["positions"], rigid, atol=2e-3)  # it bulges while it turns
            turned = rotation([0, 1, 0], math.degrees(5 * 0.2)) @ rotation([0, 1, 1], 40)
            np.testing.assert_allclose(body["frame/rotation"][20], turned, atol=1e-2)

    def test_tractions_of_a_uniform_load(self):
        self.scene["bodies"][0]["tractions"] = [{"select": "all", "traction": [30, 0, -40]}]
        self.scene["output"] = {"fields": ["positions", "tractions"]}
        self.simulate("--steps", 3)
        with self.trajectory() as file:
            values = file["bodies/ball/tractions"][1:]
            np.testing.assert_allclose(values, np.full(values.shape, [30, 0, -40]), rtol=1e-9, atol=1e-9)

    def test_same_bytes_for_any_number_of_threads(self):
        self.scene["bodies"] = [{**held_ball(), "archive": str(models / "star.bem")},
                                {**falling_ball(), "angular_velocity": [3, 1, 0]}]
        self.scene["output"] = {"fields": ["positions", "tractions"]}
        found = []
        for threads in (1, 2):
            self.simulate("--threads", threads, "--force")
            found.append((self.out / "trajectory.h5").read_bytes())
        with self.trajectory() as file:
            self.assertGreater(np.ptp(file["bodies/held/positions"][:], axis=0).max(), 1e-5)
        self.assertEqual(found[0], found[1])

    def test_same_bytes_with_contact_for_any_number_of_threads(self):
        self.touching_scene()
        found = []
        for threads in (1, 3):
            self.simulate("--threads", threads, "--force", "--stats", self.folder / "stats.json")
            found.append((self.out / "trajectory.h5").read_bytes())
        stats = json.loads((self.folder / "stats.json").read_text())
        self.assertGreater(stats["constraints"]["contacts"]["max"], 2)
        self.assertEqual(found[0], found[1])


class Schedule(Case):
    def times(self, *options):
        self.simulate("--force", *options)
        with self.trajectory() as file:
            return np.round(file["time"][:] / DT, 6).tolist()

    def test_every(self):
        self.assertEqual(self.times("--every", 7), [0, 7, 14])
        self.scene["output"] = {"every": 10}
        self.assertEqual(self.times(), [0, 10, 20])
        self.assertEqual(self.times("--every", 20), [0, 20])

    def test_fps_takes_the_nearest_steps(self):
        self.assertEqual(self.times("--fps", 40), [0, 3, 5, 8, 10, 13, 15, 18, 20])
        self.assertEqual(self.times("--fps", 30), [0, 3, 7, 10, 13, 17, 20])
        self.assertEqual(self.times("--fps", 100), list(range(21)))

    def test_fps_above_the_rate_of_steps(self):
        done = self.simulate("--fps", 1000)
        self.assertIn("warning: ", done.stderr)
        with self.trajectory() as file:
            self.assertEqual(len(file["time"]), 21)

    def test_steps_and_duration(self):
        self.assertEqual(self.times("--steps", 3), [0, 1, 2, 3])
        self.assertEqual(self.times("--steps", 0), [0])
        self.assertEqual(self.times("--duration", 0.04), [0, 1, 2, 3, 4])

    def test_check_counts_the_same_frames(self):
        for options in (["--every", 7], ["--fps", 40], ["--fps", 30], ["--steps", 0], ["--every", 1000]):
            frames = len(self.times(*options))
            plan = program("bemsim", self.scene_file, "--check", *options).stdout
            self.assertIn(f" {frames} frame", plan)


class Formats(Case):
    def test_obj_equals_hdf5(self):
        self.scene["bodies"].append(held_ball())
        self.simulate("--format", "obj,hdf5", "--every", 5)
        files = sorted(path.name for path in (self.out / "obj").iterdir())
        self.assertEqual(files, [f"{name}_{k:06}.obj" for name in ("ball", "held") for k in range(5)])
        with self.trajectory() as file:
            for name, body in file["bodies"].items():
                for k in range(5):
                    vertices, faces = read_obj(self.out / "obj" / f"{name}_{k:06}.obj")
                    np.testing.assert_array_equal(vertices, body["positions"][k])
                    np.testing.assert_array_equal(faces, body["faces"])

    def test_option_replaces_the_formats_of_the_scene(self):
        self.scene["output"] = {"formats": ["hdf5", "vtp"]}
        self.simulate("--format", "obj", "--steps", 1)
        self.assertEqual([path.name for path in self.out.iterdir()], ["obj"])

    def test_formats_that_do_not_exist_yet(self):
        for name in ("vtp", "pc2"):
            done = self.simulate("--format", name, expect=3)
            self.assert_error(done, name, "not yet supported")
            self.assertFalse(self.out.exists())


class OtherActions(Case):
    def test_check(self):
        self.scene["bodies"].append({**held_ball(), "frame": "static"})
        plan = self.check("--every", 10).stdout
        for part in ("2 from 1 archive", "84 vertices", " MB", "20 steps", "3 frames", "hdf5", "moving frame",
                     "static frame", "gravity (0, -9.81, 0)", "fixed: ", "traction on "):
            self.assertIn(part, plan)
        self.assertEqual(os.listdir(self.folder), ["scene.json"])

    def test_check_finds_what_only_the_mesh_shows(self):
        self.scene["bodies"][0]["fixed"] = [{"vertices": [4000]}]
        self.assert_error(self.check(expect=3), "scene.json:", "/bodies/0/fixed/0", "4000")

    def test_check_counts_handles(self):
        self.scene["bodies"][0]["handles"] = [{"select": {"vertices": [1, 2, 5]}}]
        self.assertIn("handles: 1 with 3 vertices", self.check().stdout)

    def test_static_frame_of_a_free_body_is_warned_of(self):
        self.scene["bodies"][0]["frame"] = "static"
        self.assertIn("warning: ", self.check().stderr)
        self.scene["bodies"][0]["frame"] = "moving"
        self.assertEqual(self.check().stderr, "")

    def test_schema_is_json(self):
        schema = json.loads(program("bemsim", "--print-schema").stdout)
        self.assertEqual(schema["type"], "object")
        self.assertLessEqual({"version", "time_step", "bodies"}, set(schema["properties"]))

    def test_help_and_version(self):
        self.assertRegex(program("bemsim", "--version").stdout, r"^bem \d+\.\d+\.\d+\n$")
        text = program("bemsim", "--help").stdout
        for option in ("--format", "--steps", "--duration", "--every", "--fps", "--threads", "--check",
                       "--print-schema", "--stats", "--force", "--quiet", "--verbose", "--log-file"):
            self.assertIn(option, text)

    def test_messages(self):
        self.assertEqual(self.simulate("-q").stderr, "")
        log = self.folder / "log.txt"
        done = self.simulate("--force", "--log-file", log)
        self.assertIn("21 frames", done.stderr)
        self.assertNotIn("\r", done.stderr)
        self.assertEqual(done.stdout, "")
        self.assertIn("21 frames", log.read_text())


    def test_progress_bar_on_a_terminal(self):
        self.scene_file.write_text(json.dumps(self.scene))
        terminal, program_side = pty.openpty()
        self.addCleanup(os.close, terminal)
        for options, shown in [(["-q"], False), ([], True)]:
            subprocess.run([os.environ["BEMSIM"], self.scene_file, "-o", self.out, "--force", *options],
                           stderr=program_side, check=True, timeout=LIMIT)
            os.write(program_side, b"end")
            text = b""
            while not text.endswith(b"end"):
                text += os.read(terminal, 4096)
            self.assertEqual(b"stepping" in text and b"%" in text, shown, text)
        os.close(program_side)


class Statistics(Case):
    def test_fields(self):
        self.scene["bodies"].append(held_ball())
        file = self.folder / "stats.json"
        self.simulate("--stats", file, "--threads", 2)
        stats = json.loads(file.read_text())
        self.assertEqual([stats[key] for key in ("outcome", "steps", "frames", "threads")], ["complete", 20, 21, 2])
        self.assertEqual(set(stats["phases"]),
                         {"unconstrained", "collision", "constraints", "correction", "output"})
        total = 0
        for phase in stats["phases"].values():
            self.assertAlmostEqual(phase["mean_seconds"] * 20, phase["total_seconds"], delta=1e-12)
            total += phase["total_seconds"]
        self.assertEqual(stats["phases"]["collision"]["total_seconds"], 0)
        for name in ("unconstrained", "constraints", "correction", "output"):
            self.assertGreater(stats["phases"][name]["total_seconds"], 0)
        self.assertGreater(stats["wall_seconds"], total)
        self.assertGreater(stats["cpu_seconds"], 0)
        self.assertGreater(stats["peak_memory_bytes"], stats["matrix_bytes"])
        constraints = stats["constraints"]
        self.assertLess(constraints["largest_joint_residual"], 1e-9)
        self.assertGreaterEqual(constraints["iterations"]["max"], constraints["iterations"]["mean"])
        self.assertGreaterEqual(constraints["iterations"]["mean"], 1)
        for name in ("steps_not_converged", "steps_with_contact"):
            self.assertEqual(constraints[name], 0)
        self.assertEqual(constraints["not_met"], {"joints": 0, "contacts": 0, "penetration": 0})
        self.assertEqual(stats["warnings"], [])
        self.check_bodies(stats["bodies"])
        self.check_momentum(stats)

    def check_momentum(self, stats):
        momentum = stats["momentum"]
        self.assertLess(momentum["relative_defect"], 1e-12)
        total = sum(np.array(impulse) for impulse in momentum["impulses"].values())
        change = np.array(momentum["end"]) - momentum["start"]
        scale = sum(np.linalg.norm(impulse) for impulse in momentum["impulses"].values())
        np.testing.assert_allclose(change, total, rtol=0, atol=1e-11 * scale)
        self.assertAlmostEqual(np.linalg.norm(change - total), momentum["defect"], delta=1e-12 * scale)
        bodies = sum(np.array(body["linear_momentum"]) for body in stats["bodies"])
        np.testing.assert_allclose(momentum["end"], bodies, rtol=0, atol=1e-12 * scale)
        return momentum

    def test_momentum_of_bodies_in_contact(self):
        self.touching_scene()
        file = self.folder / "stats.json"
        done = self.simulate("--stats", file)
        self.assertNotIn("warning", done.stderr)
        stats = json.loads(file.read_text())
        self.assertGreater(stats["constraints"]["steps_with_contact"], 5)
        impulses = self.check_momentum(stats)["impulses"]
        mass = 3 * DENSITY * volume(*read_obj(models / "ball.obj"))
        np.testing.assert_allclose(impulses["gravity"], [0, 0, -9.81 * 0.2 * mass], rtol=1e-9, atol=1e-9)
        for name in ("obstacles", "joints_to_world"):
            self.assertGreater(impulses[name][2], 0.1)
        self.assertEqual(impulses["loads"], [0, 0, 0])
        bodies = {body["name"]: np.array(body["linear_momentum"]) for body in stats["bodies"]}
        self.assertGreater(np.linalg.norm(bodies["low"][:2]), 1e-4)  # the one has pushed the other

    def test_constraints_that_are_not_met(self):
        self.touching_scene()
        self.scene["contact"]["tolerance"] = 1e-14  # rounding alone is more
        file = self.folder / "stats.json"
        done = self.simulate("--stats", file)
        stats = json.loads(file.read_text())
        missed = stats["constraints"]["steps_not_converged"]
        self.assertGreater(missed, 0)
        self.assertGreaterEqual(sum(stats["constraints"]["not_met"].values()), missed)
        self.assertGreater(stats["constraints"]["not_met"]["contacts"], 0)
        lines = [line for line in done.stderr.splitlines() if line.startswith("warning: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertEqual([lines[0][len("warning: "):]], stats["warnings"])
        for part in (f"in {missed} of 20 steps", "shorter time step", "contact tolerance, 1e-14 m"):
            self.assertIn(part, lines[0])
        verbose = self.simulate("--verbose", "--force").stderr
        self.assertEqual(verbose.count("the constraints of the step to t = "), 1, verbose)

    def check_bodies(self, bodies):
        free, held = bodies
        self.assertEqual([free["name"], held["name"]], ["ball", "held"])
        mass = DENSITY * volume(*read_obj(models / "ball.obj"))
        np.testing.assert_allclose(free["linear_momentum"], mass * (np.array([1.5, 0.5, 0]) + 0.2 * GRAVITY),
                                   rtol=1e-9, atol=1e-9)
        np.testing.assert_allclose(free["angular_momentum"], np.zeros(3), atol=1e-9)
        for body in bodies:
            self.assertTrue(0 < body["window"] <= 1)
            self.assertTrue(0 < body["growth"] < 2)

    def test_bad_path_is_noticed_before_the_run(self):
        done = self.simulate("--stats", self.folder / "missing" / "stats.json", expect=6)
        self.assert_error(done, "missing")
        self.assertFalse((self.out / "trajectory.h5").exists())


class Failures(Case):
    def test_missing_scene(self):
        self.assert_error(program("bemsim", self.scene_file, "-o", self.out, expect=3), "scene.json")
        self.assertFalse(self.out.exists())

    def test_unknown_key(self):
        self.scene["bodies"][0]["gravty"] = True
        done = self.simulate(expect=3)
        self.assertRegex(done.stderr, r'^error: .*scene\.json:\d+:\d+: /bodies/0/gravty: .*"gravity"')
        self.assertFalse(self.out.exists())

    def test_missing_archive(self):
        self.scene["bodies"][0]["archive"] = "nothing.bem"
        done = self.simulate(expect=4)
        self.assert_error(done, "scene.json:", "/bodies/0/archive", "nothing.bem")
        self.assertFalse(self.out.exists())

    def test_damaged_archive(self):
        data = bytearray((models / "ball.bem").read_bytes())
        data[len(data) // 2] ^= 1
        (self.folder / "damaged.bem").write_bytes(data)
        self.scene["bodies"][0]["archive"] = "damaged.bem"
        for run in (self.simulate, self.check):
            self.assert_error(run(expect=4), "scene.json:", "/bodies/0/archive", "damaged.bem")

    def test_archive_path_is_relative_to_the_scene(self):
        (self.folder / "copy.bem").write_bytes((models / "ball.bem").read_bytes())
        self.scene["bodies"][0]["archive"] = "copy.bem"
        self.simulate("--steps", 1)

    def test_other_time_step(self):
        self.scene["time_step"] = 0.02
        for run in (self.simulate, self.check):
            self.assert_error(run(expect=4), "scene.json:", "/bodies/0/archive", "ball.bem", "0.01 s", "0.02 s")

    def test_existing_output(self):
        self.simulate("--steps", 1)
        before = (self.out / "trajectory.h5").read_bytes()
        self.assert_error(self.simulate("--steps", 2, expect=2), "trajectory.h5", "--force")
        self.assertEqual((self.out / "trajectory.h5").read_bytes(), before)
        self.simulate("--steps", 2, "--force")
        with self.trajectory() as file:
            self.assertEqual(len(file["time"]), 3)

    def test_failure_keeps_the_old_output(self):
        self.simulate("--steps", 1)
        before = (self.out / "trajectory.h5").read_bytes()
        self.scene["bodies"][0]["archive"] = "nothing.bem"
        self.simulate("--force", expect=4)
        self.assertEqual((self.out / "trajectory.h5").read_bytes(), before)

    def test_output_that_cannot_be_written(self):
        (self.folder / "file").write_text("")
        self.out = self.folder / "file" / "out"
        self.assert_error(self.simulate(expect=6), "file")

    def test_a_disk_that_fills_up(self):
        """The frames that were written stay readable."""
        def limit(size):
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (size, size))
        self.scene_file.write_text(json.dumps({**self.scene, "duration": 20}))
        for name, size in (("hdf5", 400000), ("obj", 1000)):
            with self.subTest(name):
                done = subprocess.run([os.environ["BEMSIM"], self.scene_file, "-o", self.out, "--format", name, "--force"],
                                      capture_output=True, text=True, timeout=LIMIT, restore_signals=False,
                                      preexec_fn=lambda limited=size: limit(limited))
                self.assertEqual(done.returncode, 6, done.stderr)
                self.assertEqual(len(re.findall("^error: .*out", done.stderr, flags=re.M)), 1, done.stderr)
                if name == "hdf5":
                    self.check_frames_before_the_end()
        self.simulate("--steps", 2, "--force")
        with self.trajectory() as file:
            self.assertEqual(len(file["time"]), 3)

    def check_frames_before_the_end(self):
        with self.trajectory() as file:
            frames = len(file["time"])
            self.assertGreater(frames, 100)
            np.testing.assert_allclose(file["time"], DT * np.arange(frames), rtol=1e-9)
            x = file["bodies/ball/positions"][:frames]
            fall = np.array([1.5, 0.5, 0]) * DT * (frames - 1) + GRAVITY * (DT * (frames - 1))**2 / 2
            np.testing.assert_allclose(x[-1] - x[0], np.broadcast_to(fall, x[0].shape), rtol=1e-9, atol=1e-9)

    def test_standard_output_that_is_full(self):
        self.scene_file.write_text(json.dumps(self.scene))
        with open("/dev/full", "w") as full:
            for arguments in ([self.scene_file, "--check"], ["--print-schema"], ["--help"], ["--version"]):
                done = subprocess.run([os.environ["BEMSIM"], *arguments], stdout=full, stderr=subprocess.PIPE, text=True)
                self.assertEqual(done.returncode, 6, arguments)
                self.assertEqual(done.stderr, "error: standard output cannot be written\n")

    def test_a_killed_run(self):
        """Its frames can be read, and --force replaces them."""
        self.scene["duration"] = 100000
        self.scene_file.write_text(json.dumps(self.scene))
        stats = self.folder / "stats.json"
        run = subprocess.Popen([os.environ["BEMSIM"], self.scene_file, "-o", self.out, "-q", "--stats", stats])
        self.addCleanup(run.kill)
        end = time.monotonic() + LIMIT
        while not (self.out / "trajectory.h5").exists() or (self.out / "trajectory.h5").stat().st_size < 100000:
            self.assertLess(time.monotonic(), end, "no frames appear")
            time.sleep(0.02)
        run.kill()
        run.wait()
        with h5py.File(self.out / "trajectory.h5", "r", swmr=True) as file:
            self.assertGreater(len(file["time"]), 3)
        self.simulate("--steps", 2, "--force", "--stats", stats)
        self.assertEqual(sorted(os.listdir(self.folder)), ["out", "scene.json", "stats.json"])
        with self.trajectory() as file:
            self.assertEqual(len(file["time"]), 3)

    def test_parts_that_are_not_simulated_yet(self):
        for name in ("vtp", "pc2"):
            with self.subTest(name):
                done = self.simulate(expect=3, scene={**self.scene, "output": {"formats": [name]}})
                self.assert_error(done, "scene.json:", "/output", "not yet supported")

    def test_joints_that_do_not_fit(self):
        self.scene["bodies"].append({**falling_ball(), "name": "other", "position": [5, 0, 0]})
        ends = {"a": {"body": "ball"}, "b": {"body": "other"}}
        far = {name: {**end, "point": [9, 9, 9]} for name, end in ends.items()}
        for joint, part in [({"type": "weld", **ends}, "no vertex of body"),
                            ({"type": "point", **far}, "away from the surface")]:
            with self.subTest(part):
                done = self.simulate(expect=3, scene={**self.scene, "joints": [joint]})
                self.assert_error(done, "scene.json:", "/joints/0", part)

    def test_joint_between_different_schemes(self):
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "bdf1.bem",
                "--dt", DT, "--scheme", "bdf1", "--quiet")
        self.touching_scene()
        self.scene["bodies"][0]["archive"] = "bdf1.bem"
        self.scene["bodies"][1]["position"] = [0, 0, 0.3]
        self.scene["joints"] = [{"type": "point", "a": {"body": "low", "point": [0, 0, 0.2]},
                                 "b": {"body": "high", "point": [0, 0, 0.2]}}]
        self.assert_error(self.simulate(expect=4), "scene.json:", "/joints/0", "bdf1", "radau2", "--scheme")
        self.check(expect=4)

    def test_missing_obstacle(self):
        self.scene["obstacles"] = [{"name": "bowl", "mesh": "bowl.obj"}]
        self.scene["contact"] = {}
        self.assert_error(self.simulate(expect=3), "scene.json:", "/obstacles/0/mesh", "bowl.obj")

    def test_numerical_failure_keeps_the_frames_before_it(self):
        self.scene["bodies"][0]["tractions"] = [
            {"select": "all", "traction": [1e308, 1e308, 0], "profile": [[0, 0], [0.1, 0], [0.11, 1]]}]
        stats = self.folder / "stats.json"
        done = self.simulate("--stats", stats, expect=5)
        self.assertIn("error: ", done.stderr)
        self.assertIn("ball", done.stderr)
        with self.trajectory() as file:
            self.assertGreaterEqual(len(file["time"]), 11)
            self.assertLess(len(file["time"]), 21)
            self.assertTrue(np.isfinite(file["bodies/ball/positions"][:]).all())
        self.assertEqual(json.loads(stats.read_text())["outcome"], "failed")

    def test_command_line(self):
        scene = ["scene.json", "-o", "out"]
        for arguments, part in [
                ([], "scene"), (["scene.json"], "-o"), (scene + ["more"], "more"),
                (scene + ["--threds", "1"], "--threads"), (scene + ["--format", "abc"], "abc"),
                (scene + ["--format", "obj,obj"], "twice"), (scene + ["--steps", "-1"], "--steps"),
                (scene + ["--steps", "x"], "--steps"), (scene + ["--duration", "nan"], "--duration"),
                (scene + ["--steps", "1", "--duration", "1"], "--duration"), (scene + ["--every", "0"], "--every"),
                (scene + ["--fps", "0"], "--fps"), (scene + ["--fps", "1", "--every", "1"], "--fps"),
                (scene + ["--threads", "0"], "--threads"), (scene + ["-q", "-v"], "--verbose"),
                (scene + ["--checkpoint-every", "5"], "not supported yet"),
                (scene + ["--resume"], "not supported yet")]:
            with self.subTest(arguments):
                self.assert_error(program("bemsim", *arguments, expect=2), part)

    def test_outputs_must_not_be_inputs(self):
        (self.folder / "copy.bem").write_bytes((models / "ball.bem").read_bytes())
        self.scene["bodies"][0]["archive"] = "copy.bem"
        for option in ("--stats", "--log-file"):
            for path in (self.scene_file, self.folder / "copy.bem"):
                self.simulate(option, path, expect=2)
                self.assertEqual(json.loads(self.scene_file.read_text()), self.scene)
        self.assertEqual((self.folder / "copy.bem").read_bytes(), (models / "ball.bem").read_bytes())


class Interruption(Case):
    def interrupt(self, number):
        """Signals a long run that has begun to write; returns its exit code and messages."""
        self.scene["duration"] = 100000
        self.scene_file.write_text(json.dumps(self.scene))
        run = subprocess.Popen([os.environ["BEMSIM"], self.scene_file, "-o", self.out, "--every", "20", "--stats",
                                self.folder / "stats.json"], stderr=subprocess.PIPE, text=True)
        self.addCleanup(run.stderr.close)
        self.addCleanup(run.kill)
        end = time.monotonic() + LIMIT
        while self.frames_so_far() < 3:
            self.assertIsNone(run.poll(), "the run ended by itself")
            self.assertLess(time.monotonic(), end, "no frames appear")
            time.sleep(0.02)
        run.send_signal(number)
        _, messages = run.communicate(timeout=LIMIT)
        return run.returncode, messages

    def frames_so_far(self):
        """Also shows that a trajectory can be read while it grows."""
        try:
            with h5py.File(self.out / "trajectory.h5", "r", swmr=True) as file:
                return len(file["time"])
        except (OSError, KeyError):
            return 0

    def test_signals(self):
        for number, code in [(signal.SIGINT, 130), (signal.SIGTERM, 143)]:
            with self.subTest(number):
                returned, messages = self.interrupt(number)
                self.assertEqual(returned, code)
                self.assertIn("error: interrupted", messages)
                with self.trajectory() as file:
                    frames = len(file["time"])
                    self.assertGreaterEqual(frames, 3)
                    self.assertEqual(file["bodies/ball/positions"].shape[0], frames)
                    self.assertAlmostEqual(file["time"][frames - 1], (frames - 1) * 20 * DT, places=9)
                stats = json.loads((self.folder / "stats.json").read_text())
                self.assertEqual(stats["outcome"], "interrupted")
                self.assertEqual(stats["frames"], frames)
                self.assertEqual(stats["steps"] // 20 + 1, frames)
                (self.out / "trajectory.h5").unlink()


if __name__ == "__main__":
    unittest.main()
