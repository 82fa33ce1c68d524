"""bemsim --convergence: a scene on other meshes and with other time steps."""
import json
import os
import re
import signal
import subprocess
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np

from simulation_case import SimulationCase, models, program, read_obj


class Convergence(SimulationCase):
    def setUp(self):
        super().setUp()
        self.body = {"name": "ball", "mesh": str(models / "ball.obj"),
                     "material": {"name": "rubber", "density": 1000, "shear_modulus": 40000, "poisson_ratio": 0.3},
                     "precompute": {"scheme": "bdf1", "codec": "none"},
                     "tractions": [{"select": {"box": {"min": [0, -1, -1], "max": [1, 1, 1]}}, "traction": [500, 0, 0],
                                    "profile": [[0, 0], [0.08, 1], [0.16, 0]]}]}
        self.scene = {"version": 1, "time_step": 0.01, "duration": 0.16, "bodies": [self.body]}

    def study(self, *options, expect=0, cache=models / "cache"):
        self.scene_file.write_text(json.dumps(self.scene, indent=1))
        return program("bemsim", self.scene_file, "--convergence", "-o", self.out, "--cache", cache, *options, expect=expect)

    def result(self):
        return json.loads((self.out / "convergence.json").read_text())

    def test_bodies_start_where_the_scene_places_them(self):
        self.scene.update(duration=0.04, gravity=[0, -9.81, 0], contact={}, obstacles=[
            {"name": "floor", "plane": {"point": [0, 0, 0], "normal": [0, 1, 0]}}])
        self.body.update(place={"on": "floor", "gap": 0.1}, tractions=[])
        done = self.study("--coarser", 0)
        position = self.result()["all"]["position"]
        self.assertLess(max(position["from_finest"]), 1e-9)  # all of them fall alike
        self.assertEqual((position["mesh"]["same"], position["mesh"]["converges"]), (True, None))
        self.assertIn("positions and time steps: the same in all runs, to rounding\n", done.stdout)
        self.assertIn("deformation: none in any run\n", done.stdout)
        self.assertNotRegex(done.stdout, "too coarse|order|help")

    def test_bodies_at_rest_get_no_verdict(self):
        self.scene["duration"] = 0.04
        del self.body["tractions"]
        done = self.study("--coarser", 0)
        self.assertTrue(done.stdout.endswith("nothing moves in any run: there is nothing to compare\n"), done.stdout)
        self.assertEqual(self.result()["all"]["deformation"]["size"], 0)

    def test_the_runs_and_what_they_say(self):
        cache = self.folder / "cache"  # of its own, because it is about what is computed
        done = self.study("--coarser", 1, cache=cache)
        result = self.result()
        levels = [(run["mesh_level"], run["time_level"]) for run in result["runs"]]
        self.assertEqual(levels, [(0, 0), (-1, 0), (1, 0), (0, -1), (0, 1), (1, 1)])
        for run in result["runs"]:
            self.assertAlmostEqual(run["nodes"] / 42 / 2.0 ** run["mesh_level"], 1, delta=0.11)
            self.assertEqual(run["time_step"], 0.01 / 2.0 ** run["time_level"])
            self.assertAlmostEqual(run["steps"] * run["time_step"], 0.16)
            self.assertGreater(run["precompute_cpu_seconds"], 0)
            self.assertGreater(run["archive_bytes"], 1e4)
        self.assertEqual(result["compared"], {"times": 9, "interval": 0.02})
        self.assertIn("5 more runs, up to about 84 nodes and a time step of 0.005 s", done.stderr)
        position = result["all"]["position"]
        self.assertEqual(position["from_finest"][-1], 0)
        self.assertTrue(position["time_step"]["converges"])
        self.assertAlmostEqual(position["time_step"]["order"], 1, delta=0.3)  # that of bdf1
        self.assertEqual(position["time_step"]["runs"], [3, 0, 4])
        self.assertEqual(position["mesh"]["runs"], [1, 0, 2])
        self.assertEqual(result["bodies"]["ball"], result["all"])
        lines = done.stdout.splitlines()
        self.assertRegex(lines[0], "varied +nodes +step .*positions differ +error")
        self.assertRegex(lines[2], r"mesh \(scene\) +42 +0.01 ")
        self.assertRegex(lines[7], r"both +8\d +0.005 .* 0 % ")
        svg = xml.etree.ElementTree.parse(self.out / "convergence.svg")
        self.assertEqual(svg.getroot().tag, "{http://www.w3.org/2000/svg}svg")
        again = self.study("--coarser", 1, "--force", cache=cache)
        self.assertNotIn("computing", again.stderr)
        remeshed = [line for line in done.stderr.splitlines() if "remeshed" in line]
        self.assertEqual(len(remeshed), 2, remeshed)  # once for each mesh
        self.assertRegex(remeshed[0], "warning: the run with about 21 nodes .*: .*remeshed it to")
        repeated = self.result()
        expected = re.search(r"take about (\S+) s more .*; the matrices of 5 are in the cache\)", again.stderr)
        steps = sum(2 ** (1.6 * mesh) * (0.6 + 0.4 * 2 ** time) * 2 ** time for mesh, time in levels[1:])
        self.assertAlmostEqual(float(expected[1]) / (steps * repeated["runs"][0]["simulation_cpu_seconds"]), 1, delta=0.4)
        self.assertEqual(repeated["all"], result["all"])
        self.assertEqual([run["precompute_cpu_seconds"] for run in repeated["runs"]],
                         [run["precompute_cpu_seconds"] for run in result["runs"]])

    def test_differences_are_those_of_trajectories(self):
        """But for the weights of the vertices, which are nearly equal."""
        self.study("--coarser", 1, "--finer", 0)
        position, paths = self.result()["all"]["position"], []
        for step, every in ((0.01, 2), (0.02, 1)):
            self.scene["time_step"] = step
            self.scene_file.write_text(json.dumps(self.scene))
            program("bemsim", self.scene_file, "-o", self.folder / f"t{step}", "--every", every, "--cache", models / "cache")
            with h5py.File(self.folder / f"t{step}/trajectory.h5") as file:
                paths.append(file["bodies/ball/positions"][:])
        difference = np.sqrt(((paths[0] - paths[1]) ** 2).sum(axis=2).mean())
        size = np.sqrt(((paths[0] - paths[0][0]) ** 2).sum(axis=2).mean())
        self.assertAlmostEqual(position["size"] / size, 1, delta=0.02)
        self.assertAlmostEqual(position["from_finest"][2] / difference, 1, delta=0.02)
        self.assertEqual(position["from_finest"][0], 0)

    def test_existing_studies_are_kept(self):
        self.body["precompute"]["model"] = "rigid"
        del self.body["precompute"]["scheme"], self.body["precompute"]["codec"]
        self.study("--coarser", 1, "--finer", 0)
        self.assertIsNone(self.result()["all"]["position"]["mesh"])
        self.assert_error(self.study(expect=2), "convergence.json", "--force")
        done = self.study("--coarser", 2, "--finer", 0, "--force", "--every", 17)
        self.assertIn("info: frames are farther apart than the run is long, 16 steps: the motions are compared at 5 times",
                      done.stderr)
        self.assertEqual(len(self.result()["runs"]), 3)

    def test_what_cannot_be_compared_is_refused(self):
        self.scene["bodies"] = [{"name": "ball", "archive": str(models / "ball.bem")}]
        self.assert_error(self.study(expect=3), "/bodies/0/archive", '"mesh" and "material" without an "archive"')
        self.scene["bodies"] = [self.body]
        self.assert_error(self.study("--steps", 0, expect=2), "shorter than a time step")
        self.assert_error(self.study("--coarser", 9, expect=2), "--coarser must be from 0 to 5")
        self.assert_error(self.study("--coarser", 1, "--coarser", 2, expect=2), "--coarser is given more than once")
        self.body["fixed"] = [{"vertices": [0, 1, 2]}]
        self.assert_error(self.study(expect=3), "/bodies/0/fixed/0", "--convergence makes other meshes", "select by a box")
        del self.body["fixed"]
        self.assert_error(self.study("--coarser", 0, "--finer", 0, expect=2), "nothing to compare")
        self.assert_error(self.study("--format", "obj", expect=2), "writes no trajectories")
        self.assert_error(self.study("--check", expect=2), "only one of")
        self.assert_error(self.simulate("--finer", 1, expect=2), "belong to --convergence")

    def test_errors_name_the_run(self):
        x, y, z = read_obj(models / "ball.obj")[0][0]
        self.body["fixed"] = [{"sphere": {"center": [x, y, z], "radius": 1e-4}}]  # one vertex, of this mesh alone
        done = self.study("--coarser", 1, "--finer", 0, expect=3)
        self.assertRegex(done.stderr.splitlines()[-1],
                         "error: the run with about 21 nodes and a time step of 0.01 s: .*/bodies/0/fixed/0.*picks no vertex")
        self.assertEqual(list(self.out.iterdir()), [])

    def test_an_interruption_leaves_no_study(self):
        self.scene["duration"] = 20
        self.scene_file.write_text(json.dumps(self.scene))
        run = subprocess.Popen([os.environ["BEMSIM"], self.scene_file, "--convergence", "--coarser", "5", "--finer", "0", "-o",
                                self.out, "--cache", models / "cache"], stderr=subprocess.PIPE, text=True)
        for line in run.stderr:
            if re.search("more runs", line):
                break
        run.send_signal(signal.SIGINT)
        rest = run.communicate(timeout=60)[1]
        self.assertEqual(run.returncode, 130)
        self.assertRegex(rest, r"error: interrupted \(SIGINT\); 1 of 11 runs are done")
        self.assertEqual(list(self.out.iterdir()), [])


if __name__ == "__main__":
    unittest.main()
