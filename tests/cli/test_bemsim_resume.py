"""Runs of bemsim that stop and go on end in the same bytes as those that never stop."""
import json
import os
import shutil
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from simulation_case import DT, LIMIT, SimulationCase, models, program

FORMATS = "hdf5,obj,vtp,pc2"


class Resume(SimulationCase):
    def setUp(self):
        super().setUp()
        self.busy_scene()

    def busy_scene(self, archive=models / "ball.bem"):
        """Contact with friction, joints, loads, and a handle that is released."""
        self.touching_scene()
        for body in self.scene["bodies"]:
            body["archive"] = str(archive)
        self.scene["bodies"][0]["tractions"] = [
            {"select": "all", "traction": [40, 0, 0], "profile": [[0, 0], [0.1, 1]]}, {"select": "all", "pressure": 50}]
        box = {"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}}
        self.scene["bodies"].append({
            "name": "shaken", "archive": str(archive), "position": [2, 0, 1],
            "handles": [{"select": box, "release_time": 0.3,
                         "motion": [{"time": 0}, {"time": 0.2, "translate": [0, 0.02, 0]}]}]})
        for name, x, speed in [("left", 4, 0), ("right", 4.2, 2)]:
            self.scene["bodies"].append({"name": name, "archive": str(archive), "position": [x, 0, 1],
                                         "velocity": [0, 0, speed]})
        self.scene["joints"].append({"type": "point", "a": {"body": "left", "point": [4.1, 0, 1]},
                                     "b": {"body": "right", "point": [4.1, 0, 1]}})
        self.scene["output"] = {"fields": ["positions", "tractions"]}
        self.scene["duration"] = 40 * DT

    def run_in(self, name, *options, expect=0):
        self.scene_file.write_text(json.dumps(self.scene, indent=1))
        return program("bemsim", self.scene_file, "-o", self.folder / name, "--format", FORMATS, "--every", 3,
                       "--stats", self.folder / f"{name}.json", *options, expect=expect)

    def output_of(self, name):
        folder = self.folder / name
        return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*")
                if path.is_file() and path.name != "checkpoint.bin"}

    def results_of(self, name):
        """What --stats has that does not depend on the clock."""
        stats = json.loads((self.folder / f"{name}.json").read_text())
        return {key: stats[key] for key in ("outcome", "steps", "time", "frames", "constraints", "momentum", "bodies")}

    def assert_same_output(self, name, other):
        expected, found = self.output_of(name), self.output_of(other)
        self.assertEqual(sorted(expected), sorted(found))
        for path, data in expected.items():
            self.assertEqual(data == found[path], True, path)
        self.assertEqual(self.results_of(name), self.results_of(other))

    def check_stops(self):
        self.run_in("whole")
        stats = self.results_of("whole")
        self.assertGreater(stats["constraints"]["steps_with_contact"], 10)
        with h5py.File(self.folder / "whole" / "trajectory.h5") as file:
            self.assertGreater(np.ptp(file["bodies/low/positions"][:], axis=0).max(), 1e-3)
        self.run_in("parts", "--checkpoint-every", 7, "--steps", 17)
        self.run_in("parts", "--resume", "--steps", 23, "--checkpoint-every", 5, "--threads", 1)
        self.run_in("parts", "--resume", "--threads", 3)
        self.assert_same_output("whole", "parts")

    def test_same_bytes(self):
        self.check_stops()

    def test_same_bytes_iteratively(self):
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "iterative.bem",
                "--dt", DT, "--inverse", "iterative", "--quiet")
        self.busy_scene(self.folder / "iterative.bem")
        self.check_stops()

    def test_same_bytes_with_a_multistep_method(self):
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "bdf2.bem",
                "--dt", DT, "--scheme", "bdf2", "--quiet")
        self.busy_scene(self.folder / "bdf2.bem")
        self.check_stops()

    def test_same_bytes_of_other_models(self):
        """Double nodes, the paper's correction, and a body without inertia."""
        for name, options in (("bdf1", ["--scheme", "bdf1", "--dt", DT]), ("static", ["--model", "static"])):
            program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / f"{name}.bem",
                    "--corner-angle-deg", 20, "--quiet", *options)
        self.busy_scene(self.folder / "bdf1.bem")
        self.scene["bodies"][0]["correction"] = "least_squares"
        shaken = next(body for body in self.scene["bodies"] if body["name"] == "shaken")
        self.scene["bodies"].append({**shaken, "name": "shaken-static", "position": [3, 3, 3], "frame": "static",
                                     "archive": str(self.folder / "static.bem")})
        self.check_stops()

    def test_same_bytes_of_rigid_bodies(self):
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "rigid.bem",
                "--model", "rigid", "--quiet")
        self.scene["bodies"][1]["archive"] = str(self.folder / "rigid.bem")
        self.check_stops()

    def start(self, name, *options):
        self.scene_file.write_text(json.dumps(self.scene))
        run = subprocess.Popen([os.environ["BEMSIM"], self.scene_file, "-o", self.folder / name, "--format", FORMATS,
                                "--every", "3", "-q", "--stats", self.folder / f"{name}.json", *map(str, options)],
                               stderr=subprocess.DEVNULL)
        self.addCleanup(run.kill)
        return run

    def stop_after_checkpoint(self, run, name, signal_number):
        end = time.monotonic() + LIMIT
        while not (self.folder / name / "checkpoint.bin").exists():
            self.assertLess(time.monotonic(), end, "no checkpoint appears")
            time.sleep(0.005)
        run.send_signal(signal_number)
        return run.wait()

    def test_killed_run(self):
        self.scene["duration"] = 150 * DT
        self.run_in("whole")
        run = self.start("parts", "--checkpoint-every", 7)
        self.assertEqual(self.stop_after_checkpoint(run, "parts", signal.SIGKILL), -signal.SIGKILL)
        self.run_in("parts", "--resume")
        self.assert_same_output("whole", "parts")

    def test_interrupted_run(self):
        """It leaves a checkpoint of where it was."""
        self.scene["duration"] = 150 * DT
        self.run_in("whole")
        run = self.start("parts", "--checkpoint-every", 7)
        self.assertEqual(self.stop_after_checkpoint(run, "parts", signal.SIGTERM), 143)
        stopped = json.loads((self.folder / "parts.json").read_text())
        self.assertEqual(stopped["outcome"], "interrupted")
        done = self.run_in("parts", "--resume")
        self.assertIn(f"{stopped['steps']} of 150 steps", done.stderr)
        self.assert_same_output("whole", "parts")

    def test_other_runs_are_refused(self):
        shutil.copy(models / "ball.bem", self.folder / "copy.bem")
        self.scene["bodies"][0]["archive"] = "copy.bem"
        self.run_in("out", "--checkpoint-every", 7, "--steps", 9)
        before = self.output_of("out")
        self.assert_error(self.run_in("out", "--resume", "--steps", 5, expect=2), "step 9", "step 5")
        self.assert_error(self.run_in("other", "--resume", expect=2), "no checkpoint")
        self.assert_error(self.run_in("out", "--steps", 12, expect=2), "--force")
        self.scene["output"] = {}
        self.assert_error(self.run_in("out", "--resume", expect=3), "checkpoint.bin", "another scene or output")
        self.scene["output"] = {"fields": ["positions", "tractions"]}
        self.scene["gravity"] = [0, 0, -9.8]
        self.assert_error(self.run_in("out", "--resume", expect=3), "checkpoint.bin", "another scene")
        self.scene["gravity"] = [0, 0, -9.81]
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "copy.bem",
                "--dt", DT, "--codec", "none", "--force", "--quiet")
        self.assert_error(self.run_in("out", "--resume", expect=4), "checkpoint.bin", "other archives")
        shutil.copy(models / "ball.bem", self.folder / "copy.bem")
        checkpoint = self.folder / "out" / "checkpoint.bin"
        good = checkpoint.read_bytes()
        checkpoint.write_bytes(good[:1000] + bytes([good[1000] ^ 1]) + good[1001:])
        self.assert_error(self.run_in("out", "--resume", expect=3), "checkpoint.bin", "damaged")
        checkpoint.write_bytes(good)
        self.assertEqual(self.output_of("out"), before)
        self.run_in("out", "--resume", "--steps", 12)

    def test_force_removes_the_checkpoint(self):
        self.run_in("out", "--checkpoint-every", 7, "--steps", 9)
        self.run_in("out", "--force", "--steps", 9)
        self.assertFalse((self.folder / "out" / "checkpoint.bin").exists())


if __name__ == "__main__":
    unittest.main()
