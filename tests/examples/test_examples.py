"""The programs of examples/: what they print is right."""
import csv
import json
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

BIN = pathlib.Path(os.environ["BEM_BIN"])
NUMBER = r"(-?[0-9.e+-]+)"


def run(program, *arguments, code=0):
    done = subprocess.run([BIN / program, *arguments], text=True, capture_output=True)
    assert done.returncode == code, done.stderr
    return done


def columns(text):
    rows = list(csv.DictReader(text.splitlines()))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


class Examples(unittest.TestCase):
    def test_a_floor_pushes_a_cube_by_its_momentum(self):
        done = run("drop_cube")
        impulse, change = map(float, re.search(f"weight {NUMBER} N s, .*momentum {NUMBER} N s", done.stderr).groups())
        self.assertAlmostEqual(impulse / change, 1, 6)
        self.assertGreater(change, 1.2)  # 1 kg comes with 1 m/s and leaves slower, because it vibrates
        path = columns(done.stdout)
        self.assertGreater(max(path["force"]), 100)
        self.assertEqual(path["force"][-1], 0)
        self.assertGreater(path["height"][-1], 0.05)

    def test_a_beam_vibrates_like_a_slender_one(self):
        done = run("pluck_beam")
        period, slender = map(float, re.search(f"period {NUMBER} s, of a slender beam {NUMBER} s", done.stderr).groups())
        self.assertLess(abs(period / slender - 1), 0.02)
        self.assertLess(min(columns(done.stdout)["deflection"]), -1e-4)

    def test_a_scene_file_is_played(self):
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "rubber.json").write_text('{"name": "rubber", "density": 1000, "shear_modulus": 1e5, "poisson_ratio": 0.3}')
            run("bemshape", "icosphere", "--subdivisions", "1", "--radius", "0.1", "-o", folder / "ball.obj")
            run("bemprecomp", folder / "ball.obj", folder / "rubber.json", "--dt", "0.01", "-o", folder / "ball.bem")
            scene = {"version": 1, "time_step": 0.01, "duration": 0.5, "gravity": [0, -9.81, 0],
                     "bodies": [{"name": "ball", "archive": "ball.bem", "velocity": [1, 0, 0]}]}
            (folder / "scene.json").write_text(json.dumps(scene))
            done = run("play_scene", folder / "scene.json")
            x, y, z = map(float, re.fullmatch(f"ball: {NUMBER} {NUMBER} {NUMBER} m after 0.5 s\\n", done.stdout).groups())
            self.assertAlmostEqual(x, 0.5, 5)
            self.assertAlmostEqual(y, -0.5 * 9.81 * 0.25, 5)
            self.assertAlmostEqual(z, 0, 5)
            scene["bodies"][0]["archive"] = "none.bem"
            (folder / "scene.json").write_text(json.dumps(scene))
            self.assertIn("none.bem", run("play_scene", folder / "scene.json", code=4).stderr)
        self.assertIn("usage", run("play_scene", code=2).stderr)


if __name__ == "__main__":
    unittest.main()
