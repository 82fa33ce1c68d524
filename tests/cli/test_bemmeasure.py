"""bemmeasure: what it says about trajectories whose motion is known."""
import csv
import json
import os
import subprocess
import unittest

import h5py
import numpy as np

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

    def test_tables_of_what_is_recorded(self):
        floor = {"name": "floor", "plane": {"point": [0, 0, -0.1001], "normal": [0, 0, 1]}}
        self.simulate(obstacles=[floor], contact={}, gravity=[0, 0, -9.81], output={"fields": ["contacts"]})
        self.measure("--series", "series.csv", "--contacts", "contacts.csv")
        series, contacts = (list(csv.DictReader((self.folder / f"{name}.csv").read_text().splitlines()))
                            for name in ("series", "contacts"))
        self.assertTrue(contacts)
        with h5py.File(self.folder / "out/trajectory.h5") as file:
            force, volume = (file[f"bodies/ball/series/{name}"][1:] for name in ("contact_force", "volume_ratio"))
        for axis, name in enumerate("xyz"):
            np.testing.assert_allclose([float(row[f"series/contact_force_{name}"]) for row in series], force[:, axis], rtol=1e-8, atol=1e-12)
        np.testing.assert_allclose([float(row["series/volume_ratio"]) for row in series], volume, rtol=1e-9)
        for frame, row in enumerate(series):
            of_frame = [c for c in contacts if c["time"] == row["time"]]
            self.assertTrue(all((c["first"], c["second"]) == ("ball", "floor") for c in of_frame))
            self.assertAlmostEqual(sum(float(c["fz"]) for c in of_frame), force[frame, 2], places=7)
        self.simulate()
        (self.folder / "contacts.csv").unlink()
        self.assert_error(self.measure("--contacts", "contacts.csv", code=4), "contacts")
        self.assertFalse((self.folder / "contacts.csv").exists())

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

    def diff(self, *options, code=0):
        done = subprocess.run([os.environ["BEMMEASURE"], "--diff", "out/trajectory.h5", "other.h5", *options],
                              cwd=self.folder, text=True, capture_output=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def change(self, change):
        (self.folder / "other.h5").write_bytes((self.folder / "out/trajectory.h5").read_bytes())
        with h5py.File(self.folder / "other.h5", "r+") as file:
            change(file)

    def test_differences_of_two_trajectories(self):
        self.simulate()
        self.change(lambda file: None)
        self.assertIn("equal", self.diff().stdout)
        self.diff("--fields", "positions", "series/momentum", "frame/rotation")

        def move(file):
            file["bodies/ball/positions"][7, 3, 1] += 1e-3

        self.change(move)
        self.assertIn("ball positions: 0.001 at most, allowed 0 (frame 7, vertex 3)", self.diff(code=1).stdout)
        self.diff("--abs", "1.1e-3")
        self.diff("--abs", "0.9e-3", code=1)
        self.diff("--rel", "0.01")  # of 0.2 m
        self.diff("--rel", "0.004", code=1)
        self.diff("--fields", "series/momentum")

    def test_trajectories_that_cannot_be_compared(self):
        self.simulate()

        def shorten(file):
            file["time"].resize(5, axis=0)

        def rename(file):
            file.move("bodies/ball", "bodies/other")

        def shift(file):
            file["time"][3] += 1e-3

        for change, words in ((shorten, "11 and 5 frames"), (rename, 'no body "ball"'), (shift, "frame 3 is at")):
            self.change(change)
            done = self.diff(code=3)
            self.assertIn(words, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)
        self.change(lambda file: None)
        self.assertIn('no "stress"', self.diff("--fields", "stress", code=3).stderr)
        self.assertIn("--abs", self.diff("--abs", "-1", code=2).stderr)

    def test_trajectories_that_were_made_to_do_harm(self):
        """Exit code 4 and the place, whatever is wrong with them."""
        self.simulate()
        good, positions = (self.folder / "out" / "trajectory.h5").read_bytes(), "bodies/ball/positions"

        def remade(file, name, **how):
            del file[name]
            file.create_dataset(name, **how)
        for place, change in [
                ("/time", lambda f: f["time"].__setitem__(3, 1)),
                (positions, lambda f: f[positions].__setitem__((0, 0, 0), np.nan)),
                (positions, lambda f: f[positions].resize(10**9, 0)),
                (positions, lambda f: f[positions].resize(5, 0)),
                (positions, lambda f: remade(f, positions, data=f[positions][...], chunks=True, compression="gzip")),
                (positions, lambda f: f.move(positions, "other") or f.__setitem__(positions, h5py.SoftLink("/other"))),
                ("faces", lambda f: f["bodies/ball/faces"].__setitem__((0, 0), 42)),
                ("faces", lambda f: remade(f, "bodies/ball/faces", shape=(10**10, 3), dtype="i4", chunks=(1000, 3))),
                ("closed", lambda f: f["bodies/ball/faces"].__setitem__(0, [0, 1, 41]))]:
            (self.folder / "out" / "trajectory.h5").write_bytes(good)
            with h5py.File(self.folder / "out" / "trajectory.h5", "r+") as file:
                change(file)
            with self.subTest(place=place):
                self.assert_error(self.measure(code=4), "trajectory.h5", *([place] if place != "closed" else []))

    def test_a_file_that_is_no_trajectory(self):
        self.simulate()
        (self.folder / "out" / "trajectory.h5").write_text("nothing")
        self.assert_error(self.measure(code=4), "trajectory.h5")


if __name__ == "__main__":
    unittest.main()
