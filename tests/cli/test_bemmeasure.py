"""bemmeasure: what it says about trajectories whose motion is known."""
import csv
import json
import os
import subprocess
import unittest

from cli_case import CliCase


class Measure(CliCase):
    def simulate(self, **changes):
        """Ten steps of 0.01 s of a sphere of radius 0.1 m, without contact unless asked for."""
        self.precompute("--force")
        scene = {"version": 1, "time_step": 0.01, "duration": 0.1,
                 "bodies": [{"name": "ball", "archive": "a.bem", "velocity": [1, 0, 0]}], **changes}
        (self.folder / "scene.json").write_text(json.dumps(scene))
        subprocess.run([os.environ["BEMSIM"], "scene.json", "-o", "out", "--force", "-q"], cwd=self.folder, check=True)

    def measure(self, *options, code=0):
        done = subprocess.run([os.environ["BEMMEASURE"], "scene.json", "out/trajectory.h5", *options],
                              cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, code, done.stderr)
        return json.loads(done.stdout) if code == 0 else done

    def test_flight_into_a_plane(self):
        plane = {"name": "wall", "plane": {"point": [0.15, 0, 0], "normal": [-1, 0, 0]}}
        self.simulate(obstacles=[plane])
        found = self.measure("--series", "series.csv")
        body, = found["bodies"]
        self.assertEqual(found["frames"], 11)
        self.assertAlmostEqual(body["end"][0] - body["start"][0], 0.1, places=9)
        self.assertAlmostEqual(body["end_velocity"][0], 1, places=7)
        self.assertAlmostEqual(body["end_kinetic_energy_per_mass"], 0.5, places=7)
        self.assertAlmostEqual(found["penetration"]["ball - wall"]["depth"], 0.05, delta=2e-4)
        self.assertAlmostEqual(found["penetration"]["ball - wall"]["time"], 0.1)
        with open(self.folder / "series.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), 10)
        self.assertAlmostEqual(float(rows[4]["x"]), 0.05, places=9)

    def test_a_turning_body_has_the_energy_of_a_sphere(self):
        self.simulate(bodies=[{"name": "ball", "archive": "a.bem", "angular_velocity": [0, 0, 2]}])
        energy = self.measure()["bodies"][0]["end_kinetic_energy_per_mass"]
        self.assertAlmostEqual(energy / (0.5 * 0.4 * 0.1 ** 2 * 4), 1, delta=0.2)  # 42 vertices

    def test_bodies_in_each_other(self):
        self.simulate(bodies=[{"name": "a", "archive": "a.bem"},
                              {"name": "b", "archive": "a.bem", "position": [0.15, 0, 0]}])
        found = self.measure("--self")
        self.assertEqual(found["worst_pair"], "a - b")
        self.assertAlmostEqual(found["worst_penetration"], 0.05, delta=0.01)
        self.assertEqual(found["penetration"]["a - itself"]["depth"], 0)

    def test_a_file_that_is_no_trajectory(self):
        self.simulate()
        (self.folder / "out" / "trajectory.h5").write_text("nothing")
        self.assert_error(self.measure(code=4), "trajectory.h5")


if __name__ == "__main__":
    unittest.main()
