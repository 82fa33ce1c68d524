"""How bemsim fails: exit codes, messages, what is left behind."""
import json
import os
import re
import resource
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from simulation_case import DT, GRAVITY, LIMIT, SimulationCase, falling_ball, models, program


class Failures(SimulationCase):
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
        # one alone is finite; all together they are not
        self.scene["bodies"][0]["tractions"] = 12 * [
            {"select": "all", "traction": [1.7e308, 0, 0], "profile": [[0, 0], [0.1, 0], [0.11, 1]]}]
        stats = self.folder / "stats.json"
        done = self.simulate("--stats", stats, expect=5)
        self.assertIn("error: ", done.stderr)
        self.assertIn("ball", done.stderr)
        with self.trajectory() as file:
            self.assertGreaterEqual(len(file["time"]), 11)
            self.assertLess(len(file["time"]), 21)
            self.assertTrue(np.isfinite(file["bodies/ball/positions"][:]).all())
        self.assertNotIn("null", stats.read_text())  # all numbers are finite
        told = json.loads(stats.read_text())
        self.assertEqual(told["outcome"], "failed")
        self.assertEqual(told["bodies"][0]["linear_momentum"], told["momentum"]["end"])

    def test_an_unstable_motion_is_stopped(self):
        material = {"name": "gum", "density": 1000, "shear_modulus": 1e6, "poisson_ratio": 0.5}
        (self.folder / "gum.json").write_text(json.dumps(material))
        program("bemshape", "box", "--size", 1, 1, 1, "--divisions", 2, 2, 2, "-o", self.folder / "cube.obj")
        make = ["bemprecomp", self.folder / "cube.obj", self.folder / "gum.json", "-o", self.folder / "cube.bem",
                "--dt", 0.002, "--quiet", "--force"]
        program(*make, "--window", 1, "--discretisation", "collocation")
        self.scene.update(time_step=0.002, duration=1, gravity=[0, 0, 0], bodies=[
            {"name": "cube", "archive": "cube.bem",
             "tractions": [{"select": "all", "pressure": 1000, "profile": [[0, 1], [0.002, 1], [0.003, 0]]}]}])
        done = self.simulate(expect=5)
        self.assertRegex(done.stderr, 'error: body "cube" is (deformed to|turned inside out)')
        for cure in ("--discretisation galerkin", "--window auto"):
            self.assertIn(cure, done.stderr)
        with self.trajectory() as file:
            x = file["bodies/cube/positions"][:]
        self.assertGreater(len(x), 5)
        self.assertLess(np.abs(x).max(), 200)
        program(*make)
        self.assertEqual(self.simulate("--force", "--quiet").stderr, "")
        with self.trajectory() as file:
            x = file["bodies/cube/positions"][:]
        self.assertLess(np.abs(x - x[0]).max(), 0.01)

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
                (scene + ["--checkpoint-every", "0"], "--checkpoint-every"),
                (scene + ["--resume", "--force"], "--force")]:
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


if __name__ == "__main__":
    unittest.main()
