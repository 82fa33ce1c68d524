"""What trajectories hold beside positions: where they come from, obstacles, fields, series, contacts."""
import json
import unittest

import numpy as np

from simulation_case import DENSITY, DT, GRAVITY, SimulationCase, models, program, read_obj, volume

STEPS = 60


class Fields(SimulationCase):
    def setUp(self):
        super().setUp()
        self.scene["output"] = {"fields": ["positions", "velocities", "tractions", "stress", "contacts"],
                                "formats": ["hdf5", "vtp"]}

    def test_contacts_explain_the_momentum(self):
        self.touching_scene()
        self.simulate("--steps", STEPS)
        with self.trajectory() as file:
            masses = [file[f"bodies/{name}"].attrs["mass"] for name in ("low", "high")]
            momentum = [file[f"bodies/{name}/series/momentum"][:] for name in ("low", "high")]
            force = [file[f"bodies/{name}/series/contact_force"][:] for name in ("low", "high")]
            counts, pairs = file["contacts/counts"][:], file["contacts/pairs"][:]
            forces, normals = file["contacts/forces"][:], file["contacts/normals"][:]
            index = {name: file[f"bodies/{name}"].attrs["index"] for name in file["bodies"]}
            floor = file["obstacles/floor"].attrs["index"]
        self.assertEqual(index, {"low": 0, "high": 1, "hung": 2})
        self.assertEqual(floor, 3)
        self.assertGreater(np.count_nonzero(counts), STEPS // 4)
        self.assertEqual(counts[0], 0)
        self.assertEqual(len(pairs), counts.sum())
        self.assertTrue({(0, 3)} <= set(map(tuple, pairs)) <= {(0, 1), (1, 0), (0, 3), (1, 3)})
        np.testing.assert_allclose(np.linalg.norm(normals, axis=1), 1, atol=1e-12)
        for b, mass in enumerate(masses):
            change = np.diff(momentum[b], axis=0)
            expected = DT * (force[b][1:] + mass * np.array([0, 0, -9.81]))
            np.testing.assert_allclose(change, expected, atol=1e-9 * mass)
            ends = np.cumsum(counts)
            for frame in range(STEPS + 1):
                rows = slice(ends[frame] - counts[frame], ends[frame])
                total = sum((f if p[0] == b else -f for p, f in zip(pairs[rows], forces[rows]) if b in p), np.zeros(3))
                np.testing.assert_allclose(total, force[b][frame], atol=1e-9)

    def test_velocities_are_those_of_the_positions(self):
        self.touching_scene()
        self.scene["bodies"][1]["position"][2] = 2  # falls all the time
        self.scene["bodies"][1]["angular_velocity"] = [3, -2, 5]
        self.simulate("--steps", 20)
        with self.trajectory() as file:
            x, v = file["bodies/high/positions"][:], file["bodies/high/velocities"][:]
        centred = (x[2:] - x[:-2]) / (2 * DT)
        np.testing.assert_allclose(v[1:-1], centred, atol=0.02)  # it vibrates when it begins to turn
        np.testing.assert_allclose(v[0], [0, 0, -1] + np.cross([3, -2, 5], x[0] - x[0].mean(axis=0)), atol=1e-9)

    def test_stress_of_a_pressed_ball(self):
        pressure = 100.0
        program("bemprecomp", models / "ball.obj", models / "rubber.json", "-o", self.folder / "ball.bem", "--model",
                "static", "--dt", DT, "--quiet")
        self.scene["bodies"] = [{"name": "ball", "archive": str(self.folder / "ball.bem"), "gravity": False,
                                 "tractions": [{"select": "all", "pressure": pressure}]}]
        self.simulate("--steps", 2)
        with self.trajectory() as file:
            stress, equivalent = file["bodies/ball/stress"][-1], file["bodies/ball/von_mises"][-1]
        np.testing.assert_allclose(stress[:, :3], -pressure, atol=0.06 * pressure)
        np.testing.assert_allclose(stress[:, 3:], 0, atol=0.06 * pressure)
        self.assertLess(equivalent.max(), 0.08 * pressure)

    def test_where_a_trajectory_comes_from(self):
        self.simulate("--steps", 1)
        _, faces = read_obj(models / "ball.obj")
        vertices, _ = read_obj(models / "ball.obj")
        info = program("bemprecomp", "--info", models / "ball.bem", "--json").stdout
        with self.trajectory() as file:
            self.assertEqual(file.attrs["version"], 2)
            self.assertTrue(file.attrs["program"].startswith("bem "))
            self.assertEqual(file.attrs["scene"], self.scene_file.read_text())
            self.assertEqual(file.attrs["time_step"], DT)
            body = file["bodies/ball"]
            self.assertIn(body.attrs["archive_digest"], info)
            self.assertEqual(len(body.attrs["mesh_digest"]), 32)
            self.assertAlmostEqual(body.attrs["mass"], DENSITY * volume(vertices, faces), delta=1e-9)

    def test_a_scene_of_a_megabyte_is_kept(self):
        self.scene_file.write_text(json.dumps(self.scene) + "\n" * 1000000)
        program("bemsim", self.scene_file, "-o", self.out, "--steps", 0)
        with self.trajectory() as file:
            self.assertEqual(file.attrs["scene"], self.scene_file.read_text())

    def test_obstacles_and_where_they_are(self):
        self.touching_scene()
        self.scene["obstacles"].append({
            "name": "wall", "mesh": str(models / "ball.obj"), "scale": 2, "position": [9, 0, 0],
            "motion": [{"time": 0, "translate": [0, 0, 0]},
                       {"time": 0.1, "translate": [0, 1, 0], "rotate": {"axis": [0, 0, 1], "angle_deg": 90}}]})
        self.simulate("--steps", 10)
        vertices, faces = read_obj(models / "ball.obj")
        with self.trajectory() as file:
            self.assertEqual(list(file["obstacles/floor/point"]), [0, 0, 0])
            self.assertEqual(list(file["obstacles/floor/normal"]), [0, 0, 1])
            wall = file["obstacles/wall"]
            self.assertEqual(wall.attrs["index"], 4)
            np.testing.assert_allclose(wall["vertices"], 2 * vertices, rtol=1e-14)
            np.testing.assert_array_equal(wall["faces"], faces)
            np.testing.assert_allclose(wall["translation"][0], [9, 0, 0])
            np.testing.assert_allclose(wall["translation"][10], [0, 10, 0], atol=1e-9)
            np.testing.assert_allclose(wall["rotation"][10], [[0, -1, 0], [1, 0, 0], [0, 0, 1]], atol=1e-9)

    def test_an_open_sheet_is_written_once(self):
        sheet = self.folder / "sheet.obj"
        sheet.write_text("v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3\nf 1 3 4\n")
        self.touching_scene()
        self.scene["obstacles"] = [{"name": "sheet", "mesh": str(sheet)}]
        self.simulate("--steps", 1)
        with self.trajectory() as file:
            faces, corners = file["obstacles/sheet/faces"][:], file["obstacles/sheet/vertices"][:]
        self.assertEqual(len(faces), 2)
        a, b, c = (corners[faces[:, i]] for i in range(3))
        self.assertAlmostEqual(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2, 4)

    def test_series_of_free_fall(self):
        self.simulate("--steps", 10)
        with self.trajectory() as file:
            mass = file["bodies/ball"].attrs["mass"]
            series = {name: data[:] for name, data in file["bodies/ball/series"].items()}
            t = file["time"][:]
        np.testing.assert_allclose(series["momentum"], mass * (np.array([1.5, 0.5, 0]) + np.outer(t, GRAVITY)),
                                   atol=1e-9)
        np.testing.assert_allclose(series["potential_energy"], mass * 9.81 * series["centre"][:, 1], atol=1e-9)
        np.testing.assert_allclose(series["volume_ratio"], 1, atol=1e-9)
        self.assertFalse(series["contact_force"].any())

    def test_going_on_gives_the_same_bytes(self):
        self.touching_scene()
        self.simulate("--steps", STEPS)
        whole = (self.out / "trajectory.h5").read_bytes()
        self.simulate("--steps", STEPS // 2, "--checkpoint-every", 10, "--force")
        program("bemsim", self.scene_file, "-o", self.out, "--steps", STEPS, "--resume", "--checkpoint-every", 10)
        self.assertEqual((self.out / "trajectory.h5").read_bytes(), whole)

    def test_fields_of_a_render_mesh(self):
        self.scene["bodies"][0].update(render_mesh=str(models / "ball.obj"), angular_velocity=[0, 8, 0])
        self.scene["output"]["surface"] = "both"
        self.simulate("--steps", 5)
        with self.trajectory() as file:
            shown, surface = file["bodies/ball"], file["bodies/ball-simulation"]
            self.assertEqual(shown.attrs["index"], surface.attrs["index"])
            for name, most in (("positions", 1e-12), ("velocities", 1e-6), ("von_mises", 1e-6)):
                np.testing.assert_allclose(shown[name][:], surface[name][:], atol=most)


if __name__ == "__main__":
    unittest.main()
