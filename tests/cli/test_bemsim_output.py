"""What bemsim writes: trajectories, which steps, which formats."""
import json
import math
import unittest

import numpy as np

from simulation_case import (DT, GRAVITY, SimulationCase, falling_ball, held_ball, make_model, models, program,
                             read_obj, rotation)


class Trajectories(SimulationCase):
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
                self.assertEqual(set(body), {"positions", "faces", "frame", "series", "tractions"})
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
        make_model("star", "star", 2)
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


class Schedule(SimulationCase):
    def times(self, *options):
        self.simulate("--force", *options)
        with self.trajectory() as file:
            return np.round(file["time"][:] / DT, 6).tolist()

    def test_every(self):
        self.assertEqual(self.times("--every", 7), [0, 7, 14])
        self.scene["output"] = {"every": 10}
        self.assertEqual(self.times(), [0, 10, 20])
        self.assertEqual(self.times("--every", 20), [0, 20])

    def test_frames_beyond_the_run(self):
        for option, of in (("--every", 21), ("--fps", 1)):
            done = self.simulate("--force", option, of)
            self.assertIn("info: frames are farther apart than the run is long, 20 steps: only the start is written", done.stderr)
        self.assertNotIn("farther apart", self.simulate("--force", "--every", 20).stderr)

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


if __name__ == "__main__":
    unittest.main()
