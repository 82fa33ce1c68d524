"""Scenes that start from a checkpoint or a trajectory of another run."""
import json
import os
import random
import shutil
import struct
import subprocess
import unittest

import h5py
import numpy as np

from resigned import limit_memory, sign_checkpoint, state_of
from simulation_case import DT, LIMIT, SimulationCase, falling_ball, held_ball, models, program

HALF = 8  # steps
CHANGES = 60


def spinning_ball(**members):
    return {**falling_ball(), "angular_velocity": [3, 1, 0], **members}


def pulled_ball(**members):
    """One that a traction stretches."""
    return spinning_ball(tractions=[{"select": {"box": {"min": [0.05, -1, -1], "max": [1, 1, 1]}},
                                     "traction": [900, 0, 0]}], **members)


class InitialState(SimulationCase):
    def run_in(self, name, *options, expect=0, **members):
        scene = {**self.scene, **members}
        self.scene_file = self.folder / f"{name}.json"
        self.scene_file.write_text(json.dumps(scene, indent=1))
        return program("bemsim", self.scene_file, "-o", self.folder / name, *options, expect=expect)

    def first_half(self, **members):
        """A run of HALF steps that leaves a checkpoint and a trajectory."""
        return self.run_in("first", "--steps", HALF, "--checkpoint-every", HALF, "-q", **members)

    def values(self, name, dataset="positions", body="ball"):
        with h5py.File(self.folder / name / "trajectory.h5") as f:
            return f[f"bodies/{body}/{dataset}"][:]

    def assert_goes_on(self, body="ball", most=0.0, **members):
        """A run from the checkpoint of the first half does what one does that never stopped."""
        self.run_in("whole", "--steps", 2 * HALF, "-q", **members)
        self.first_half(**members)
        self.run_in("second", "--steps", HALF, "-q", initial_state={"checkpoint": "first/checkpoint.bin"}, **members)
        whole, second = self.values("whole", body=body)[HALF:], self.values("second", body=body)
        self.assertEqual(len(whole), len(second))
        self.assertLessEqual(np.abs(whole - second).max(), most)
        self.assertGreater(np.abs(whole[-1] - whole[0]).max(), 1e-5)

    def refused(self, *parts, expect=3, check=True, **members):
        done = self.run_in("refused", "-q", expect=expect, **members)
        self.assert_error(done, *parts)
        if check:
            again = program("bemsim", self.scene_file, "--check", expect=expect)
            self.assert_error(again, *parts)


class FromCheckpoint(InitialState):
    FROM = {"checkpoint": "first/checkpoint.bin"}

    def test_goes_on_bit_for_bit(self):
        self.assert_goes_on(bodies=[pulled_ball(), held_ball()])

    def archive(self, *options, mesh=models / "ball.obj"):
        """One with these options of bemprecomp."""
        path = self.folder / "other.bem"
        program("bemprecomp", mesh, models / "rubber.json", "-o", path, "--dt", DT, "--quiet", "--force", *options)
        return str(path)

    def test_other_archives_and_bodies_go_on_bit_for_bit(self):
        for options, members in [(("--scheme", "bdf2"), {}), (("--scheme", "radau3"), {"frame": "static"}),
                                 (("--scheme", "bdf1"), {"correction": "least_squares"}),
                                 (("--model", "static"), {}), (("--model", "rigid"), {}),
                                 (("--inverse", "iterative"), {}), (("--discretisation", "collocation"), {})]:
            with self.subTest(options=options):
                for name in ("whole", "first", "second"):
                    shutil.rmtree(self.folder / name, ignore_errors=True)
                self.assert_goes_on(bodies=[pulled_ball(archive=self.archive(*options), **members)])

    def test_held_bodies_go_on(self):
        """But for what the forces of joints start from."""
        for archive in (models / "ball.bem", self.archive("--discretisation", "collocation", "--window", 0.98)):
            for name in ("whole", "first", "second"):
                shutil.rmtree(self.folder / name, ignore_errors=True)
            self.assert_goes_on(body="held", most=1e-10, bodies=[{**held_ball(), "archive": str(archive)}])

    def test_vertices_at_sharp_edges_that_are_let_go(self):
        """Forces at corners have a past, too."""
        program("bemshape", "box", "--size", 0.2, 0.1, 0.1, "--divisions", 4, 2, 2, "-o", self.folder / "box.obj")
        archive = self.archive("--corner-angle-deg", 40, mesh=self.folder / "box.obj")
        free = {"name": "ball", "archive": archive, "angular_velocity": [0, 0, 2]}
        end = {"box": {"min": [-1, -1, -1], "max": [-0.09, 1, 1]}}
        released = {"select": end, "motion": [{"time": 0}], "release_time": HALF * DT}
        self.run_in("whole", "--steps", 2 * HALF, "-q", bodies=[{**free, "handles": [released]}])
        self.first_half(bodies=[{**free, "fixed": [end]}])
        self.run_in("second", "--steps", HALF, "-q", bodies=[free], initial_state=self.FROM)
        self.assertLess(np.abs(self.values("whole")[HALF:] - self.values("second")).max(), 1e-9)

    def test_contacts_go_on(self):
        self.touching_scene()
        self.assert_goes_on(body="high", most=1e-7)

    def test_time_starts_at_zero(self):
        self.first_half()
        done = self.run_in("second", "--steps", 2, initial_state=self.FROM)
        self.assertIn('the body "ball" starts from step 8 (t = 0.08 s) of first/checkpoint.bin', done.stderr)
        with h5py.File(self.folder / "second" / "trajectory.h5") as f:
            np.testing.assert_allclose(f["time"][:], [0, DT, 2 * DT])

    def test_a_load_that_is_gone_goes_on_in_the_past(self):
        """The scene without the load moves as one whose load ends at the checkpoint."""
        ended = pulled_ball()
        ended["tractions"][0]["profile"] = [[0, 1], [HALF * DT, 1], [HALF * DT + 1e-9, 0]]
        self.run_in("whole", "--steps", 2 * HALF, "-q", bodies=[ended])
        self.first_half(bodies=[pulled_ball()])
        self.run_in("second", "--steps", HALF, "-q", bodies=[spinning_ball()], initial_state=self.FROM)
        whole, second = self.values("whole")[HALF:], self.values("second")
        self.assertLess(np.abs(whole - second).max(), 1e-12)
        # and so it does in a run that starts from the checkpoint of that one
        self.run_in("first", "--steps", HALF // 2, "--checkpoint-every", 1, "-q", "--force", bodies=[pulled_ball()])
        self.run_in("between", "--steps", HALF // 2, "--checkpoint-every", 1, "-q", bodies=[pulled_ball()],
                    initial_state=self.FROM)
        self.run_in("other", "--steps", 1, "--checkpoint-every", 1, "-q", bodies=[spinning_ball()],
                    initial_state={"checkpoint": "between/checkpoint.bin"})
        self.run_in("third", "--steps", HALF - 1, "-q", bodies=[spinning_ball()],
                    initial_state={"checkpoint": "other/checkpoint.bin"})
        self.assertLess(np.abs(whole[1:] - self.values("third")).max(), 1e-12)

    def test_contacts_that_are_gone_go_on_in_the_past(self):
        """Bodies that have been touched move on in a scene without contact, where nothing can touch them."""
        self.touching_scene()
        self.first_half()
        del self.scene["contact"], self.scene["obstacles"], self.scene["joints"]
        self.run_in("second", "--steps", HALF, "-q", initial_state=self.FROM)
        with h5py.File(self.folder / "second" / "trajectory.h5") as f:
            momentum = f["bodies/high/series/momentum"][:]
            mass = f["bodies/high"].attrs["mass"]
        expected = momentum[0] + np.arange(HALF + 1)[:, None] * DT * mass * np.array([0, 0, -9.81])
        np.testing.assert_allclose(momentum, expected, atol=1e-12)
        np.testing.assert_array_equal(self.values("second", body="high")[0], self.values("first", body="high")[-1])

    def test_gravity_may_change(self):
        self.first_half()
        for gravity in ([0, 0, 0], [0, 5, 1]):
            self.run_in("second", "--steps", HALF, "-q", "--force", gravity=gravity, initial_state=self.FROM)
            with h5py.File(self.folder / "second" / "trajectory.h5") as f:
                centre, momentum = (f[f"bodies/ball/series/{name}"][:] for name in ("centre", "momentum"))
                velocity = momentum[0] / f["bodies/ball"].attrs["mass"]
            np.testing.assert_allclose(velocity, np.array([1.5, 0.5, 0]) + HALF * DT * np.array([0, -9.81, 0]),
                                       atol=1e-12)
            t = DT * np.arange(HALF + 1)[:, None]
            expected = centre[0] + t * velocity + t**2 / 2 * np.array(gravity)
            np.testing.assert_allclose(centre, expected, atol=1e-12)

    def test_vertices_are_fixed_where_they_are(self):
        self.first_half()
        fixed = [{"box": {"min": [-1, -1, -1], "max": [-0.05, 1, 1]}}]
        self.run_in("second", "--steps", HALF, "-q", bodies=[spinning_ball(fixed=fixed)], initial_state=self.FROM)
        at = self.values("second")
        held = self.rest()[:, 0] < -0.05
        self.assertLess(np.abs(at[:, held] - at[0, held]).max(), 1e-8)
        self.assertGreater(np.abs(at[:, ~held] - at[0, ~held]).max(), 1e-3)
        np.testing.assert_array_equal(at[0], self.values("first")[-1])

    def rest(self):
        return np.array([[float(x) for x in line.split()[1:4]]
                         for line in (models / "ball.obj").read_text().splitlines() if line.startswith("v ")])

    def test_only_some_bodies(self):
        self.first_half(bodies=[spinning_ball(), spinning_ball(name="twin")])
        self.run_in("second", "--steps", 1, "-q", bodies=[spinning_ball(), spinning_ball(name="twin")],
                    initial_state={**self.FROM, "bodies": ["twin"]})
        np.testing.assert_array_equal(self.values("second")[0], self.values("first")[0])
        np.testing.assert_array_equal(self.values("second", body="twin")[0], self.values("first", body="twin")[-1])

    def test_other_archives(self):
        self.first_half()
        material = json.loads((models / "rubber.json").read_text())
        (self.folder / "hard.json").write_text(json.dumps({**material, "shear_modulus": 80000}))
        program("bemprecomp", models / "ball.obj", self.folder / "hard.json", "-o", self.folder / "hard.bem",
                "--dt", DT, "--quiet")
        with h5py.File(self.folder / "first" / "trajectory.h5") as f:
            digest = f["bodies/ball"].attrs["archive_digest"]
        self.refused("/initial_state/checkpoint", '"ball"', digest, "digest", expect=4,
                     bodies=[spinning_ball(archive=str(self.folder / "hard.bem"))], initial_state=self.FROM)

    def test_bodies_of_meshes(self):
        """Their archives are the same if they say what would else depend on the scene."""
        floor = {"obstacles": [{"name": "floor", "plane": {"point": [0, 0.9, 0], "normal": [0, 1, 0]}}], "contact": {}}
        for loads, code in (("all", 0), (None, 4)):
            body = {"name": "ball", "mesh": str(models / "ball.obj"), "material": str(models / "rubber.json"),
                    "position": [0, 1.1, 0], "precompute": {"loads": loads} if loads else {}}
            options = ("-q", "--force", "--cache", self.folder / "cache")
            self.run_in("first", "--steps", 2, "--checkpoint-every", 2, *options, bodies=[body])
            done = self.run_in("second", "--steps", 5, *options, expect=code, bodies=[body], **floor,
                               initial_state=self.FROM)
            if code:
                self.assert_error(done, '"loads": "all"')

    def test_what_does_not_fit(self):
        self.first_half()
        self.refused("no body of this scene", '"ball"', bodies=[spinning_ball(name="other")], initial_state=self.FROM)
        self.refused("has no body", '"other"', bodies=[spinning_ball(), spinning_ball(name="other")],
                     initial_state={**self.FROM, "bodies": ["other"]})
        self.refused('"frame"', bodies=[spinning_ball(frame="static")], initial_state=self.FROM)
        self.refused("centrifugal", bodies=[spinning_ball(centrifugal=False)], initial_state=self.FROM)
        self.refused("cannot be read", initial_state={"checkpoint": "none.bin"})
        self.refused("is allowed only beside", initial_state={**self.FROM, "frame": 1})
        self.refused("expected the name of a body", '"bal"', '"ball"', initial_state={**self.FROM, "bodies": ["bal"]})
        self.refused("trajectory", "checkpoint", initial_state={})

    def test_joined_bodies_that_are_apart(self):
        """A joint of bodies whose state knows nothing of it would pull them together at once."""
        pair = [{**spinning_ball(), "name": "left", "position": [0, 0, 0]},
                {**falling_ball(), "name": "right", "position": [0.2, 0, 0]}]
        joint = {"type": "point", "a": {"body": "left", "point": [0.1, 0, 0]},
                 "b": {"body": "right", "point": [0.1, 0, 0]}}
        for body in pair:
            del body["rotation"]
        self.first_half(bodies=pair)
        self.refused('"left"', '"right"', "apart", check=False, bodies=pair, joints=[joint], initial_state=self.FROM)
        shutil.rmtree(self.folder / "first")
        self.assert_goes_on(body="left", most=1e-9, bodies=pair, joints=[joint])

    def test_resume_of_a_run_that_started_from_a_state(self):
        self.first_half(bodies=[pulled_ball()])
        start = {"bodies": [spinning_ball()], "initial_state": self.FROM}
        self.run_in("whole", "--steps", HALF, "-q", **start)
        self.run_in("cut", "--steps", HALF // 2, "--checkpoint-every", HALF // 2, "-q", **start)
        self.run_in("cut", "--steps", HALF, "--resume", "-q", **start)
        np.testing.assert_array_equal(self.values("whole"), self.values("cut"))
        self.run_in("first", "--steps", 2, "--checkpoint-every", 1, "-q", "--force")
        done = self.run_in("cut", "--steps", HALF + 2, "--resume", "-q", expect=4, **start)
        self.assert_error(done, "initial state")

    def test_its_own_output_is_no_initial_state(self):
        self.first_half()
        done = self.run_in("first", "-q", "--force", expect=2, initial_state=self.FROM)
        self.assert_error(done, "checkpoint.bin")
        self.assertTrue((self.folder / "first" / "checkpoint.bin").exists())

    def test_not_for_convergence_studies(self):
        self.first_half()
        done = self.run_in("study", "--convergence", "-q", expect=3, initial_state=self.FROM)
        self.assert_error(done, "/initial_state", "--convergence")


class DamagedCheckpoints(InitialState):
    def setUp(self):
        super().setUp()
        self.scene["bodies"] = [pulled_ball()]
        self.first_half()
        self.file = self.folder / "first" / "checkpoint.bin"
        self.good = self.file.read_bytes()

    def expect(self, data, *codes):
        self.file.write_bytes(data)
        self.scene_file.write_text(json.dumps({**self.scene, "initial_state": {"checkpoint": "first/checkpoint.bin"}}))
        done = subprocess.run([os.environ["BEMSIM"], self.scene_file, "-o", self.folder / "out", "--force", "-q",
                               "--steps", "2"], capture_output=True, text=True, timeout=LIMIT,
                              preexec_fn=limit_memory)
        self.assertIn(done.returncode, codes, done.stderr)
        if done.returncode:
            self.assertEqual(len([line for line in done.stderr.splitlines() if line.startswith("error: ")]), 1)

    def test_damaged_files(self):
        self.expect(self.good, 0)
        self.expect(self.good[:-1], 3)
        self.expect(self.good[:100], 3)
        self.expect(b"", 3)
        self.expect(self.good.replace(b"BEM state", b"BEM stale", 1), 3)
        self.expect(self.good.replace(b"state 0005", b"state 0004", 1), 3)

    def test_signed_files(self):
        state = state_of(self.good)
        self.expect(sign_checkpoint(self.good, state), 0)
        body = state.index(b"ball", state.index(b"bem "))
        rng = random.Random(7)
        for _ in range(CHANGES):
            at, value = body + rng.randrange(1500), rng.choice([0, 1, 2**32, 2**62, 2**64 - 1])
            changed = bytearray(state)
            changed[at:at + 8] = struct.pack("<Q", value)
            with self.subTest(at=at - body, value=value):
                self.expect(sign_checkpoint(self.good, bytes(changed)), 0, 3, 4, 5)
        for end in (body, body + 10, body + 500, len(state) // 2):
            self.expect(sign_checkpoint(self.good, state[:end]), 4)
        self.expect(sign_checkpoint(self.good, state.replace(struct.pack("<d", 1.5), struct.pack("<d", float("nan")))),
                    0, 4)


class FromTrajectory(InitialState):
    def test_place_and_velocities(self):
        """A rigid motion: in free flight that of the body that deforms."""
        self.run_in("whole", "--steps", 2 * HALF, "-q", bodies=[pulled_ball()])
        done = self.run_in("second", "--steps", HALF, bodies=[spinning_ball()],
                           initial_state={"trajectory": "whole/trajectory.h5", "frame": HALF})
        self.assertIn('the body "ball" starts from frame 8 (t = 0.08 s) of whole/trajectory.h5, undeformed', done.stderr)
        self.assertRegex(done.stderr, r"displacements of up to [0-9.]+ % of the size are left out")
        for name in ("frame/translation", "frame/rotation", "series/momentum", "series/angular_momentum"):
            np.testing.assert_allclose(self.values("second", name)[0], self.values("whole", name)[HALF], atol=1e-13)
        rotation, translation = (self.values("second", f"frame/{name}")[0] for name in ("rotation", "translation"))
        at = self.values("second")[0] - translation
        self.assertAlmostEqual(np.linalg.norm(at, axis=1).max(), 0.1, places=12)
        np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-12)

    def test_frames(self):
        self.first_half()
        for frame, expected in [(-1, HALF), (-HALF - 1, 0), (3, 3), (None, HALF)]:
            state = {"trajectory": "first/trajectory.h5", **({} if frame is None else {"frame": frame})}
            self.run_in("second", "--steps", 0, "-q", "--force", initial_state=state)
            np.testing.assert_allclose(self.values("second", "frame/translation")[0],
                                       self.values("first", "frame/translation")[expected], atol=1e-14)
        for frame in (HALF + 1, -HALF - 2):
            self.refused("/initial_state", "9 frames, 0 to 8",
                         initial_state={"trajectory": "first/trajectory.h5", "frame": frame})

    def test_what_does_not_fit(self):
        self.first_half()
        state = {"trajectory": "first/trajectory.h5"}
        self.refused("static frame", bodies=[spinning_ball(frame="static")], initial_state=state)
        self.refused("no body of this scene", bodies=[spinning_ball(name="other")], initial_state=state)
        program("bemshape", "icosphere", "--subdivisions", 1, "--radius", 0.11, "-o", self.folder / "larger.obj")
        program("bemprecomp", self.folder / "larger.obj", models / "rubber.json", "-o", self.folder / "larger.bem",
                "--dt", DT, "--quiet")
        self.refused("another mesh", bodies=[spinning_ball(archive=str(self.folder / "larger.bem"))],
                     initial_state=state)
        self.run_in("first", "--steps", 2, "-q", "--force", bodies=[spinning_ball(frame="static")])
        self.refused("static frame in the trajectory", initial_state=state)

    def test_damaged_files(self):
        self.first_half()
        file = self.folder / "first" / "trajectory.h5"
        good = file.read_bytes()
        state = {"trajectory": "first/trajectory.h5"}
        for data in (good[:len(good) // 2], b"", b"nothing"):
            file.write_bytes(data)
            self.refused("first/trajectory.h5", initial_state=state)
        changes = {"frame/rotation": 2.0, "frame/translation": np.nan, "series/momentum": np.inf,
                   "series/centre": 7.0}
        for name, value in changes.items():
            file.write_bytes(good)
            with h5py.File(file, "r+") as f:
                f[f"bodies/ball/{name}"][-1] = value
            self.refused("first/trajectory.h5", initial_state=state)
        for remove in ("series", "frame"):
            file.write_bytes(good)
            with h5py.File(file, "r+") as f:
                del f[f"bodies/ball/{remove}"]
            self.refused("first/trajectory.h5", initial_state=state)


if __name__ == "__main__":
    unittest.main()
