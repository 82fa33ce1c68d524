"""The program bemsim from outside: other actions than simulating, statistics, interruption."""
import json
import os
import pty
import re
import signal
import subprocess
import time
import unittest

import h5py
import numpy as np

from simulation_case import DENSITY, DT, GRAVITY, LIMIT, SimulationCase, held_ball, models, program, read_obj, volume


class OtherActions(SimulationCase):
    def test_check(self):
        self.scene["bodies"].append({**held_ball(), "frame": "static"})
        plan = self.check("--every", 10).stdout
        for part in ("2 from 1 archive", "84 vertices", " MB", "20 steps", "3 frames", "hdf5", "moving frame",
                     "stationary frame", "gravity (0, -9.81, 0)", "fixed: ", "traction on "):
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

    def test_rotation_as_fast_as_vibrations_is_warned_of(self):
        body = self.scene["bodies"][0]
        body["angular_velocity"] = [0, 0, 5]
        self.assertEqual(self.check().stderr, "")
        body["angular_velocity"] = [0, 0, 40]
        self.assertIn('say "centrifugal": false', self.check().stderr)
        body["centrifugal"] = False
        self.assertEqual(self.check().stderr, "")

    def test_rotation_stretches_unless_it_is_switched_off(self):
        self.scene["bodies"][0].update(angular_velocity=[0, 0, 5], velocity=[0, 0, 0])
        widths = []
        for stretched in (True, False):
            self.scene["bodies"][0]["centrifugal"] = stretched
            self.simulate("--force")
            with self.trajectory() as file:
                ball = file["bodies/ball"]
                offsets = ball["positions"][-1] - ball["frame/translation"][-1]
            widths.append(np.linalg.norm(offsets[:, :2], axis=1).max())
        self.assertGreater(widths[0], 1.0002 * widths[1])
        self.assertLess(widths[0], 1.001 * widths[1])

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


class Statistics(SimulationCase):
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
        self.assertEqual(set(constraints["not_met"].values()), {0})
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

    def test_angular_momentum_of_an_oblique_collision(self):
        ball = {"archive": str(models / "ball.bem"), "friction": 0.5}
        self.scene.update(gravity=[0, 0, 0], contact={"enabled": True}, duration=1.0, bodies=[
            {"name": "a", "position": [0, 0, 1], "velocity": [0.5, 0, 0], **ball},
            {"name": "b", "position": [0.25, 0.08, 1], **ball}])
        file = self.folder / "stats.json"
        self.simulate("--stats", file)
        stats = json.loads(file.read_text())
        start, end = (np.array(stats["momentum"][key]) for key in ("angular_start", "angular_end"))
        mass = DENSITY * volume(*read_obj(models / "ball.obj"))
        np.testing.assert_allclose(start, mass * np.array([0, 0.5, 0]), rtol=0, atol=1e-9)
        spins = [np.linalg.norm(body["angular_momentum"]) for body in stats["bodies"]]
        self.assertGreater(min(spins), 1e-4 * np.linalg.norm(start))  # friction has made both turn
        np.testing.assert_allclose(end, start, rtol=0, atol=1e-5 * np.linalg.norm(start))

    def test_overlap_at_the_start_is_warned_of(self):
        ball = {"archive": str(models / "ball.bem")}
        self.scene.update(gravity=[0, 0, 0], contact={"enabled": True}, bodies=[
            {"name": "low", "position": [0, 0, 0.09], **ball}, {"name": "high", "position": [0, 0, 0.27], **ball},
            {"name": "apart", "position": [1, 0, 1], **ball}],
            obstacles=[{"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}])
        lines = [line for line in self.simulate("--steps", 1).stderr.splitlines() if "overlap at the start" in line]
        self.assertEqual(len(lines), 2, lines)
        for line, names in zip(lines, (('"low"', '"high"'), ('"low"', '"floor"'))):
            for part in names:
                self.assertIn(part, line)
            depth = float(re.search(r"by ([0-9.e-]+) m", line)[1])
            self.assertTrue(0.009 < depth <= 0.0201, line)
        self.scene["bodies"] = [{"name": "low", "position": [0, 0, 0.1001], **ball}]
        self.assertNotIn("overlap", self.simulate("--steps", 1, "--force").stderr)

    def test_constraints_that_are_not_met(self):
        self.touching_scene()
        self.scene["contact"]["tolerance"] = 1e-18  # rounding alone is more
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
        for part in (f"in {missed} of 20 steps", "shorter time step", "contact tolerance, 1e-18 m"):
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
            self.assertEqual(body["window"], 1)
            self.assertNotIn("growth", body)  # it is not measured by default

    def test_growth_that_an_archive_knows_is_told(self):
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "ball.bem", "--dt", DT,
                "--discretisation", "collocation", "--quiet")
        self.scene["bodies"][0]["archive"] = "ball.bem"
        self.simulate("--steps", 1, "--stats", self.folder / "stats.json")
        told = json.loads((self.folder / "stats.json").read_text())["bodies"][0]
        with h5py.File(self.folder / "ball.bem") as archive:
            self.assertEqual(told["growth"], archive["report"].attrs["growth"])
            self.assertEqual(told["window"], archive["scheme"].attrs["window"])
        self.assertTrue(0.9 < told["growth"] < 1.1)

    def test_vibrations_of_a_held_body_that_grow_are_warned_of(self):
        material = {"name": "gum", "density": 1000, "shear_modulus": 1e7, "poisson_ratio": 0.3}
        (self.folder / "gum.json").write_text(json.dumps(material))
        program("bemshape", "box", "--size", 1, 0.2, 0.2, "--divisions", 10, 2, 2, "-o", self.folder / "beam.obj")
        dt = 1 / 5.0969 / 30
        held = {"name": "beam", "archive": "beam.bem", "fixed": [{"box": {"min": [-1, -1, -1], "max": [-0.49, 1, 1]}}]}
        self.scene.update(time_step=dt, duration=120 * dt, gravity=[0, 0, -1], bodies=[held])

        def growth(*options):
            """What --stats has of it, the warnings, and the amplitude of the second half over that of the first."""
            program("bemprecomp", self.folder / "beam.obj", self.folder / "gum.json", "-o", self.folder / "beam.bem",
                    "--dt", repr(dt), "--quiet", "--force", *options)
            warnings = self.simulate("--force", "--quiet", "--stats", self.folder / "s.json").stderr
            stats = json.loads((self.folder / "s.json").read_text())
            self.assertEqual(len(stats["warnings"]), len(warnings.splitlines()))
            with self.trajectory() as file:
                x = file["bodies/beam/positions"][:, :, 2].mean(axis=1)
            return stats["bodies"][0].get("growing_vibration"), warnings, np.ptp(x[60:]) / np.ptp(x[:60])

        found, warning, ratio = growth()  # the default
        self.assertEqual((found, warning), (None, ""))
        self.assertTrue(0.9 < ratio < 1.01, ratio)
        found, warning, ratio = growth("--discretisation", "collocation")
        self.assertGreater(ratio, 1.2)
        self.assertAlmostEqual(found["growth"]**60 / ratio, 1, 1)
        self.assertAlmostEqual(found["frequency"] / 5.2, 1, 1)
        self.assertIn('the body "beam" vibrates with 5.', warning)
        self.assertIn("with --discretisation galerkin", warning)
        window, damping = re.search("--window ([0-9.e-]+), or with --damping ([a-z_]+:[0-9.e-]+)", warning).groups()
        for cure in (("--window", window), ("--damping", damping)):
            found, warning, ratio = growth("--discretisation", "collocation", *cure)
            self.assertEqual(warning, "", cure)
            self.assertAlmostEqual(ratio, 1, 1, cure)

    def test_bad_path_is_noticed_before_the_run(self):
        done = self.simulate("--stats", self.folder / "missing" / "stats.json", expect=6)
        self.assert_error(done, "missing")
        self.assertFalse((self.out / "trajectory.h5").exists())


class Interruption(SimulationCase):
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
